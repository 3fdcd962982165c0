#include "rhombicLatticeToSurfaces.h"
#include "rhombicPatientAxes.h"
#include "rhombicScanToLattice.h"
#include "rhombicReadScan.h"

#include "itkImageAlgorithm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

namespace fs = std::filesystem;

namespace
{

using ImageType = itk::Image<float, 3>;

/** The image with air around it: the brain is cut off by the scan's sides, where the surface is closed, and that is as
 * precise as the lattice is fine. */
ImageType::Pointer
PutIntoAir(const ImageType & image)
{
  constexpr itk::SizeValueType margin = 4;
  const ImageType::RegionType region = image.GetLargestPossibleRegion();
  const ImageType::RegionType inner({ { margin, margin, margin } }, region.GetSize());
  const auto result = ImageType::New();
  ImageType::SizeType size = region.GetSize();
  for (auto & count : size)
  {
    count += 2 * margin;
  }
  ImageType::IndexType corner = region.GetIndex();
  corner -= inner.GetIndex() - ImageType::IndexType{ { 0, 0, 0 } };
  ImageType::PointType origin;
  image.TransformIndexToPhysicalPoint(corner, origin);
  result->SetRegions(size);
  result->SetOrigin(origin);
  result->SetSpacing(image.GetSpacing());
  result->SetDirection(image.GetDirection());
  result->Allocate(true);
  itk::ImageAlgorithm::Copy(&image, result.GetPointer(), region, inner);
  return result;
}

itk::TriangleSurface::ConstPointer
ExtractBrain(const fs::path & path, double density, const std::string & isovalue)
{
  rhombic::Scan scan = rhombic::ReadScan(path);
  scan.image = PutIntoAir(*std::get<ImageType::Pointer>(scan.image));
  rhombic::LatticeSettings settings;
  settings.density = density;
  const auto volume = rhombic::ScanToLattice(rhombic::OrderAlongPatient(scan), settings, {});
  const auto surfaces = rhombic::LatticeToSurfaces(
    volume, { rhombic::ParseSurfaceRequest("brain=" + isovalue, 0) }, itk::FCCIsosurfaceMode::Lean, {});
  return surfaces.front().surface;
}

/** The largest distance between points of the same number, in mm. */
double
FindLargestDistance(const itk::TriangleSurface & first, const itk::TriangleSurface & second)
{
  double largest = 0.0;
  for (std::size_t point = 0; point < first.GetPoints().size(); ++point)
  {
    double squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      squared += std::pow(static_cast<double>(first.GetPoints()[point][axis]) - second.GetPoints()[point][axis], 2);
    }
    largest = std::max(largest, std::sqrt(squared));
  }
  return largest;
}

TEST(Orientations, TheSameBrainStoredIn48WaysHasTheSameSurface)
{
  const char * const scans = std::getenv("RHOMBIC_SCANS");
  const fs::path folder = fs::path(scans == nullptr ? "" : scans) / "nifti_orientations_48";
  if (scans == nullptr || !fs::exists(folder))
  {
    GTEST_SKIP() << "RHOMBIC_SCANS is not set, or has no " << folder.filename();
  }
  std::set<fs::path> files;
  for (const auto & entry : fs::directory_iterator(folder))
  {
    if (entry.path().extension() == ".gz")
    {
      files.insert(entry.path());
    }
  }
  ASSERT_EQ(files.size(), 48u);
  for (const auto & [density, isovalue] :
       { std::pair{ 0.77, "20.5" }, std::pair{ 0.77, "40.5" }, std::pair{ 4.0, "20.5" } })
  {
    const auto reference = ExtractBrain(folder / "LPS.nii.gz", density, isovalue);
    for (const fs::path & file : files)
    {
      SCOPED_TRACE(file.stem().string() + " density " + std::to_string(density) + " isovalue " + isovalue);
      const auto brain = ExtractBrain(file, density, isovalue);
      ASSERT_EQ(brain->GetPoints().size(), reference->GetPoints().size());
      ASSERT_EQ(brain->GetTriangles(), reference->GetTriangles());
      EXPECT_LT(FindLargestDistance(*brain, *reference), 0.001); // positions in the files' affines are float
    }
  }
}

} // namespace
