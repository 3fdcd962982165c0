#include "rhombicFailure.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanToLattice.h"

#include "itkImageRegionIteratorWithIndex.h"
#include "itkMath.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using ImageType = itk::Image<std::int16_t, 3>;
using PointType = itk::Point<double, 3>;

constexpr double radius = 20.0;

/** A ball about the origin, 1000 in air of -1000, in slices tilted by 15 degrees. */
rhombic::Scan
MakeBall(bool isUneven)
{
  const auto image = ImageType::New();
  image->SetRegions(itk::Size<3>{ { 64, 64, 40 } });
  image->Allocate();
  ImageType::DirectionType direction;
  direction.SetIdentity();
  direction[1][2] = std::sin(itk::Math::pi / 12.0);
  direction[2][2] = std::cos(itk::Math::pi / 12.0);
  image->SetDirection(direction);
  const double spacing[3] = { 1.0, 1.0, 1.5 };
  image->SetSpacing(spacing);

  std::vector<PointType> origins(1);
  const double first[3] = { -32.0, -32.0 - 30.0 * direction[1][2], -30.0 * direction[2][2] };
  origins[0] = PointType(first);
  while (origins.size() < 40)
  {
    PointType next = origins.back();
    const double step = !isUneven ? 1.5 : (origins.size() < 20 ? 1.0 : 2.0);
    next[1] += step * direction[1][2];
    next[2] += step * direction[2][2];
    origins.push_back(next);
  }
  image->SetOrigin(origins[0]);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    PointType point = origins[static_cast<std::size_t>(it.GetIndex()[2])];
    point[0] += static_cast<double>(it.GetIndex()[0]);
    point[1] += static_cast<double>(it.GetIndex()[1]);
    const double depth = radius - point.GetVectorFromOrigin().GetNorm();
    it.Set(static_cast<std::int16_t>(std::lround(1000.0 * std::erf(depth / 2.0))));
  }
  rhombic::Scan scan;
  scan.image = image;
  if (isUneven)
  {
    scan.sliceOrigins = origins;
  }
  return scan;
}

TEST(SlantedScan, ABallComesOutRound)
{
  for (const bool isUneven : { false, true })
  {
    const auto volume = rhombic::ScanToLattice(MakeBall(isUneven), {}, {});
    const auto surfaces = rhombic::LatticeToSurfaces(
      volume, { rhombic::ParseSurfaceRequest("ball=0.5", 0) }, itk::FCCIsosurfaceMode::Fine, {});
    const auto & ball = *surfaces.front().surface;
    EXPECT_TRUE(ComputeTriangleSurfaceTopology(ball).IsWatertight());
    EXPECT_NEAR(
      ComputeTriangleSurfaceVolume(ball) / (4.0 / 3.0 * itk::Math::pi * radius * radius * radius), 1.0, 0.005);
    double farthest = 0.0;
    double nearest = 2.0 * radius;
    for (const auto & point : ball.GetPoints())
    {
      const double distance = std::hypot(point[0], point[1], point[2]);
      farthest = std::max(farthest, distance);
      nearest = std::min(nearest, distance);
    }
    EXPECT_GT(nearest, radius - 0.05);
    EXPECT_LT(farthest, radius + 0.05);
  }
}

TEST(SlantedScan, WhatIsBesideItIsAir)
{
  const auto volume = rhombic::ScanToLattice(MakeBall(false), {}, {});
  const auto & image = *std::get<itk::FCCImage<std::int16_t>::Pointer>(volume);
  EXPECT_EQ(image.GetPixel({ { 0, 0, 0 } }), -1000);
  const auto last = image.GetBufferedRegion().GetSize(1) - 1;
  EXPECT_EQ(image.GetPixel({ { 0, static_cast<itk::IndexValueType>(last), 0 } }), -1000)
    << "the shear leaves this free";
}

TEST(SlantedScan, HasNoNestedLattice)
{
  rhombic::LatticeSettings settings;
  settings.nested = true;
  for (const bool isUneven : { false, true })
  {
    try
    {
      rhombic::ScanToLattice(MakeBall(isUneven), settings, {});
      FAIL();
    }
    catch (const rhombic::Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Usage);
      EXPECT_NE(std::string(failure.GetDescription()).find("--nested"), std::string::npos);
    }
  }
}

} // namespace
