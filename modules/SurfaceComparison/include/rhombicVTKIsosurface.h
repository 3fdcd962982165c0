#ifndef rhombicVTKIsosurface_h
#define rhombicVTKIsosurface_h

#include "itkImage.h"
#include "itkTriangleSurface.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cstdint>

namespace rhombic
{

/** \file
 * The surfaces that VTK makes, to compare with. Thread safety: that of VTK, one thread at a time. */

/** VTK's extractors for Cartesian volumes. */
enum class VTKExtractor : unsigned char
{
  FlyingEdges,  ///< vtkFlyingEdges3D
  MarchingCubes ///< vtkMarchingCubes
};

/** A volume as VTK sees it, sharing its pixels, which must outlive the result. Spacing and origin are taken over, the
 * direction is not. For std::int16_t and float. */
template <typename TPixel>
vtkSmartPointer<vtkImageData>
ShareWithVTK(const itk::Image<TPixel, 3> * image);

/** The surface of a volume at an isovalue. VTK's scalars and gradients are off; normals as asked for.
 * How many threads work is vtkSMPTools' affair. vtkFlyingEdges3D is threaded, vtkMarchingCubes is not. */
vtkSmartPointer<vtkPolyData>
ExtractWithVTK(VTKExtractor extractor, vtkImageData * volume, double isovalue, bool normals);

/** A copy of a mesh of triangles, with its normals if it has any. Throws Failure(Internal) for other cells. */
itk::TriangleSurface::Pointer
PolyDataToSurface(vtkPolyData * mesh);

} // namespace rhombic

#endif
