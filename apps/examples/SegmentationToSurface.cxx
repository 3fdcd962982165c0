// Grows a region in a scan around a point with a filter of ITK, and makes a smooth closed surface of the mask.

#include "exampleInput.h"
#include "itkAntiAliasMaskImageFilter.h"
#include "itkCartesianToFCCImageFilter.h"
#include "itkConfidenceConnectedImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkTriangleSurfaceAudit.h"
#include "rhombicSurfaceIO.h"

#include <algorithm>
#include <iostream>

int
main(int argc, char ** argv)
try
{
  if (argc != 7)
  {
    throw std::runtime_error("usage: SegmentationToSurface SCAN X Y Z MULTIPLIER OUTPUT.stl");
  }
  using MaskType = itk::Image<std::uint8_t, 3>;
  const itk::Point<double, 3> point = example::ParsePoint(argv + 2);
  const auto multiplier = example::ParseNumber<double>("MULTIPLIER", argv[5], 0.0);
  const auto segment = [&](const auto & image) {
    using ImageType = typename std::decay_t<decltype(image)>::ObjectType;
    typename ImageType::IndexType seed;
    if (!image->TransformPhysicalPointToIndex(point, seed))
    {
      throw std::invalid_argument("The point X Y Z is outside of the scan; give one inside, in LPS millimetres");
    }
    const auto filter = itk::ConfidenceConnectedImageFilter<ImageType, MaskType>::New();
    filter->SetInput(image);
    filter->SetSeed(seed);
    filter->SetInitialNeighborhoodRadius(3);
    filter->SetNumberOfIterations(2);
    filter->SetMultiplier(multiplier);
    filter->Update();
    return MaskType::Pointer(filter->GetOutput());
  };
  const MaskType::Pointer mask = std::visit(segment, example::ReadEvenScan(argv[1]).image);
  const auto antiAlias = itk::AntiAliasMaskImageFilter::New(); // 0 on the border of the mask, without its steps
  antiAlias->SetInput(mask);
  const auto toLattice = itk::CartesianToFCCImageFilter<itk::Image<float, 3>>::New();
  toLattice->SetInput(antiAlias->GetOutput());
  const auto extract = itk::FCCIsosurfaceFilter<itk::FCCImage<float>>::New();
  extract->SetInput(toLattice->GetOutput());
  extract->Update();
  rhombic::WriteSurfaces({ { "region", extract->GetOutput() } }, argv[6]);
  const itk::TriangleSurfaceAudit audit = itk::AuditTriangleSurface(*extract->GetOutput());
  const std::uint8_t * const voxels = mask->GetBufferPointer();
  std::cout << "voxels: " << std::count(voxels, voxels + mask->GetBufferedRegion().GetNumberOfPixels(), 1)
            << "\nvolume: " << audit.volume / 1000.0 << " ml\nwatertight: " << audit.IsWatertight() << '\n';
}
catch (const std::exception & error)
{
  return example::Report(error);
}
