#ifndef itkFCCRowKernels_h
#define itkFCCRowKernels_h

#include "itkIntTypes.h"

#include <cstdint>

namespace itk
{

/** \class FCCRowKernels
 * \brief The loops over rows of samples, compiled for several instruction sets; the best one the processor has runs.
 *
 * All results have the same bits whatever the instruction set: no sum depends on the width of a vector. Pixels are of
 * any type of integer from char to unsigned long long, of float or of double.
 *
 * Thread safety: the functions write nothing but what they are given.
 *
 * \ingroup FCCIsosurface
 */
struct FCCRowKernels
{
  /** Lanes of a block: rows of floats can be read and written in whole blocks, a margin of one block beyond both ends.
   */
  static constexpr SizeValueType Block = 16;

  /** One bit a value, from bit 0 of the first word on: is it at least \a isovalue, which is finite, or with \a isBelow,
   * is it less? That is exact for all types. Not-a-number is neither. Bits past the last value are zero. */
  template <typename TPixel>
  static void
  Classify(const TPixel * values, SizeValueType count, double isovalue, bool isBelow, std::uint64_t * words);

  /** differences[i] = values[i] - isovalue, computed in float64 and rounded to float32: so integers of more than 53
   * bits are rounded before. */
  template <typename TPixel>
  static void
  Subtract(const TPixel * values, SizeValueType count, double isovalue, float * differences);

  /** The twelve neighbours' rows of a row of sites, shifted so that element i is the neighbour of site i, in the order
   * of FCCLattice::NearestNeighbors. */
  using NeighborRows = const float * [12];

  /** Coefficients of the box spline that quasi-interpolates a row of values: 3/2 f - sum of neighbours / 24. Where that
   * is not finite, the value itself. Whole blocks are computed. */
  static void
  QuasiInterpolate(const float * values, const NeighborRows & neighbors, SizeValueType count, float * coefficients);

  /** Floats that a gradient takes in memory: x, y, z and nothing, so that it is read at once. */
  static constexpr SizeValueType GradientStride = 4;

  /** One block of a row's gradients in lattice coordinates, sum of d f(x + d) / 8 over the neighbours. */
  static void
  Gradient(const NeighborRows & neighbors, SizeValueType first, float * gradients);
};

} // namespace itk

#endif
