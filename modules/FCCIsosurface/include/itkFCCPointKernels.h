#ifndef itkFCCPointKernels_h
#define itkFCCPointKernels_h

#include "itkTriangleSurface.h"

#include <array>

namespace itk
{

/** \class FCCFrame
 * \brief From lattice coordinates to the world: points by an affine map, gradients by the transposed inverse of it.
 *
 * \ingroup FCCIsosurface
 */
struct FCCFrame
{
  std::array<double, 3> origin;
  std::array<std::array<double, 3>, 3> matrix;           ///< [world axis][lattice axis]
  std::array<std::array<double, 3>, 3> gradientToWorld; ///< [world axis][lattice axis]
  double outwardSign;                                    ///< of a gradient, to point outside
};

/** \class FCCEdgeBatch
 * \brief Cut edges, gathered so that many points are placed at once.
 *
 * \ingroup FCCIsosurface
 */
struct FCCEdgeBatch
{
  static constexpr SizeValueType Capacity = 64;

  SizeValueType count = 0;
  float value[4][Capacity];       ///< at the places -1, 0, 1, 2 along the edge's line, less the isovalue
  float gradient[2][3][Capacity]; ///< at both ends, in lattice coordinates
  float step[3][Capacity];        ///< from the edge's first end to the other
  double site[3][Capacity];       ///< the first end
};

/** \class FCCPointKernels
 * \brief Places points and normals, a batch at a time.
 *
 * Compiled for several instruction sets, as FCCRowKernels are; the results have the same bits whichever runs.
 *
 * \ingroup FCCIsosurface
 */
struct FCCPointKernels
{
  /** Where the values cross zero between the edges' ends: linearly, or with \a cubic, where the cubic polynomial
   * through four values does. Points stay \a minimumFraction of the edge away from both ends. Without \a normals none
   * are computed; \a batch.value[0], [3] are read for \a cubic only. */
  static void
  PlaceOnEdges(const FCCEdgeBatch & batch,
               const FCCFrame & frame,
               bool cubic,
               double minimumFraction,
               TriangleSurface::PointType * points,
               TriangleSurface::NormalType * normals);
};

} // namespace itk

#endif
