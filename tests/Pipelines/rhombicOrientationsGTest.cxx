#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanToLattice.h"
#include "rhombicReadScan.h"

#include "itkImageAlgorithm.h"
#include "itkTriangleSurfaceMeasures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <set>

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

/** What is known about a surface, in LPS millimetres. */
struct Measures
{
  std::array<double, 3> lowest;
  std::array<double, 3> highest;
  double area;
  double volume;
};

Measures
MeasureBrain(const fs::path & path, double density, const std::string & isovalue)
{
  rhombic::Scan scan = rhombic::ReadScan(path);
  scan.image = PutIntoAir(*std::get<ImageType::Pointer>(scan.image));
  rhombic::LatticeSettings settings;
  settings.density = density;
  const auto volume = rhombic::ScanToLattice(scan, settings, {});
  const auto surfaces = rhombic::LatticeToSurfaces(
    volume, { rhombic::ParseSurfaceRequest("brain=" + isovalue, 0) }, itk::FCCIsosurfaceMode::Lean, {});
  const itk::TriangleSurface & brain = *surfaces.front().surface;
  Measures measures{ {}, {}, ComputeArea(brain), ComputeVolume(brain) };
  measures.lowest.fill(std::numeric_limits<double>::max());
  measures.highest.fill(std::numeric_limits<double>::lowest());
  for (const auto & point : brain.GetPoints())
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      measures.lowest[axis] = std::min<double>(measures.lowest[axis], point[axis]);
      measures.highest[axis] = std::max<double>(measures.highest[axis], point[axis]);
    }
  }
  return measures;
}

struct Sampling
{
  double density;
  const char * isovalue;
  double box; ///< how far the box's sides may be from each other, in mm; a voxel has 2.4
  double area;
  double volume; ///< relative
};

// The lattice's sites lie differently in each of them, so the surfaces are samplings of the same one, not the same:
// what is allowed is what was measured and a little more, and shrinks with the sampling distance. Any mistake with
// axes, flips or positions is far more.
constexpr Sampling samplings[] = {
  { 0.77, "20.5", 0.75, 0.004, 0.0015 },
  { 0.77, "40.5", 0.75, 0.015, 0.002 },
  { 4.0, "20.5", 0.03, 0.003, 0.0002 },
};

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
  for (const Sampling & sampling : samplings)
  {
    const std::string name = "density " + std::to_string(sampling.density) + " isovalue " + sampling.isovalue;
    SCOPED_TRACE(name);
    const Measures reference = MeasureBrain(folder / "RAS.nii.gz", sampling.density, sampling.isovalue);
    double box = 0.0;
    double area = 0.0;
    double volume = 0.0;
    for (const fs::path & file : files)
    {
      const Measures measures = MeasureBrain(file, sampling.density, sampling.isovalue);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        box = std::max(box, std::abs(measures.lowest[axis] - reference.lowest[axis]));
        box = std::max(box, std::abs(measures.highest[axis] - reference.highest[axis]));
      }
      area = std::max(area, std::abs(measures.area / reference.area - 1.0));
      volume = std::max(volume, std::abs(measures.volume / reference.volume - 1.0));
    }
    EXPECT_LE(box, sampling.box);
    EXPECT_LE(area, sampling.area);
    EXPECT_LE(volume, sampling.volume);
    RecordProperty(
      name, "box " + std::to_string(box) + " mm, area " + std::to_string(area) + ", volume " + std::to_string(volume));
  }
}

} // namespace
