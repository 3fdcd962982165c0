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

/** The same for each connected component. Thread safe. */
std::vector<double>
ComputeComponentVolumes(const TriangleSurface & surface, const TriangleSurfaceComponents & components);

} // namespace itk

#endif
