#include "itkFCCIsosurfaceFilter.h"

#include "itkFCCTestImages.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using fcctest::ImageType;
using Filter = itk::FCCIsosurfaceFilter<ImageType>;
using Mode = itk::FCCIsosurfaceMode;
using Surface = itk::TriangleSurface;

constexpr double pi = 3.14159265358979323846;

struct Options
{
  double isovalue = 0.0;
  bool insideIsBelow = false;
  bool closed = true;
  unsigned int workUnits = 2;
};

Surface::Pointer
Extract(const ImageType * image, Mode mode, const Options & options)
{
  const auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetMode(mode);
  filter->SetIsovalue(options.isovalue);
  filter->SetInsideIsBelow(options.insideIsBelow);
  filter->SetClosed(options.closed);
  filter->SetNumberOfWorkUnits(options.workUnits);
  filter->Update();
  Surface::Pointer surface = filter->GetOutput();
  surface->DisconnectPipeline();
  return surface;
}

Surface::Pointer
Extract(const ImageType * image, Mode mode, double isovalue)
{
  Options options;
  options.isovalue = isovalue;
  return Extract(image, mode, options);
}

/** A box of any small size, now and then more than two words of bits long, and often one sample thick. */
ImageType::RegionType
RandomRegion(std::mt19937 & random)
{
  ImageType::RegionType region;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const unsigned int longest = axis == 0 && random() % 40 == 0 ? 140 : 9;
    region.SetIndex(axis, static_cast<itk::IndexValueType>(random() % 7) - 3);
    region.SetSize(axis, random() % 8 == 0 ? 1 : 1 + random() % longest);
  }
  return region;
}

/** Noise, checkerboards or a constant, with not-a-number and infinite values in some. */
ImageType::Pointer
RandomImage(const ImageType::RegionType & region, unsigned int seed, int levels)
{
  std::mt19937 random(seed);
  const auto image = fcctest::MakeNoise(region, seed, levels);
  const unsigned int content = random() % 8;
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, region); !it.IsAtEnd(); ++it)
  {
    const auto & index = it.GetIndex();
    switch (content)
    {
      case 0:
        it.Set(static_cast<float>((index[0] + index[1] + index[2]) & 1));
        break;
      case 1:
        it.Set(static_cast<float>((index[0] + index[2]) & 1));
        break;
      case 2:
        it.Set(1.0f);
        break;
      case 3:
        it.Set(random() % 6 == 0 ? std::numeric_limits<float>::quiet_NaN() : it.Get());
        it.Set(random() % 9 == 0 ? std::numeric_limits<float>::infinity() : it.Get());
        break;
      default:
        break;
    }
  }
  ImageType::DirectionType direction;
  direction.Fill(0.0);
  const unsigned int rotation = random() % 3;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    direction[(axis + rotation) % 3][axis] = random() % 2 == 0 ? -1.0 : 1.0; // left-handed ones, too
  }
  image->SetDirection(direction);
  const double spacing[3] = { 0.4, 0.9, 1.3 };
  image->SetSpacing(spacing);
  return image;
}

class FCCCellMarching : public testing::TestWithParam<Mode>
{};

TEST_P(FCCCellMarching, AnyInputGivesAWatertightSurface)
{
  std::mt19937 random(11);
  for (unsigned int trial = 0; trial < 1500; ++trial)
  {
    const auto region = RandomRegion(random);
    const int levels = 2 + static_cast<int>(random() % 5);
    const auto image = RandomImage(region, trial, levels);
    Options options;
    options.isovalue = static_cast<double>(random() % static_cast<unsigned int>(levels)); // equal to many samples
    options.insideIsBelow = random() % 2 == 0;
    options.workUnits = 1 + random() % 3;
    const auto surface = Extract(image, GetParam(), options);
    const auto topology = ComputeTriangleSurfaceTopology(*surface);
    ASSERT_TRUE(topology.IsWatertight()) << "trial " << trial << ": " << region << topology;
    ASSERT_EQ(topology.unusedPoints, 0u);
    if (surface->GetNumberOfTriangles() > 0)
    {
      ASSERT_GT(ComputeTriangleSurfaceVolume(*surface), 0.0) << "trial " << trial;
    }
  }
}

// Along every edge of the mode between two samples the surface has a point when one is inside, and none otherwise: so
// what is inside of the samples is inside of the surface.
TEST_P(FCCCellMarching, EveryCutEdgeHasAPoint)
{
  std::mt19937 random(12);
  // Edges 1 to 6 are the nearest neighbours, 1, 3 and 5 those along the parallelepipeds.
  const unsigned int typeStep = GetParam() == Mode::Octahedra ? 1 : 2;
  for (unsigned int trial = 0; trial < 100; ++trial)
  {
    const auto region = RandomRegion(random);
    const auto image = fcctest::MakeNoise(region, trial, 2);
    const auto isInside = [&](const itk::FCCLattice::SiteType & site) {
      const auto index = itk::FCCLattice::IndexOf(site);
      return region.IsInside(index) && image->GetPixel(index) >= 1.0f;
    };
    itk::SizeValueType cut = 0;
    const auto first = itk::FCCLattice::SiteOf(region.GetIndex());
    const auto last = itk::FCCLattice::SiteOf(region.GetUpperIndex());
    for (auto z = first[2] - 2; z <= last[2] + 2; ++z)
    {
      for (auto y = first[1] - 2; y <= last[1] + 2; ++y)
      {
        for (auto x = first[0] - 3; x <= last[0] + 3; ++x)
        {
          for (unsigned int type = 1; type < 7 && itk::FCCLattice::IsSite({ x, y, z }); type += typeStep)
          {
            const auto & step = itk::FCCLattice::OwnedEdges[type];
            cut += isInside({ x, y, z }) != isInside({ x + step[0], y + step[1], z + step[2] }) ? 1 : 0;
          }
        }
      }
    }
    ASSERT_EQ(Extract(image, GetParam(), 1.0)->GetNumberOfPoints(), cut) << region;
  }
}

TEST_P(FCCCellMarching, ASingleSampleIsASmallPolyhedron)
{
  const auto image = fcctest::MakeNoise({ { { 0, 0, 0 } }, { { 5, 6, 7 } } }, 1, 2);
  image->FillBuffer(0.0f);
  image->SetPixel({ { 2, 3, 3 } }, 1.0f);
  const auto surface = Extract(image, GetParam(), 0.5);
  const auto topology = ComputeTriangleSurfaceTopology(*surface);
  EXPECT_TRUE(topology.IsWatertight());
  EXPECT_EQ(topology.eulerCharacteristic, 2);
  if (GetParam() == Mode::Octahedra)
  {
    EXPECT_EQ(surface->GetNumberOfPoints(), 12u);
    EXPECT_EQ(surface->GetNumberOfTriangles(), 20u) << "a cuboctahedron";
    EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface), 20.0 / 3.0 / 8.0, 1e-5); // edge sqrt(2) / 2
  }
  else
  {
    EXPECT_EQ(surface->GetNumberOfPoints(), 6u);
    EXPECT_EQ(surface->GetNumberOfTriangles(), 8u) << "a sheared octahedron";
    EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface), 4.0 / 3.0 / 8.0 * 2.0, 1e-5); // the shear has determinant 2
  }
}

TEST_P(FCCCellMarching, TrianglesPerAreaAreThoseOfTheEdges)
{
  const double radius = 24.0;
  const double s = std::cbrt(0.5); // one sample per unit of volume
  const auto image =
    fcctest::MakeImage(s, radius + 2.0, [radius](const auto & p) { return fcctest::Sphere(p, radius); });
  const auto surface = Extract(image, GetParam(), 0.0);
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*surface).IsWatertight());
  const double perArea = static_cast<double>(surface->GetNumberOfTriangles()) / (4.0 * pi * radius * radius);
  const double edges = GetParam() == Mode::Octahedra ? 6.0 : 3.0;
  EXPECT_NEAR(perArea / (edges * std::sqrt(2.0) * s), 1.0, 0.01);
  EXPECT_NEAR(perArea / (GetParam() == Mode::Octahedra ? 6.735 : 3.367), 1.0, 0.01);
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface) / (4.0 / 3.0 * pi * radius * radius * radius), 1.0, 0.003);
}

TEST_P(FCCCellMarching, OpenSurfacesEndAtTheOutermostWholeCells)
{
  const auto image = fcctest::MakeImage(0.5, 4.0, [](const auto & p) { return 0.3 * p[0] + 0.5 * p[1] + p[2]; });
  Options options;
  options.isovalue = 0.1;
  options.closed = false;
  const auto surface = Extract(image, GetParam(), options);
  const auto topology = ComputeTriangleSurfaceTopology(*surface);
  EXPECT_GT(topology.boundaryEdges, 0u);
  EXPECT_EQ(topology.nonManifoldEdges + topology.misorientedEdges + topology.degenerateTriangles, 0u) << topology;
  EXPECT_EQ(topology.unusedPoints, 0u);
  for (const auto & point : surface->GetPoints())
  {
    ASSERT_NEAR(0.3 * point[0] + 0.5 * point[1] + point[2], 0.1, 1e-3);
  }
}

TEST_P(FCCCellMarching, NoiseLeftOpenHasManifoldEdges)
{
  std::mt19937 random(5);
  for (unsigned int trial = 0; trial < 200; ++trial)
  {
    const auto image = fcctest::MakeNoise(RandomRegion(random), trial, 3);
    Options options;
    options.isovalue = 1.0;
    options.closed = false;
    const auto topology = ComputeTriangleSurfaceTopology(*Extract(image, GetParam(), options));
    ASSERT_EQ(topology.nonManifoldEdges + topology.misorientedEdges + topology.degenerateTriangles, 0u) << topology;
    ASSERT_EQ(topology.unusedPoints, 0u);
  }
}

TEST_P(FCCCellMarching, GivesTheSameBytesForAnyNumberOfThreads)
{
  const auto image = fcctest::MakeNoise({ { { 0, 0, 0 } }, { { 70, 40, 50 } } }, 3, 50);
  Options options;
  options.isovalue = 25.0;
  options.workUnits = 1;
  const auto single = Extract(image, GetParam(), options);
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*single).IsWatertight());
  for (const unsigned int units : { 2u, 3u, 4u, 61u })
  {
    options.workUnits = units;
    const auto many = Extract(image, GetParam(), options);
    ASSERT_EQ(single->GetPoints(), many->GetPoints());
    ASSERT_EQ(single->GetNormals(), many->GetNormals());
    ASSERT_EQ(single->GetTriangles(), many->GetTriangles());
  }
}

std::string
NameOf(const testing::TestParamInfo<Mode> & info)
{
  std::ostringstream name;
  name << info.param;
  return name.str();
}

INSTANTIATE_TEST_SUITE_P(Modes, FCCCellMarching, testing::Values(Mode::Octahedra, Mode::Parallelepipeds), NameOf);

} // namespace
