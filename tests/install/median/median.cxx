#include "itkCartesianToFCCImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkScanFileReader.h"
#include "rhombicSurfaceIO.h"

#include "itkImageFileWriter.h"
#include "itkMedianImageFilter.h"

#include <iostream>

/** median SCAN FILTERED.nrrd BONE.stl: filters of ITK's other modules between those of Rhombic. */
int
main(int, char ** argv)
try
{
  using ImageType = itk::Image<short, 3>;
  const auto reader = itk::ScanFileReader<ImageType>::New();
  reader->SetFileName(argv[1]);
  const auto median = itk::MedianImageFilter<ImageType, ImageType>::New();
  median->SetInput(reader->GetOutput());
  const auto writer = itk::ImageFileWriter<ImageType>::New();
  writer->SetInput(median->GetOutput());
  writer->SetFileName(argv[2]);
  writer->Update();
  const auto lattice = itk::CartesianToFCCImageFilter<ImageType>::New();
  lattice->SetInput(median->GetOutput());
  const auto surface = itk::FCCIsosurfaceFilter<itk::FCCImage<short>>::New();
  surface->SetInput(lattice->GetOutput());
  surface->SetIsovalue(250.5); // Hounsfield units
  surface->Update();
  rhombic::WriteSurfaces({ { "bone", surface->GetOutput() } }, argv[3]);
}
catch (const std::exception & error)
{
  std::cerr << error.what() << '\n';
  return 1;
}
