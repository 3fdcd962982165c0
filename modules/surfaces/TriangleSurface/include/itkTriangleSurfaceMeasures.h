#ifndef itkTriangleSurfaceMeasures_h
#define itkTriangleSurfaceMeasures_h

#include "itkTriangleSurface.h"
#include "itkTriangleSurfaceComponents.h"

namespace itk
{

/** Sum of the triangles' areas in mm^2. */
double
ComputeTriangleSurfaceArea(const TriangleSurface & surface);

/** Enclosed volume in mm^3 by the divergence theorem, positive if the triangles face outwards. Meaningful for closed
 * surfaces only. */
double
ComputeTriangleSurfaceVolume(const TriangleSurface & surface);

/** Centroid of the enclosed volume in LPS mm, for closed surfaces; 0 if the volume is 0. */
std::array<double, 3>
ComputeTriangleSurfaceCentroid(const TriangleSurface & surface);

/** The largest distance between two points in mm; 0 without points. Exact. Memory about 20 bytes per point. */
double
ComputeTriangleSurfaceLongestDiameter(const TriangleSurface & surface);

/** The volume of each component in mm^3, as ComputeTriangleSurfaceVolume(). */
std::vector<double>
ComputeTriangleSurfaceComponentVolumes(const TriangleSurface & surface, const TriangleSurfaceComponents & components);

} // namespace itk

#endif
