#ifndef itkTriangleSurfaceMeasures_h
#define itkTriangleSurfaceMeasures_h

#include "itkTriangleSurface.h"
#include "itkTriangleSurfaceComponents.h"

namespace itk
{

/** Sum of the triangles' areas in mm^2. Thread safe. */
double
ComputeArea(const TriangleSurface & surface);

/** Enclosed volume in mm^3 by the divergence theorem, positive when the triangles face outwards. Meaningful for closed
 * surfaces only. Thread safe. */
double
ComputeVolume(const TriangleSurface & surface);

/** Where the enclosed volume has its centre, in LPS mm; for closed surfaces of a volume other than 0. Thread safe. */
std::array<double, 3>
ComputeCentroid(const TriangleSurface & surface);

/** The distance of the two points farthest from each other, in mm; 0 without points. Exact: pairs of boxes of points
 * are searched, the farthest first, and left out when their corners are no farther apart than the best pair so far.
 * About 20 bytes a point. Thread safe. */
double
ComputeLongestDiameter(const TriangleSurface & surface);

/** The volume of each connected component. Thread safe. */
std::vector<double>
ComputeComponentVolumes(const TriangleSurface & surface, const TriangleSurfaceComponents & components);

} // namespace itk

#endif
