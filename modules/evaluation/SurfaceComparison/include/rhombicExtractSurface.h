#ifndef rhombicExtractSurface_h
#define rhombicExtractSurface_h

#include "itkFCCImage.h"
#include "itkFCCIsosurfaceMode.h"
#include "itkTriangleSurface.h"
#include "itkImage.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <string>

namespace rhombic
{

using ExtractionMode = itk::FCCIsosurfaceMode;

/** All modes. */
constexpr std::array<ExtractionMode, 5> ExtractionModes{ ExtractionMode::Tetrahedra,
                                                         ExtractionMode::Octahedra,
                                                         ExtractionMode::Parallelepipeds,
                                                         ExtractionMode::Fine,
                                                         ExtractionMode::Lean };

/** "tetrahedra", ... */
std::string
NameOf(ExtractionMode mode);

/** Extracts the surface of an image, on as many threads as ITK is set to use. For std::int16_t and float.
 * \param normals whether to make normals; some modes always make them
 * \param closed whether to close the surface at the image's border; VTK's surfaces end there */
template <typename TPixel>
itk::TriangleSurface::Pointer
ExtractSurface(const itk::FCCImage<TPixel> * image,
               double isovalue,
               ExtractionMode mode,
               bool normals,
               bool closed = false);

/** \file
 * VTK's isosurfaces, to compare with. Thread safety: one thread at a time, as in VTK. */

/** VTK's extractors for Cartesian volumes. */
enum class VTKExtractor : unsigned char
{
  FlyingEdges,  ///< vtkFlyingEdges3D
  MarchingCubes ///< vtkMarchingCubes
};

/** The volume as VTK's image, which shares the pixels: they must outlive the result. Spacing and origin are copied, the
 * direction is ignored. For std::int16_t and float. */
template <typename TPixel>
vtkSmartPointer<vtkImageData>
ShareWithVTK(const itk::Image<TPixel, 3> * image);

/** The surface of a volume at an isovalue, without scalars and gradients. vtkFlyingEdges3D works on as many threads as
 * vtkSMPTools is set to, vtkMarchingCubes on one. */
vtkSmartPointer<vtkPolyData>
ExtractWithVTK(VTKExtractor extractor, vtkImageData * volume, double isovalue, bool normals);

/** A copy of a mesh of triangles, with its normals if it has any. Throws Failure(Internal) for other cells. */
itk::TriangleSurface::Pointer
PolyDataToSurface(vtkPolyData * mesh);

} // namespace rhombic

#endif
