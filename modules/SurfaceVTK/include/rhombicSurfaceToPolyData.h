#ifndef rhombicSurfaceToPolyData_h
#define rhombicSurfaceToPolyData_h

#include "itkTriangleSurface.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace rhombic
{

/** Wraps a surface as polydata: points, normals and triangle indices share the surface's memory; only VTK's cell
 * offsets (4 bytes per triangle) are new. The surface stays alive as long as any of the arrays does, and must not be
 * changed meanwhile. Points and normals are float32, connectivity is int32.
 *
 * Throws itk::ExceptionObject for a null pointer, and for more than 2^31 - 1 points or corners of triangles. */
vtkSmartPointer<vtkPolyData>
SurfaceToPolyData(const itk::TriangleSurface * surface);

} // namespace rhombic

#endif
