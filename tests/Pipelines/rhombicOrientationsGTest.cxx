#include "rhombicFailure.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicPatientAxes.h"
#include "rhombicScanToLattice.h"
#include "rhombicReadScan.h"

#include "itkImageAlgorithm.h"
#include "itkEuler3DTransform.h"
#include "itkImageRegionIterator.h"
#include "itkImageRegionConstIteratorWithIndex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
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

/** Directions of scans: all orders and signs of axes, turned by up to 45 degrees; left-handed ones too. */
itk::Matrix<double, 3, 3>
MakeDirection(std::mt19937 & random)
{
  std::array<unsigned int, 3> order{ 0, 1, 2 };
  std::shuffle(order.begin(), order.end(), random);
  itk::Matrix<double, 3, 3> axes;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    axes[axis][order[axis]] = random() % 2 == 0 ? 1.0 : -1.0;
  }
  const auto turn = itk::Euler3DTransform<double>::New();
  const double quarter = itk::Math::pi_over_4;
  const auto angle = [&] {
    return random() % 4 == 0 ? quarter : std::uniform_real_distribution<>(-quarter, quarter)(random);
  };
  turn->SetRotation(angle(), angle(), angle());
  return turn->GetMatrix() * axes;
}

TEST(Orientations, OrderedAxesRunAlongThePatientAndSamplesStay)
{
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial)
  {
    SCOPED_TRACE(trial);
    const auto image = ImageType::New();
    image->SetRegions(itk::Size<3>{ { 2 + random() % 4, 2 + random() % 4, 2 + random() % 4 } });
    const double spacing[] = { 0.5, 1.25, 3.0 };
    const double origin[] = { -20.0, 7.5, 100.0 };
    image->SetSpacing(spacing);
    image->SetOrigin(origin);
    image->SetDirection(MakeDirection(random));
    image->Allocate();
    float value = 0.0f;
    for (itk::ImageRegionIterator<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
    {
      it.Set(++value);
    }
    rhombic::Scan scan;
    scan.image = image;
    if (trial == 0)
    {
      EXPECT_THROW(rhombic::OrderAlongPatient(scan, 1), rhombic::Failure) << "its copies need more than a byte";
    }
    const auto ordered = std::get<ImageType::Pointer>(rhombic::OrderAlongPatient(scan).image);
    ASSERT_EQ(ordered->GetBufferedRegion().GetNumberOfPixels(), image->GetBufferedRegion().GetNumberOfPixels());
    for (itk::ImageRegionConstIteratorWithIndex<ImageType> it(ordered, ordered->GetBufferedRegion()); !it.IsAtEnd();
         ++it)
    {
      const auto position = ordered->TransformIndexToPhysicalPoint<double>(it.GetIndex());
      const auto index = image->TransformPhysicalPointToIndex(position);
      ASSERT_TRUE(image->GetBufferedRegion().IsInside(index));
      EXPECT_LT(position.EuclideanDistanceTo(image->TransformIndexToPhysicalPoint<double>(index)), 1e-9);
      EXPECT_EQ(it.Get(), image->GetPixel(index));
    }
    double sum = 0.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      EXPECT_GE(ordered->GetDirection()[axis][axis], 0.0);
      sum += ordered->GetDirection()[axis][axis];
    }
    EXPECT_GT(sum, 1.7) << "no other order of axes is closer";
  }
}

} // namespace
