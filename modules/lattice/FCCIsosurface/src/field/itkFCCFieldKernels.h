#ifndef itkFCCFieldKernels_h
#define itkFCCFieldKernels_h

#include "itkFCCLattice.h"

#include <array>
#include <cstdint>

namespace itk
{

/** \class FCCFieldKernels
 * \brief The loops over rows of a field, compiled for several instruction sets; the best one the processor has runs,
 * and results have the same bits whichever does.
 */
struct FCCFieldKernels
{
  /** Sites of a block: rows can be read and written in whole blocks, a margin of one block beyond both ends. */
  static constexpr SizeValueType Block = 16;

  /** The twelve neighbours' rows of a row of sites, shifted so that element i is the neighbour of site i, in the order
   * of FCCLattice::NearestNeighbors. */
  using NeighborRows = std::array<const float *, 12>;

  /** Coefficients of the box spline that quasi-interpolates a row of values: 3/2 f - sum of neighbours / 24. Where that
   * is not finite, the value itself. Whole blocks are computed. */
  static void
  QuasiInterpolate(const float * values, const NeighborRows & neighbors, SizeValueType count, float * coefficients);

  /** Floats that a gradient takes in memory: x, y, z and nothing, so that it is read at once. */
  static constexpr SizeValueType GradientStride = 4;

  /** The gradients at some sites of a row in lattice coordinates, sum of d f(x + d) / 8 over the neighbours, one after
   * the other. \param sites \a words words, whose bits are the sites that are wanted */
  static void
  Gradient(const NeighborRows & neighbors, const std::uint64_t * sites, SizeValueType words, float * gradients);
};

} // namespace itk

#endif
