#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanToLattice.h"
#include "rhombicSurfaceDeviation.h"
#include "rhombicSurfaceMeasures.h"

#include "itkImageRegionIteratorWithIndex.h"
#include "itkMath.h"
#include "itkMultiThreaderBase.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using ImageType = itk::Image<float, 3>;
using PointType = itk::Point<double, 3>;
using Mode = itk::FCCIsosurfaceMode;
using rhombic::SurfaceRequest;

constexpr Mode AllModes[] = { Mode::Tetrahedra, Mode::Octahedra, Mode::Parallelepipeds, Mode::Fine, Mode::Lean };

enum class Slices
{
  Even,
  Tilted,
  Uneven
};

/** A scan around the world's origin in a rotated frame, sampled from \a field(point). */
template <typename TField>
rhombic::Scan
MakeScan(const TField & field, const itk::Size<3> & size, Slices slices = Slices::Even)
{
  const auto image = ImageType::New();
  image->SetRegions(size);
  image->Allocate();
  const double spacing[3] = { 0.8, 0.7, 1.1 };
  image->SetSpacing(spacing);
  ImageType::DirectionType direction; // a rotation by 30 degrees about x
  direction.SetIdentity();
  direction[1][1] = direction[2][2] = std::sqrt(0.75);
  direction[2][1] = 0.5;
  direction[1][2] = slices == Slices::Even ? -0.5 : 0.0;
  direction[2][2] = slices == Slices::Even ? std::sqrt(0.75) : 1.0;
  image->SetDirection(direction);
  itk::Vector<double, 3> half;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    half[axis] = 0.5 * spacing[axis] * (static_cast<double>(size[axis]) - 1.0);
  }
  image->SetOrigin(PointType(0.0) - direction * half);

  rhombic::Scan scan;
  scan.image = image;
  const double sliceStep[3] = { direction[0][2], direction[1][2], direction[2][2] };
  PointType origin = image->GetOrigin();
  for (itk::SizeValueType slice = 0; slices == Slices::Uneven && slice < size[2]; ++slice)
  {
    scan.sliceOrigins.push_back(origin);
    origin += itk::Vector<double, 3>(sliceStep) * (slice < size[2] / 2 ? 0.8 : 1.4);
  }
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    PointType point;
    image->TransformIndexToPhysicalPoint(it.GetIndex(), point);
    if (!scan.sliceOrigins.empty())
    {
      const auto slice = static_cast<std::size_t>(it.GetIndex()[2]);
      itk::Index<3> first{ { 0, 0, it.GetIndex()[2] } };
      PointType evenOrigin;
      image->TransformIndexToPhysicalPoint(first, evenOrigin);
      point += scan.sliceOrigins[slice] - evenOrigin;
    }
    it.Set(static_cast<float>(field(point)));
  }
  return scan;
}

constexpr double Radius = 15.0;

double
Cone(const PointType & point)
{
  return 100.0 - point.GetVectorFromOrigin().GetNorm();
}

rhombic::SceneSurface
ExtractFrom(const rhombic::Scan & scan, double isovalue, Mode mode, bool hasGrid = true)
{
  SurfaceRequest request;
  request.name = "it";
  request.isovalue = isovalue;
  const auto volume = rhombic::ScanToLattice(scan, {}, {});
  const auto * const grid = hasGrid && !rhombic::IsSlanted(scan) ? &rhombic::GeometryOf(scan.image) : nullptr;
  return rhombic::LatticeToSurfaces(volume, { request }, mode, {}, grid).front();
}

/** A sphere of triangles facing outwards, all corners at the radius. */
itk::TriangleSurface::Pointer
MakeSphere(double radius)
{
  const auto sphere = itk::TriangleSurface::New();
  constexpr std::uint32_t rings = 60;
  constexpr std::uint32_t sectors = 120;
  const auto add = [&](double polar, double azimuth) {
    sphere->GetPoints().push_back({ static_cast<float>(radius * std::sin(polar) * std::cos(azimuth)),
                                    static_cast<float>(radius * std::sin(polar) * std::sin(azimuth)),
                                    static_cast<float>(radius * std::cos(polar)) });
  };
  add(0.0, 0.0);
  for (std::uint32_t ring = 1; ring < rings; ++ring)
  {
    for (std::uint32_t sector = 0; sector < sectors; ++sector)
    {
      add(itk::Math::pi * ring / rings, 2.0 * itk::Math::pi * sector / sectors);
    }
  }
  add(itk::Math::pi, 0.0);
  const auto at = [](std::uint32_t ring, std::uint32_t sector) {
    return ring == 0 ? 0 : ring == rings ? 1 + (rings - 1) * sectors : 1 + (ring - 1) * sectors + sector % sectors;
  };
  for (std::uint32_t ring = 0; ring < rings; ++ring)
  {
    for (std::uint32_t sector = 0; sector < sectors; ++sector)
    {
      if (ring > 0)
      {
        sphere->GetTriangles().push_back({ at(ring, sector), at(ring + 1, sector), at(ring, sector + 1) });
      }
      if (ring + 1 < rings)
      {
        sphere->GetTriangles().push_back({ at(ring, sector + 1), at(ring + 1, sector), at(ring + 1, sector + 1) });
      }
    }
  }
  return sphere;
}

TEST(SurfaceWalls, AreOnTheScansBorder)
{
  // A rod along the slices' normal from one side of the scan to the other.
  const auto rod = [](const PointType & point) {
    const double alongY = std::sqrt(0.75) * point[1] + 0.5 * point[2];
    return 8.0 - std::hypot(point[0], alongY);
  };
  for (const itk::SizeValueType slices : { 7u, 20u, 31u })
  {
    const auto scan = MakeScan(rod, { { 30, 34, slices } });
    for (const Mode mode : AllModes)
    {
      const auto closed = ExtractFrom(scan, 0.0, mode);
      EXPECT_TRUE(ComputeTriangleSurfaceTopology(*closed.surface).IsWatertight()) << mode;
      const double volume = itk::Math::pi * 64.0 * 1.1 * static_cast<double>(slices);
      EXPECT_NEAR(ComputeTriangleSurfaceVolume(*closed.surface) / volume, 1.0, 0.008)
        << mode << ", " << slices << " slices";
    }
  }
}

TEST(SurfaceWalls, KeepNoiseWatertight)
{
  std::mt19937 random(4);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  for (int trial = 0; trial < 4; ++trial)
  {
    const auto scan =
      MakeScan([&](const PointType &) { return noise(random); }, { { 11u + static_cast<unsigned int>(trial), 14, 9 } });
    for (const Mode mode : AllModes)
    {
      const auto topology = ComputeTriangleSurfaceTopology(*ExtractFrom(scan, 0.1, mode).surface);
      EXPECT_TRUE(topology.IsWatertight()) << mode << ": " << topology;
    }
  }
}

TEST(SurfaceMeasures, AreThoseOfABallOfKnownValues)
{
  const double volume = 4.0 / 3.0 * itk::Math::pi * Radius * Radius * Radius;
  for (const Slices slices : { Slices::Even, Slices::Tilted, Slices::Uneven })
  {
    const auto scan = MakeScan(Cone, { { 48, 56, 40 } }, slices);
    const auto ball = ExtractFrom(scan, 100.0 - Radius, Mode::Fine);
    const auto measures = rhombic::MeasureSurface(*ball.surface, scan);
    const double tolerance = slices == Slices::Even ? 0.001 : 0.004;
    EXPECT_NEAR(measures.volume / volume, 1.0, tolerance);
    EXPECT_NEAR(measures.area / (4.0 * itk::Math::pi * Radius * Radius), 1.0, 0.005);
    EXPECT_NEAR(measures.longestDiameter, 2.0 * Radius, 0.1);
    EXPECT_NEAR(*measures.meanValue, 100.0 - 0.75 * Radius, 0.05); // the mean distance in a ball is 3/4 of its radius
    EXPECT_NEAR(*measures.standardDeviation, Radius * std::sqrt(0.6 - 0.5625), 0.05);
    EXPECT_NEAR(*measures.voxelVolume / volume, 1.0, 0.005);
    EXPECT_NEAR(rhombic::CountVoxelVolume(scan, { 100.0 - Radius, false }) / volume, 1.0, 0.005);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(measures.centroid[axis], 0.0, 0.03);
      EXPECT_NEAR(measures.bounds[2 * axis], -Radius, 0.1);
      EXPECT_NEAR(measures.bounds[2 * axis + 1], Radius, 0.1);
    }
  }
}

// At the default density, a sphere of 27 samples' radius and a torus with a tube of 10 (a vertebra, a large vessel).
// What is left is the chords' error, which falls with the square of the radius.
TEST(SurfaceMeasures, AreThoseOfASphereAndATorus)
{
  constexpr double sphereRadius = 21.3;
  constexpr double ringRadius = 18.0;
  constexpr double tubeRadius = 9.0;
  const auto sphere = [](const PointType & p) { return sphereRadius - p.GetVectorFromOrigin().GetNorm(); };
  const auto torus = [](const PointType & p) {
    return tubeRadius - std::hypot(std::hypot(p[0], p[1]) - ringRadius, p[2]);
  };
  const auto check = [](const rhombic::Scan & scan, double volume, double area) {
    for (const Mode mode : AllModes)
    {
      const auto measures = rhombic::MeasureSurface(*ExtractFrom(scan, 0.0, mode).surface, scan);
      const bool isAccurate = mode == Mode::Lean || mode == Mode::Fine;
      EXPECT_NEAR(measures.volume / volume, 1.0, isAccurate ? 0.001 : 0.004) << mode;
      EXPECT_NEAR(measures.area / area, 1.0, 0.005) << mode;
      EXPECT_NEAR(*measures.voxelVolume / volume, 1.0, 0.005) << mode;
    }
  };
  constexpr double pi = itk::Math::pi;
  check(MakeScan(sphere, { { 58, 66, 42 } }),
        4.0 / 3.0 * pi * sphereRadius * sphereRadius * sphereRadius,
        4.0 * pi * sphereRadius * sphereRadius);
  check(MakeScan(torus, { { 74, 84, 54 } }),
        2.0 * pi * pi * ringRadius * tubeRadius * tubeRadius,
        4.0 * pi * pi * ringRadius * tubeRadius);
}

TEST(SurfaceMeasures, ErrorIsOfTheIsosurfaceOrElseOfTheVoxels)
{
  rhombic::SurfaceMeasures measures;
  measures.volume = 101.0;
  EXPECT_FALSE(measures.GetVolumeError()) << "nothing to compare with";
  measures.voxelVolume = 100.0;
  EXPECT_NEAR(*measures.GetVolumeError(), 1.0, 1e-9);
  measures.isosurface = rhombic::IsosurfaceVolume{ 202.0, 1.0 };
  EXPECT_NEAR(*measures.GetVolumeError(), -50.0, 1e-9);
}

TEST(SurfaceDeviation, IsTheDistanceBetweenTwoSpheres)
{
  for (const Slices slices : { Slices::Even, Slices::Tilted, Slices::Uneven })
  {
    const auto scan = MakeScan(Cone, { { 52, 60, 44 } }, slices);
    for (const double offset : { -1.0, -0.3, 0.0, 0.01, 0.6 })
    {
      // Centres of triangles lie a little inside the sphere.
      const auto deviation = rhombic::ComputeDeviation(
        *MakeSphere(Radius + offset), scan, itk::SeparableKernel::CubicBSpline, { 100.0 - Radius, false });
      EXPECT_EQ(deviation.unresolved, 0u);
      EXPECT_TRUE(deviation.isComplete);
      EXPECT_NEAR(deviation.bias, offset, 0.012) << offset;
      EXPECT_NEAR(deviation.mean, std::abs(offset), 0.012) << offset;
      EXPECT_NEAR(deviation.percentile95, std::abs(offset), 0.03) << offset;
      EXPECT_NEAR(deviation.maximum, std::abs(offset), 0.04) << offset;
    }
  }
}

TEST(SurfaceDeviation, BelowTheIsovalueOutsideIsTheOtherWay)
{
  const auto scan = MakeScan([](const PointType & p) { return -Cone(p); }, { { 52, 60, 44 } });
  const auto deviation = rhombic::ComputeDeviation(
    *MakeSphere(Radius + 0.5), scan, itk::SeparableKernel::CubicBSpline, { Radius - 100.0, true });
  EXPECT_NEAR(deviation.bias, 0.5, 0.012);
}

TEST(SurfaceDeviation, WhereThereIsNoSurfaceItIsUnresolved)
{
  const auto scan = MakeScan(Cone, { { 52, 60, 44 } });
  const auto deviation =
    rhombic::ComputeDeviation(*MakeSphere(8.0), scan, itk::SeparableKernel::CubicBSpline, { 100.0 - Radius, false });
  EXPECT_EQ(deviation.unresolved, deviation.samples);
  EXPECT_GT(deviation.samples, 1000u);
}

TEST(SurfaceDeviation, WallsAreNotCounted)
{
  const auto slope = [](const PointType & point) { return point[0]; };
  const auto scan = MakeScan(slope, { { 30, 30, 30 } });
  const auto half = ExtractFrom(scan, 0.25, Mode::Lean);
  const auto deviation =
    rhombic::ComputeDeviation(*half.surface, scan, itk::SeparableKernel::CubicBSpline, { 0.25, false });
  EXPECT_GT(deviation.samples, 500u);
  EXPECT_LT(deviation.maximum, 1e-4);
  EXPECT_EQ(deviation.unresolved, 0u);
}

TEST(SurfaceDeviation, IsTheSameForAnyNumberOfThreadsAndNearlyFromAPart)
{
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.3);
  const auto scan = MakeScan([&](const PointType & p) { return Cone(p) + noise(random); }, { { 48, 56, 40 } });
  const auto ball = ExtractFrom(scan, 100.0 - Radius, Mode::Lean);
  const auto measure = [&](std::size_t most) {
    return rhombic::ComputeDeviation(
      *ball.surface, scan, itk::SeparableKernel::CubicBSpline, { 100.0 - Radius, false }, most);
  };
  const auto threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
  const auto one = measure(1'000'000);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(3);
  const auto three = measure(1'000'000);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
  EXPECT_EQ(one.mean, three.mean);
  EXPECT_EQ(one.maximum, three.maximum);
  EXPECT_EQ(one.percentile95, three.percentile95);
  const auto part = measure(2000);
  EXPECT_FALSE(part.isComplete);
  EXPECT_LE(part.samples, 2000u);
  EXPECT_NEAR(part.mean, one.mean, 0.2 * one.mean);
}

} // namespace
