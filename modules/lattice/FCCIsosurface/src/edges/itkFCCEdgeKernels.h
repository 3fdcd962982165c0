#ifndef itkFCCEdgeKernels_h
#define itkFCCEdgeKernels_h

#include "itkFCCSurfaceExtractor.h"

namespace itk
{

/** \class FCCEdgeBatch
 * \brief Cut edges, gathered so that many points are placed at once.
 */
struct FCCEdgeBatch
{
  static constexpr SizeValueType Capacity = 64;

  SizeValueType count = 0;
  float value[4][Capacity];       ///< at -1, 0, 1 and 2 edge lengths from the first end, less the isovalue
  float gradient[2][Capacity][4]; ///< x, y, z and nothing, at both ends, in lattice coordinates
  float step[3][Capacity];        ///< from the edge's first end to the other
  double site[3][Capacity];       ///< the first end
};

/** Places the points of a batch of cut edges: where the line through the values at both ends crosses zero, or with
 * \a cubic, where the cubic polynomial through all four values does. Points stay \a minimumFraction of the edge away
 * from both ends. A normal is along the gradient at the point, interpolated between the ends; where that is zero or
 * not finite, along the edge. Without \a normals none are computed. batch.value[0] and [3] are read for \a cubic only.
 */
void
PlaceOnEdges(const FCCEdgeBatch & batch,
             const FCCFrame & frame,
             bool cubic,
             double minimumFraction,
             TriangleSurface::PointType * points,
             TriangleSurface::NormalType * normals);

} // namespace itk

#endif
