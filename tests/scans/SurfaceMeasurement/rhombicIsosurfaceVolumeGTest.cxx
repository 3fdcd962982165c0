#include "rhombicSurfaceMeasures.h"

#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanToLattice.h"
#include "rhombicPhantom.h"

#include "itkImageRegionIteratorWithIndex.h"
#include "itkMath.h"
#include "itkMultiThreaderBase.h"
#include "itkTriangleSurfaceMeasures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace
{

using ImageType = itk::Image<float, 3>;
using PointType = itk::Point<double, 3>;
using Mode = itk::FCCIsosurfaceMode;
using rhombic::IsosurfaceVolume;
using rhombic::SurfaceRequest;

constexpr Mode AllModes[] = { Mode::Tetrahedra, Mode::Octahedra, Mode::Parallelepipeds, Mode::Fine, Mode::Lean };

/** A scan of 0.8 x 0.7 x 1.1 mm around the world's origin, in a frame that is rotated by 30 degrees about x. */
rhombic::Scan
MakeScan(const std::function<double(const PointType &)> & field, const itk::Size<3> & size)
{
  const auto image = ImageType::New();
  image->SetRegions(size);
  image->Allocate();
  const double spacing[3] = { 0.8, 0.7, 1.1 };
  image->SetSpacing(spacing);
  ImageType::DirectionType direction;
  direction.SetIdentity();
  direction[1][1] = direction[2][2] = std::sqrt(0.75);
  direction[2][1] = 0.5;
  direction[1][2] = -0.5;
  image->SetDirection(direction);
  itk::Vector<double, 3> half;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    half[axis] = 0.5 * spacing[axis] * (static_cast<double>(size[axis]) - 1.0);
  }
  image->SetOrigin(PointType(0.0) - direction * half);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    PointType point;
    image->TransformIndexToPhysicalPoint(it.GetIndex(), point);
    it.Set(static_cast<float>(field(point)));
  }
  rhombic::Scan scan;
  scan.image = image;
  return scan;
}

SurfaceRequest
MakeRequest(double isovalue, bool insideIsBelow = false)
{
  SurfaceRequest request;
  request.name = "it";
  request.isovalue = isovalue;
  request.insideIsBelow = insideIsBelow;
  return request;
}

/** A mesh's volume, and the isosurface's as it is estimated beside it. */
struct Volumes
{
  double mesh;
  IsosurfaceVolume isosurface;
};

Volumes
FindVolumes(const rhombic::Scan & scan, const SurfaceRequest & request, Mode mode, double density = 0.77)
{
  rhombic::LatticeSettings settings;
  settings.density = density;
  const auto lattice = rhombic::ScanToLattice(scan, settings, {});
  const auto & grid = rhombic::GeometryOf(scan.image);
  const auto surface = rhombic::LatticeToSurfaces(lattice, { request }, mode, {}, &grid).front().surface;
  return { ComputeTriangleSurfaceVolume(*surface),
           rhombic::EstimateIsosurfaceVolume(
             lattice, request.GetThreshold(), ComputeTriangleSurfaceArea(*surface), &grid) };
}

TEST(IsosurfaceVolume, IsThatOfABallWithinItsUncertainty)
{
  for (const double radius : { 6.0, 9.3, 15.0 })
  {
    const auto scan =
      MakeScan([](const PointType & p) { return -p.GetVectorFromOrigin().GetNorm(); }, { { 48, 56, 40 } });
    const double exact = 4.0 / 3.0 * itk::Math::pi * radius * radius * radius;
    for (const double density : { 0.77, 1.54, 3.0 })
    {
      const auto volumes = FindVolumes(scan, MakeRequest(-radius), Mode::Fine, density);
      EXPECT_NEAR(volumes.isosurface.volume, exact, volumes.isosurface.uncertainty) << radius << ", " << density;
      const double siteLength = std::cbrt(0.8 * 0.7 * 1.1 / density);
      EXPECT_NEAR(
        volumes.isosurface.GetRelativeUncertainty(), 0.002 + 0.73 * std::pow(siteLength / radius, 2.0), 0.002);
    }
  }
}

// A shell 1.15 voxels thick: meshes lose a part of it, each mode another one.
TEST(IsosurfaceVolume, TellsWhatMeshesLoseOfAThinShell)
{
  constexpr double radius = 13.0;
  constexpr double width = 1.5;
  constexpr double isovalue = 0.9;
  const auto scan = MakeScan(
    [](const PointType & p) {
      const double x = (p.GetVectorFromOrigin().GetNorm() - radius) / width;
      return std::exp(-x * x);
    },
    { { 48, 56, 40 } });
  const double half = width * std::sqrt(-std::log(isovalue));
  const double exact = 4.0 / 3.0 * itk::Math::pi * (std::pow(radius + half, 3.0) - std::pow(radius - half, 3.0));
  for (const Mode mode : AllModes)
  {
    const auto volumes = FindVolumes(scan, MakeRequest(isovalue), mode);
    EXPECT_LT(volumes.mesh / exact, 0.97) << mode << " loses a part";
    EXPECT_NEAR(volumes.isosurface.volume / exact, 1.0, 0.01 + volumes.isosurface.GetRelativeUncertainty()) << mode;
    EXPECT_NEAR(volumes.isosurface.GetErrorOf(volumes.mesh),
                volumes.mesh / exact - 1.0,
                0.01 + volumes.isosurface.GetRelativeUncertainty())
      << mode;
  }
}

TEST(IsosurfaceVolume, EndsWhereTheScanDoes)
{
  // A rod along the slices' normal from one side of the scan to the other.
  const auto rod = [](const PointType & point) {
    return 8.0 - std::hypot(point[0], std::sqrt(0.75) * point[1] + 0.5 * point[2]);
  };
  for (const itk::SizeValueType slices : { 7u, 20u, 31u })
  {
    const auto scan = MakeScan(rod, { { 30, 34, slices } });
    const auto inside = FindVolumes(scan, MakeRequest(0.0), Mode::Lean).isosurface;
    const double exact = itk::Math::pi * 64.0 * 1.1 * static_cast<double>(slices);
    EXPECT_NEAR(inside.volume, exact, inside.uncertainty) << slices << " slices";
    const auto outside = FindVolumes(scan, MakeRequest(0.0, true), Mode::Lean).isosurface;
    const double box = 30.0 * 34.0 * static_cast<double>(slices) * 0.8 * 0.7 * 1.1;
    EXPECT_NEAR((inside.volume + outside.volume) / box, 1.0, 0.001) << slices << " slices";
  }
}

TEST(IsosurfaceVolume, IsThatOfThePhantomsBody)
{
  constexpr double isovalue = -485.5; // half way between air and skin
  rhombic::Scan scan;
  scan.image = rhombic::MakePhantomScan({ 5.0 });
  const auto volumes = FindVolumes(scan, MakeRequest(isovalue), Mode::Lean);
  const double exact = rhombic::PhantomEnclosedBy(isovalue).volume;
  EXPECT_NEAR(volumes.isosurface.volume, exact, volumes.isosurface.uncertainty);
  EXPECT_LT(volumes.isosurface.GetRelativeUncertainty(), 0.003);
}

TEST(IsosurfaceVolume, IsTheSameForAnyNumberOfThreads)
{
  const auto scan =
    MakeScan([](const PointType & p) { return -p.GetVectorFromOrigin().GetNorm(); }, { { 48, 56, 40 } });
  const auto threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
  const auto one = FindVolumes(scan, MakeRequest(-12.0), Mode::Lean).isosurface;
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(3);
  const auto three = FindVolumes(scan, MakeRequest(-12.0), Mode::Lean).isosurface;
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
  EXPECT_EQ(one.volume, three.volume);
  EXPECT_EQ(one.uncertainty, three.uncertainty);
}

} // namespace
