// Reads a scan, resamples it onto the face-centered cubic lattice, saves it there, and reads it back.

#include "exampleInput.h"
#include "itkCartesianToFCCImageFilter.h"
#include "rhombicFCCImageFile.h"

#include <iostream>

namespace
{

/** The scan on the lattice, in its own pixel type. */
rhombic::FCCVolume
Resample(const rhombic::Scan & scan)
{
  return std::visit(
    [&scan](const auto & image) -> rhombic::FCCVolume {
      using ImageType = typename std::decay_t<decltype(image)>::ObjectType;
      const auto filter = itk::CartesianToFCCImageFilter<ImageType>::New();
      filter->SetInput(image);
      filter->SetScan(scan); // the places of unevenly spaced slices
      filter->Update();
      return itk::SmartPointer<itk::FCCImage<typename ImageType::PixelType>>(filter->GetOutput());
    },
    scan.image);
}

} // namespace

int
main(int argc, char ** argv)
try
{
  if (argc != 3)
  {
    throw std::runtime_error("usage: ResampleAndSave SCAN OUTPUT.fcc.nrrd");
  }
  example::RequireOther(argv[2], { argv[1] });
  const rhombic::Scan scan = example::ReadScan(argv[1]);
  rhombic::WriteFCCImage(Resample(scan), argv[2]);
  const rhombic::FCCVolume volume = rhombic::ReadFCCImage(argv[2]);
  const auto voxels = rhombic::GeometryOf(scan.image).GetLargestPossibleRegion().GetNumberOfPixels();
  const auto sites =
    std::visit([](const auto & image) { return image->GetLargestPossibleRegion().GetNumberOfPixels(); }, volume);
  std::cout << "voxels: " << voxels << "\nsites: " << sites << '\n';
}
catch (const std::exception & error)
{
  return example::Report(error);
}
