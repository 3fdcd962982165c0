// The surface of a scan where its values reach a threshold: an ITK pipeline from a DICOM folder or file to a mesh.

#include "itkCartesianToFCCImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkScanFileReader.h"
#include "rhombicSurfaceIO.h"

#include <iostream>

int
main(int argc, char ** argv)
try
{
  if (argc != 4)
  {
    throw std::runtime_error("usage: ScanToSurface SCAN THRESHOLD OUTPUT.stl");
  }
  using ImageType = itk::Image<short, 3>;
  const auto reader = itk::ScanFileReader<ImageType>::New();
  reader->SetFileName(argv[1]);
  reader->AcceptUnevenOn(); // no ITK image holds the places of such slices: the lattice filter has them from GetScan()
  reader->UpdateOutputInformation();
  const auto lattice = itk::CartesianToFCCImageFilter<ImageType>::New();
  lattice->SetInput(reader->GetOutput()); // or that of any filter of ITK behind it
  lattice->SetScan(reader->GetScan());
  const auto surface = itk::FCCIsosurfaceFilter<itk::FCCImage<short>>::New();
  surface->SetInput(lattice->GetOutput());
  surface->SetIsovalue(std::stod(argv[2])); // Hounsfield units
  surface->Update();
  rhombic::WriteSurfaces({ { "surface", surface->GetOutput() } }, argv[3]);
}
catch (const std::exception & error)
{
  std::cerr << rhombic::DescribeError(error) << '\n';
  return 1;
}
