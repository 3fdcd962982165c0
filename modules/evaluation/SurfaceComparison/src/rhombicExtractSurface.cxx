#include "rhombicExtractSurface.h"

#include "itkFCCIsosurfaceFilter.h"
#include "rhombicWording.h"
#include "rhombicFailure.h"

#include <vtkAOSDataArrayTemplate.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkFlyingEdges3D.h>
#include <vtkMarchingCubes.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <sstream>

namespace rhombic
{
namespace
{

template <typename TExtractor>
vtkSmartPointer<vtkPolyData>
Extract(vtkImageData * volume, double isovalue, bool normals)
{
  const vtkNew<TExtractor> extractor;
  extractor->SetInputData(volume);
  extractor->SetValue(0, isovalue);
  extractor->SetComputeScalars(false);
  extractor->SetComputeGradients(false);
  extractor->SetComputeNormals(normals);
  extractor->Update();
  return extractor->GetOutput();
}

} // namespace

std::string
NameOf(ExtractionMode mode)
{
  std::ostringstream name;
  name << mode;
  return LowerCase(name.str());
}

template <typename TPixel>
itk::TriangleSurface::Pointer
ExtractSurface(const itk::FCCImage<TPixel> * image, double isovalue, ExtractionMode mode, bool normals, bool closed)
{
  const auto filter = itk::FCCIsosurfaceFilter<itk::FCCImage<TPixel>>::New();
  filter->SetInput(image);
  filter->SetMode(mode);
  filter->SetComputeNormals(normals);
  filter->SetIsovalue(isovalue);
  filter->SetClosed(closed);
  filter->Update();
  return filter->GetOutput();
}

template itk::TriangleSurface::Pointer
ExtractSurface<std::int16_t>(const itk::FCCImage<std::int16_t> *, double, ExtractionMode, bool, bool);
template itk::TriangleSurface::Pointer
ExtractSurface<float>(const itk::FCCImage<float> *, double, ExtractionMode, bool, bool);

template <typename TPixel>
vtkSmartPointer<vtkImageData>
ShareWithVTK(const itk::Image<TPixel, 3> * image)
{
  constexpr int doNotFree = 1;
  const auto & size = image->GetBufferedRegion().GetSize();
  auto volume = vtkSmartPointer<vtkImageData>::New();
  volume->SetDimensions(static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2]));
  volume->SetSpacing(image->GetSpacing().GetDataPointer());
  volume->SetOrigin(image->GetOrigin().GetDataPointer());
  const vtkNew<vtkAOSDataArrayTemplate<TPixel>> pixels;
  pixels->SetArray(const_cast<TPixel *>(image->GetBufferPointer()),
                   static_cast<vtkIdType>(image->GetBufferedRegion().GetNumberOfPixels()),
                   doNotFree);
  volume->GetPointData()->SetScalars(pixels);
  return volume;
}

template vtkSmartPointer<vtkImageData>
ShareWithVTK<std::int16_t>(const itk::Image<std::int16_t, 3> *);
template vtkSmartPointer<vtkImageData>
ShareWithVTK<float>(const itk::Image<float, 3> *);

vtkSmartPointer<vtkPolyData>
ExtractWithVTK(VTKExtractor extractor, vtkImageData * volume, double isovalue, bool normals)
{
  return extractor == VTKExtractor::FlyingEdges ? Extract<vtkFlyingEdges3D>(volume, isovalue, normals)
                                                : Extract<vtkMarchingCubes>(volume, isovalue, normals);
}

itk::TriangleSurface::Pointer
PolyDataToSurface(vtkPolyData * mesh)
{
  auto surface = itk::TriangleSurface::New();
  const auto copy = [](vtkDataArray * tuples, auto & copies) {
    copies.resize(static_cast<std::size_t>(tuples->GetNumberOfTuples()));
    for (vtkIdType i = 0; i < tuples->GetNumberOfTuples(); ++i)
    {
      const double * const tuple = tuples->GetTuple3(i);
      std::transform(tuple, tuple + 3, copies[static_cast<std::size_t>(i)].begin(), [](double value) {
        return static_cast<float>(value);
      });
    }
  };
  if (mesh->GetPoints())
  {
    copy(mesh->GetPoints()->GetData(), surface->GetPoints());
  }
  if (vtkDataArray * const normals = mesh->GetPointData()->GetNormals())
  {
    copy(normals, surface->GetNormals());
  }
  surface->GetTriangles().reserve(static_cast<std::size_t>(mesh->GetNumberOfPolys()));
  const auto cells = vtk::TakeSmartPointer(mesh->GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdType count;
    const vtkIdType * points;
    cells->GetCurrentCell(count, points);
    if (count != 3)
    {
      throw Failure(FailureKind::Internal,
                    "A mesh from VTK has a cell of " + std::to_string(count) + " points; only triangles are compared.");
    }
    surface->GetTriangles().push_back({ static_cast<std::uint32_t>(points[0]),
                                        static_cast<std::uint32_t>(points[1]),
                                        static_cast<std::uint32_t>(points[2]) });
  }
  return surface;
}

} // namespace rhombic
