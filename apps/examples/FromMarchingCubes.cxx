// An isosurface as vtkPolyData, beside that of vtkFlyingEdges3D: modules/surfaces/SurfaceVTK/README.md explains the function.

#include "exampleInput.h"
#include "itkCartesianToFCCImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkScanFileReader.h"
#include "rhombicSurfaceToPolyData.h"

#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkShortArray.h>

#include <iostream>

vtkSmartPointer<vtkPolyData>
ExtractSurface(itk::Image<short, 3> * image, double isovalue)
{
  const auto lattice = itk::CartesianToFCCImageFilter<itk::Image<short, 3>>::New();
  lattice->SetInput(image);
  const auto surface = itk::FCCIsosurfaceFilter<itk::FCCImage<short>>::New();
  surface->SetInput(lattice->GetOutput());
  surface->SetIsovalue(isovalue);
  surface->Update();
  return rhombic::SurfaceToPolyData(surface->GetOutput());
}

int
main(int argc, char ** argv)
try
{
  if (argc != 3)
  {
    throw std::runtime_error("usage: FromMarchingCubes SCAN THRESHOLD");
  }
  const auto threshold = example::ParseNumber<double>("THRESHOLD", argv[2]);
  const auto reader = itk::ScanFileReader<itk::Image<short, 3>>::New();
  reader->SetFileName(argv[1]);
  reader->AcceptTiltedOff(); // the slices of vtkImageData are neither tilted nor unevenly spaced
  reader->Update();
  const auto image = reader->GetOutput();
  const auto & size = image->GetBufferedRegion().GetSize();
  vtkNew<vtkShortArray> values;
  values->SetArray(image->GetBufferPointer(), size[0] * size[1] * size[2], 1);
  vtkNew<vtkImageData> volume;
  volume->SetDimensions(size[0], size[1], size[2]);
  volume->SetSpacing(image->GetSpacing().GetDataPointer());
  volume->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(volume);
  edges->SetValue(0, threshold);
  edges->Update();
  std::cout << "vtkFlyingEdges3D: " << edges->GetOutput()->GetNumberOfPolys() << " triangles\n";
  std::cout << "Rhombic: " << ExtractSurface(image, threshold)->GetNumberOfPolys() << " triangles\n";
}
catch (const std::exception & error)
{
  return example::Report(error);
}
