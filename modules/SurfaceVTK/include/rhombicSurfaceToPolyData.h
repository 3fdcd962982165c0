#ifndef rhombicSurfaceToPolyData_h
#define rhombicSurfaceToPolyData_h

#include "itkTriangleSurface.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace rhombic
{

/** The surface as VTK sees it: points and normals share the surface's memory, and so do the triangle indices; only
 * VTK's cell offsets (4 bytes a triangle) are new. The surface stays alive as long as any of the arrays does, and must
 * not be changed meanwhile. Points and normals are float32, connectivity int32.
 *
 * Throws itk::ExceptionObject for a null pointer, and for more than 2^31 - 1 points or corners of triangles. Thread
 * safe, for the same surface, too; the result is, like all of VTK, for one thread at a time. */
vtkSmartPointer<vtkPolyData>
SurfaceToPolyData(const itk::TriangleSurface * surface);

} // namespace rhombic

#endif
