#ifndef rhombicSurfaceToPolyData_h
#define rhombicSurfaceToPolyData_h

#include "itkTriangleSurface.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace rhombic
{

/** Wraps a surface as polydata: points, normals and triangle indices share the surface's memory; only VTK's cell
 * offsets (4 bytes per triangle) are new. The polydata stays as it is when the surface changes, its filter runs again
 * or both are deleted. Filters of VTK that write into their input's arrays need a deep copy, as the surface has the
 * same memory. Points and normals are float32, connectivity is int32.
 *
 * Throws itk::ExceptionObject for a null pointer, and for more than 2^31 - 1 points or corners of triangles. */
vtkSmartPointer<vtkPolyData>
SurfaceToPolyData(const itk::TriangleSurface * surface);

} // namespace rhombic

#endif
