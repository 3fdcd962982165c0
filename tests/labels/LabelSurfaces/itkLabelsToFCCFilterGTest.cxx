#include "itkLabelsToFCCFilter.h"

#include "itkCastImageFilter.h"
#include "itkFCCLabelSurfaceFilter.h"
#include "itkImageRegionConstIteratorWithIndex.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkMultiThreaderBase.h"
#include "itkRefusal.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"
#include "rhombicScan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

namespace
{

using Filter = itk::LabelsToFCCFilter;
using LabelImage = Filter::InputImageType;
using Point = LabelImage::PointType;

LabelImage::Pointer
MakeMap(const LabelImage::SizeType & size, double slices, const std::function<int(const Point &)> & labelAt)
{
  const auto image = LabelImage::New();
  image->SetRegions(LabelImage::RegionType({ { 3, -2, 1 } }, size));
  const double spacing[3] = { 1.0, 1.0, slices };
  image->SetSpacing(spacing);
  Point origin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double first = static_cast<double>(image->GetLargestPossibleRegion().GetIndex(axis));
    origin[axis] = -spacing[axis] * (first + 0.5 * static_cast<double>(size[axis] - 1));
  }
  image->SetOrigin(origin);
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<LabelImage> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<std::uint16_t>(labelAt(image->TransformIndexToPhysicalPoint<double>(it.GetIndex()))));
  }
  return image;
}

itk::LabelWalls::Pointer
MakeWalls(const LabelImage * map,
          const Filter::SliceOriginsType & origins = {},
          unsigned int threads = 0,
          double density = itk::FCCLattice::DefaultDensity,
          const Filter::GroupsType & groups = {})
{
  const auto toLattice = Filter::New();
  toLattice->SetInput(map);
  toLattice->SetDensity(density);
  toLattice->SetSliceOrigins(origins);
  toLattice->SetGroups(groups);
  if (threads > 0)
  {
    toLattice->SetNumberOfWorkUnits(threads);
  }
  toLattice->Update();
  const auto surfaces = itk::FCCLabelSurfaceFilter::New();
  surfaces->SetInput(toLattice->GetOutput());
  surfaces->SetWeights(toLattice->GetWeights());
  surfaces->Update();
  itk::LabelWalls::Pointer walls = surfaces->GetOutput();
  walls->DisconnectPipeline();
  return walls;
}

/** Two half balls that touch in the plane x = 0.3. */
int
HalfBalls(const Point & p, double radius)
{
  return p.GetVectorFromOrigin().GetNorm() > radius ? 0 : p[0] < 0.3 ? 4 : 9;
}

double
Volume(const itk::LabelWalls & walls, std::uint16_t label)
{
  return itk::ComputeTriangleSurfaceVolume(*walls.ExtractLabel(label));
}

TEST(LabelsToFCCFilter, HalfBallsShareTheirWallAndKeepTheirVolumes)
{
  constexpr double radius = 14.0;
  const auto ball = [](const Point & p) { return HalfBalls(p, radius); };
  const double volume = 4.0 / 3.0 * 3.14159265 * radius * radius * radius;
  for (const double slices : { 1.0, 3.0, 5.0 })
  {
    const auto walls = MakeWalls(MakeMap({ { 40, 38, static_cast<itk::SizeValueType>(40.0 / slices) } }, slices, ball));
    EXPECT_EQ(walls->FindLabels(), (std::vector<std::uint16_t>{ 4, 9 }));
    double distance = 0.0;
    double area = 0.0;
    for (std::size_t n = 0; n < walls->GetNumberOfTriangles(); ++n)
    {
      Point points[3];
      Point middle(0.0);
      for (unsigned int corner = 0; corner < 3; ++corner)
      {
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          points[corner][axis] = walls->GetPoints()[walls->GetTriangles()[n][corner]][axis];
          middle[axis] += points[corner][axis] / 3.0;
        }
      }
      const double size = 0.5 * itk::CrossProduct(points[1] - points[0], points[2] - points[0]).GetNorm();
      const bool isOuter = walls->GetTriangleLabels()[n][0] == 0;
      distance += size * std::abs(isOuter ? middle.GetVectorFromOrigin().GetNorm() - radius : middle[0] - 0.3);
      area += size;
    }
    EXPECT_LT(distance / area, slices < 2.0 ? 0.1 : slices < 4.0 ? 0.2 : 0.35) << slices;
    EXPECT_NEAR((Volume(*walls, 4) + Volume(*walls, 9)) / volume, 1.0, slices < 2.0 ? 0.005 : 0.03) << slices;
    for (const std::uint16_t label : { 4, 9 })
    {
      const auto topology = itk::ComputeTriangleSurfaceTopology(*walls->ExtractLabel(label));
      EXPECT_TRUE(topology.IsWatertight()) << topology;
      EXPECT_EQ(topology.components, 1u);
    }
  }
}

/** Slanted layers in a ball: what a layer gains its neighbours lose. */
TEST(LabelsToFCCFilter, StackedLayersKeepTheirVolumes)
{
  for (const double slices : { 1.0, 6.0 })
  {
    const auto map =
      MakeMap({ { 44, 44, static_cast<itk::SizeValueType>(44.0 / slices) } }, slices, [](const Point & p) {
        const double height = 0.48 * p[0] + 0.36 * p[1] + 0.8 * p[2];
        return p.GetVectorFromOrigin().GetNorm() > 20.0 ? 0 : static_cast<int>(std::floor((height + 20.0) / 5.0)) + 1;
      });
    std::array<std::size_t, 9> voxels{};
    for (std::size_t n = 0; n < map->GetBufferedRegion().GetNumberOfPixels(); ++n)
    {
      ++voxels[map->GetBufferPointer()[n]];
    }
    const auto walls = MakeWalls(map);
    for (std::uint16_t label = 1; label < voxels.size(); ++label)
    {
      const double volume = slices * static_cast<double>(voxels[label]);
      EXPECT_NEAR(Volume(*walls, label) / volume, 1.0, 0.01) << label << " in slices of " << slices << " mm";
    }
  }
}

/** The sites' labels are those of largest weight. */
TEST(LabelsToFCCFilter, LabelsHaveTheLargestWeight)
{
  const auto map = MakeMap({ { 24, 24, 24 } }, 1.0, [](const Point & p) {
    return (p[0] > 0.0 ? 1 : 0) + (p[1] > 2.0 ? 2 : 0) + (p[2] > -1.0 ? 4 : 0);
  });
  const auto filter = Filter::New();
  filter->SetInput(map);
  filter->Update();
  const auto & labels = *filter->GetOutput();
  const auto & region = labels.GetLargestPossibleRegion();
  ASSERT_GT(filter->GetWeights()->GetNumberOfWeights(), 1000u);
  for (itk::ImageRegionConstIteratorWithIndex<Filter::LatticeType> it(&labels, region); !it.IsAtEnd(); ++it)
  {
    const auto offset = it.GetIndex() - region.GetIndex();
    const auto row =
      static_cast<itk::SizeValueType>(offset[2]) * region.GetSize(1) + static_cast<itk::SizeValueType>(offset[1]);
    const float * const own = filter->GetWeights()->Find(row, static_cast<std::uint32_t>(offset[0]), it.Get());
    for (const auto & entry : filter->GetWeights()->GetRow(row))
    {
      if (entry.i == static_cast<std::uint32_t>(offset[0]))
      {
        EXPECT_GE(own != nullptr ? *own : itk::FCCLabelWeights::Limit, entry.weight);
      }
    }
  }
}

TEST(LabelsToFCCFilter, VesselsOneVoxelWideStay)
{
  const auto map = MakeMap({ { 30, 30, 30 } }, 1.0, [](const Point & p) {
    const bool isVessel = std::abs(p[1] - 0.37 * p[0]) <= 0.5 && std::abs(p[2] - 0.5) < 0.3;
    return isVessel ? 2 : p.GetVectorFromOrigin().GetNorm() < 11.0 ? 1 : 0;
  });
  for (const double density : { itk::FCCLattice::DefaultDensity, 2.0, 4.0 })
  {
    const auto vessel = MakeWalls(map, {}, 0, density)->ExtractLabel(2);
    EXPECT_EQ(itk::ComputeTriangleSurfaceTopology(*vessel).components, 1u) << density;
  }
}

/** Sheets one voxel thick, in any direction, have no holes. */
TEST(LabelsToFCCFilter, SheetsOneVoxelThickAreDisks)
{
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (unsigned int n = 0; n < 12; ++n)
  {
    double slopes[3] = { normal(random), normal(random), normal(random) };
    const double steepest =
      *std::max_element(slopes, slopes + 3, [](double a, double b) { return std::abs(a) < std::abs(b); });
    const auto map = MakeMap({ { 36, 36, 36 } }, 1.0, [&](const Point & p) {
      const double offset = (slopes[0] * p[0] + slopes[1] * p[1] + slopes[2] * p[2]) / steepest;
      return offset > -0.5 && offset <= 0.5 && p.GetVectorFromOrigin().GetNorm() < 15.0 ? 7 : 0;
    });
    const auto topology = itk::ComputeTriangleSurfaceTopology(*MakeWalls(map)->ExtractLabel(7));
    EXPECT_TRUE(topology.IsWatertight()) << topology;
    EXPECT_EQ(topology.components, 1u) << n;
    EXPECT_EQ(topology.eulerCharacteristic, 2) << n;
  }
}

/** The mean angle in degrees between facets of a plate and its plane, away from its rim. */
double
MeanAngleOfPlate(const itk::LabelWalls & walls, const itk::Vector<double, 3> & normal)
{
  double angle = 0.0;
  double area = 0.0;
  for (const auto & triangle : walls.GetTriangles())
  {
    Point points[3];
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        points[corner][axis] = walls.GetPoints()[triangle[corner]][axis];
      }
    }
    const auto facet = itk::CrossProduct(points[1] - points[0], points[2] - points[0]);
    if (facet.GetNorm() > 0.0 && points[0].GetVectorFromOrigin().GetNorm() < 10.0)
    {
      angle += facet.GetNorm() * std::acos(std::min(1.0, std::abs(facet * normal) / facet.GetNorm()));
      area += facet.GetNorm();
    }
  }
  return angle / area * 180.0 / 3.14159265;
}

/** Plates of 1 to 2.5 voxels in random directions. With tubes around their voxels, and with a Gaussian of 0.7 voxels,
 * the angles were 25, 16, 8.2 and 7.2 degrees; they are 20, 11, 7.3 and 5.5. */
TEST(LabelsToFCCFilter, ThinPlatesAreEven)
{
  const double limits[][2] = { { 1.0, 22.0 }, { 1.5, 13.0 }, { 2.0, 7.7 }, { 2.5, 6.2 } };
  for (const auto & [thickness, limit] : limits)
  {
    std::mt19937 random(5);
    std::normal_distribution<double> coordinate;
    double angle = 0.0;
    constexpr unsigned int plates = 6;
    for (unsigned int n = 0; n < plates; ++n)
    {
      itk::Vector<double, 3> normal;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        normal[axis] = coordinate(random);
      }
      normal.Normalize();
      const auto map = MakeMap({ { 40, 40, 40 } }, 1.0, [&, half = 0.5 * thickness](const Point & p) {
        const auto place = p.GetVectorFromOrigin();
        return std::abs(place * normal - 0.1) <= half && place.GetNorm() < 15.0 ? 7 : 0;
      });
      angle += MeanAngleOfPlate(*MakeWalls(map), normal) / plates;
    }
    EXPECT_LT(angle, limit) << thickness;
  }
}

/** Voxels, bars and blobs far from each other: each is one piece and has its volume. */
TEST(LabelsToFCCFilter, SpecksOfAnySizeStay)
{
  std::mt19937 random(4);
  std::uniform_int_distribution<int> edge(1, 4);
  int edges[27][3];
  for (auto & speck : edges)
  {
    for (int & length : speck)
    {
      length = edge(random);
    }
  }
  const auto map = MakeMap({ { 36, 36, 36 } }, 1.0, [&](const Point & p) {
    int speck = 0;
    bool isIn = true;
    for (unsigned int axis = 0, factor = 1; axis < 3; ++axis, factor *= 3)
    {
      speck += static_cast<int>(factor) * static_cast<int>((p[axis] + 18.0) / 12.0);
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      isIn =
        isIn && std::fmod(p[axis] + 18.0, 12.0) >= 3.0 && std::fmod(p[axis] + 18.0, 12.0) < 3.0 + edges[speck][axis];
    }
    return isIn ? speck + 1 : 0;
  });
  const auto walls = MakeWalls(map);
  for (std::uint16_t speck = 0; speck < 27; ++speck)
  {
    const auto surface = walls->ExtractLabel(static_cast<std::uint16_t>(speck + 1));
    const auto topology = itk::ComputeTriangleSurfaceTopology(*surface);
    EXPECT_EQ(topology.components, 1u) << speck;
    EXPECT_EQ(topology.eulerCharacteristic, 2) << speck;
    const double volume = edges[speck][0] * edges[speck][1] * edges[speck][2];
    EXPECT_NEAR(itk::ComputeTriangleSurfaceVolume(*surface) / volume, 1.0, 0.05) << volume;
  }
}

/** A map that is full to its border is closed at the outer faces of its voxels. */
TEST(LabelsToFCCFilter, LabelsDoNotMeetAcrossBackground)
{
  std::mt19937 random(4096);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double slices : { 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 3.0, 3.0, 3.0, 5.0, 5.0, 5.0 })
  {
    // Two halves of a block with a slanted, curved gap about a voxel wide between them.
    const double slope = 0.5 * uniform(random);
    const double turn = 0.5 * uniform(random);
    const double bow = 0.01 * uniform(random);
    const double width = 0.6 + 0.08 * uniform(random);
    const auto map =
      MakeMap({ { 28, 28, static_cast<itk::SizeValueType>(28.0 / slices) } }, slices, [&](const Point & p) {
        const double height = p[0] - slope * p[1] - turn * p[2] / slices - bow * p[1] * p[1];
        const double far = std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) });
        return far > 11.0 || std::abs(height) < width ? 0 : height < 0.0 ? 4 : 9;
      });
    bool touch = false; // by faces of voxels
    for (itk::ImageRegionConstIteratorWithIndex<LabelImage> it(map, map->GetBufferedRegion()); !it.IsAtEnd(); ++it)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        auto next = it.GetIndex();
        ++next[axis];
        const int other = map->GetBufferedRegion().IsInside(next) ? map->GetPixel(next) : 0;
        touch = touch || (it.Get() != 0 && other != 0 && other != it.Get());
      }
    }
    const auto walls = MakeWalls(map);
    const auto & sides = walls->GetTriangleLabels();
    const auto shared =
      std::count_if(sides.begin(), sides.end(), [](const auto & pair) { return pair[0] != 0 && pair[1] != 0; });
    EXPECT_EQ(walls->FindLabels(), (std::vector<std::uint16_t>{ 4, 9 }));
    EXPECT_FALSE(touch);
    EXPECT_EQ(shared, 0) << slices << " mm, slope " << slope << ", turn " << turn << ", width " << width;
  }
}

TEST(LabelsToFCCFilter, LabelsEndAtTheBorderOfTheMap)
{
  const auto map = MakeMap({ { 12, 10, 4 } }, 3.0, [](const Point & p) { return p[0] < 0.0 ? 1 : 2; });
  const auto walls = MakeWalls(map);
  const auto bounds = walls->GetBounds();
  const double half[3] = { 6.0, 5.0, 6.0 };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(bounds[2 * axis], -half[axis], 0.2);
    EXPECT_NEAR(bounds[2 * axis + 1], half[axis], 0.2);
  }
  EXPECT_NEAR(Volume(*walls, 1) + Volume(*walls, 2), 12.0 * 10.0 * 12.0, 0.03 * 12.0 * 10.0 * 12.0);
}

/** A map whose slices are at uneven steps and lean, and its slice origins. */
struct SlantedMap
{
  LabelImage::Pointer image;
  Filter::SliceOriginsType origins;

  SlantedMap(const LabelImage::SizeType & size, double slices)
    : image(MakeMap(size, slices, [](const Point &) { return 0; }))
  {
    for (itk::SizeValueType slice = 0; slice < size[2]; ++slice)
    {
      origins.push_back(image->TransformIndexToPhysicalPoint<double>(image->GetLargestPossibleRegion().GetIndex()));
      const double even = slices * static_cast<double>(slice);
      origins.back()[2] += even + (slice % 3 == 0 ? 0.2 * slices : 0.0);
      origins.back()[0] += 0.25 * even - 4.0;
    }
  }

  /** Sets the label of each voxel by its place. */
  void
  SetLabels(const std::function<int(const Point &)> & labelAt)
  {
    for (itk::ImageRegionIteratorWithIndex<LabelImage> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
    {
      const auto offset = it.GetIndex() - image->GetLargestPossibleRegion().GetIndex();
      Point point = origins[static_cast<std::size_t>(offset[2])];
      point[0] += static_cast<double>(offset[0]);
      point[1] += static_cast<double>(offset[1]);
      it.Set(static_cast<std::uint16_t>(labelAt(point)));
    }
  }
};

TEST(LabelsToFCCFilter, UnevenAndSlantedSlicesAreWhereTheyAre)
{
  constexpr double radius = 12.0;
  SlantedMap map({ { 44, 34, 12 } }, 3.0);
  map.SetLabels([](const Point & p) { return HalfBalls(p, radius); });
  const auto walls = MakeWalls(map.image, map.origins);
  const double volume = 4.0 / 3.0 * 3.14159265 * radius * radius * radius;
  EXPECT_NEAR((Volume(*walls, 4) + Volume(*walls, 9)) / volume, 1.0, 0.05);
  const auto bounds = walls->GetBounds();
  for (unsigned int side = 0; side < 6; ++side)
  {
    EXPECT_NEAR(bounds[side], side % 2 == 0 ? -radius : radius, 1.0) << side;
  }
}

/** Each is a label, is one piece at its place, and has the volume of its voxels. */
TEST(LabelsToFCCFilter, UnevenSlicesBehindAFilterAreRefusedWithoutTheScan)
{
  SlantedMap map({ { 44, 34, 12 } }, 3.0);
  map.SetLabels([](const Point & p) { return HalfBalls(p, 12.0); });
  const auto direct = MakeWalls(map.image, map.origins);
  rhombic::Scan scan;
  scan.image = map.image;
  scan.sliceOrigins = map.origins;
  rhombic::AttachPlacement(scan);
  const auto cast = itk::CastImageFilter<LabelImage, LabelImage>::New();
  cast->InPlaceOff();
  cast->SetInput(map.image);
  const auto toLattice = Filter::New();
  toLattice->SetInput(cast->GetOutput());
  EXPECT_NE(Refusal([&] { toLattice->Update(); }).find("SetScan"), std::string::npos);
  toLattice->SetScan(scan);
  const auto extract = itk::FCCLabelSurfaceFilter::New();
  extract->SetInput(toLattice->GetOutput());
  extract->SetWeights(toLattice->GetWeights());
  extract->Update();
  EXPECT_EQ(Volume(*extract->GetOutput(), 4), Volume(*direct, 4));
  EXPECT_EQ(Volume(*extract->GetOutput(), 9), Volume(*direct, 9));
}

TEST(LabelsToFCCFilter, SpecksInSlantedSlicesStay)
{
  SlantedMap map({ { 48, 48, 48 } }, 1.0);
  std::vector<Point> middles(217, Point(0.0));
  std::vector<double> voxels(217);
  for (itk::ImageRegionIteratorWithIndex<LabelImage> it(map.image, map.image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto offset = it.GetIndex() - map.image->GetLargestPossibleRegion().GetIndex();
    const bool isIn = offset[0] % 8 < 3 && offset[1] % 8 < 2 && offset[2] % 8 < 4;
    if (isIn)
    {
      const auto speck = static_cast<std::uint16_t>(1 + offset[0] / 8 + 6 * (offset[1] / 8) + 36 * (offset[2] / 8));
      it.Set(speck);
      const Point & first = map.origins[static_cast<std::size_t>(offset[2])];
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        middles[speck][axis] += first[axis] + (axis < 2 ? static_cast<double>(offset[axis]) : 0.0);
      }
      ++voxels[speck];
    }
  }
  const auto toLattice = Filter::New();
  toLattice->SetInput(map.image);
  toLattice->SetSliceOrigins(map.origins);
  toLattice->Update();
  const auto walls = MakeWalls(map.image, map.origins);
  for (std::uint16_t speck = 1; speck <= 216; ++speck)
  {
    const auto surface = walls->ExtractLabel(speck);
    EXPECT_EQ(itk::ComputeTriangleSurfaceTopology(*surface).eulerCharacteristic, 2) << speck;
    EXPECT_NEAR(itk::ComputeTriangleSurfaceVolume(*surface) / toLattice->GetVoxelVolumes()[speck], 1.0, 0.01) << speck;
    const auto bounds = surface->GetBounds();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]), middles[speck][axis] / voxels[speck], 0.6) << speck;
    }
  }
}

TEST(LabelsToFCCFilter, ThinPartsInSlantedSlicesAreWhole)
{
  // A sheet and a helix that are one voxel thick, in directions of voxels.
  SlantedMap map({ { 40, 40, 40 } }, 1.0);
  const auto first = map.image->GetLargestPossibleRegion().GetIndex();
  for (const double slope : { -0.7, 0.0, 0.4 })
  {
    map.SetLabels([](const Point &) { return 0; });
    for (int y = 2; y < 38; ++y)
    {
      for (int z = 2; z < 38; ++z)
      {
        const auto x = static_cast<int>(std::lround(20.0 + 0.4 * (y - 20.0) + slope * (z - 20.0)));
        if (x >= 2 && x < 38)
        {
          map.image->SetPixel(first + itk::Offset<3>{ { x, y, z } }, 7);
        }
      }
    }
    const auto topology = itk::ComputeTriangleSurfaceTopology(*MakeWalls(map.image, map.origins)->ExtractLabel(7));
    EXPECT_TRUE(topology.IsWatertight()) << topology;
    EXPECT_EQ(topology.components, 1u) << slope;
    EXPECT_EQ(topology.eulerCharacteristic, 2) << slope;
  }
  map.SetLabels([](const Point &) { return 0; });
  for (double t = 0.0; t < 18.0; t += 0.002)
  {
    const itk::Offset<3> place{
      { std::lround(20.0 + 14.0 * std::cos(t)), std::lround(20.0 + 14.0 * std::sin(t)), std::lround(3.0 + 1.9 * t) }
    };
    map.image->SetPixel(first + place, 3);
  }
  const auto topology = itk::ComputeTriangleSurfaceTopology(*MakeWalls(map.image, map.origins)->ExtractLabel(3));
  EXPECT_TRUE(topology.IsWatertight()) << topology;
  EXPECT_EQ(topology.components, 1u);
}

TEST(LabelsToFCCFilter, BytesDoNotDependOnThreads)
{
  const auto map = MakeMap({ { 30, 28, 9 } }, 3.0, [](const Point & p) {
    return HalfBalls(p, 10.0) != 0 && p[2] > 2.0 ? 3 : HalfBalls(p, 10.0);
  });
  const auto one = MakeWalls(map, {}, 1);
  for (const unsigned int threads : { 2, 3, 8 })
  {
    const auto several = MakeWalls(map, {}, threads);
    EXPECT_EQ(one->GetPoints(), several->GetPoints());
    EXPECT_EQ(one->GetTriangles(), several->GetTriangles());
  }
}

/** Thin parts, pieces of labels and labels that touch, which are settled one after another. */
TEST(LabelsToFCCFilter, BytesOfThinPartsAndPiecesDoNotDependOnThreads)
{
  std::mt19937 random(17);
  const auto map = MakeMap({ { 40, 40, 40 } }, 1.0, [&](const Point & p) {
    const bool isSheet = std::abs(p[2] - 0.3 * p[0]) <= 0.5;
    const bool isSpeck = random() % 60 == 0;
    return isSheet ? 1 : isSpeck ? 2 + static_cast<int>(random() % 12) : HalfBalls(p, 9.0);
  });
  const Filter::GroupsType groups{ 0, 1, 2, 2, 3, 2, 2, 2, 3, 3, 3, 3, 3, 3 };
  const auto make = [&](itk::ThreadIdType threads) {
    const auto before = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    auto walls = MakeWalls(map, {}, threads, itk::FCCLattice::DefaultDensity, groups);
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(before);
    return walls;
  };
  const auto one = make(1);
  for (const itk::ThreadIdType threads : { 2, 3, 8 })
  {
    const auto several = make(threads);
    EXPECT_EQ(one->GetPoints(), several->GetPoints());
    EXPECT_EQ(one->GetTriangles(), several->GetTriangles());
    EXPECT_EQ(one->GetTriangleLabels(), several->GetTriangleLabels());
  }
}

TEST(LabelsToFCCFilter, RefusesWrongSettings)
{
  const auto map = MakeMap({ { 4, 4, 4 } }, 1.0, [](const Point &) { return 1; });
  EXPECT_THROW(MakeWalls(map, Filter::SliceOriginsType(3)), itk::ExceptionObject);
  EXPECT_THROW(MakeWalls(MakeMap({ { 150000, 1, 1 } }, 1.0, [](const Point &) { return 1; })), itk::ExceptionObject);
  const auto filter = Filter::New();
  filter->SetInput(map);
  filter->SetDensity(0.0);
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
}

} // namespace
