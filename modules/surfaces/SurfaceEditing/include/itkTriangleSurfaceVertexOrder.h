#ifndef itkTriangleSurfaceVertexOrder_h
#define itkTriangleSurfaceVertexOrder_h

#include "itkTriangleSurface.h"

namespace itk
{

/** Reorders triangles for the vertex cache of graphics cards, then points and normals by first use. Triangles keep
 * their positions and orientation; points of no triangle are removed. Time nearly linear; memory 40 bytes per triangle
 * while it runs. */
void
OptimizeTriangleSurfaceForRendering(TriangleSurface & surface);

} // namespace itk

#endif
