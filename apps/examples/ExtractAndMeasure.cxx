// Extracts an isosurface from a scan, or from a volume that is on the lattice already, and measures it.

#include "exampleInput.h"
#include "itkCartesianToFCCImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkTriangleSurfaceAudit.h"
#include "itkTriangleSurfaceFinishFilter.h"
#include "itkTriangleSurfaceMeasures.h"
#include "rhombicFCCImageFile.h"
#include "rhombicSurfaceIO.h"

#include <iostream>

int
main(int argc, char ** argv)
try
{
  if (argc != 4)
  {
    throw std::runtime_error("usage: ExtractAndMeasure SCAN THRESHOLD OUTPUT.stl");
  }
  const double threshold = example::ParseNumber<double>("THRESHOLD", argv[2]);
  const auto extract = [threshold](const auto & lattice) {
    const auto filter = itk::FCCIsosurfaceFilter<typename std::decay_t<decltype(lattice)>::ObjectType>::New();
    filter->SetInput(lattice);
    filter->SetIsovalue(threshold);
    const auto finish = itk::TriangleSurfaceFinishFilter::New(); // triangles of thin parts may cross
    finish->SetInput(filter->GetOutput());
    finish->SetSpacing(0.5 * lattice->GetSpacing()[0]);
    finish->Update();
    return itk::TriangleSurface::Pointer(finish->GetOutput());
  };
  const auto resampleAndExtract = [&extract](const rhombic::Scan & scan) {
    const auto resample = [&](const auto & image) {
      using FilterType = itk::CartesianToFCCImageFilter<typename std::decay_t<decltype(image)>::ObjectType>;
      const auto filter = FilterType::New();
      filter->SetInput(image);
      filter->SetScan(scan); // the places of unevenly spaced slices
      filter->Update();
      return extract(typename FilterType::OutputImageType::Pointer(filter->GetOutput()));
    };
    return std::visit(resample, scan.image);
  };
  const itk::TriangleSurface::Pointer surface = rhombic::IsFCCImageFile(argv[1])
                                                  ? std::visit(extract, rhombic::ReadFCCImage(argv[1]))
                                                  : resampleAndExtract(example::ReadScan(argv[1]));
  rhombic::WriteSurfaces({ { "surface", surface } }, argv[3]);
  const auto center = itk::ComputeTriangleSurfaceCentroid(*surface);
  const itk::TriangleSurfaceAudit audit = itk::AuditTriangleSurface(*surface);
  std::cout << "volume: " << audit.volume / 1000.0 << " ml\narea: " << audit.area / 100.0
            << " cm^2\ncentre: " << center[0] << ' ' << center[1] << ' ' << center[2]
            << " mm\nwatertight: " << audit.IsWatertight() << '\n';
}
catch (const std::exception & error)
{
  return example::Report(error);
}
