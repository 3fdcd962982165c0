#include "rhombicFailure.h"
#include "rhombicFewerTriangles.h"
#include "rhombicLabelSurfaces.h"
#include "rhombicReadScan.h"

#include "detail/itkPositionArithmetic.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkMath.h"
#include "itkMultiThreaderBase.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceSolids.h"
#include "itkTriangleSurfaceTopology.h"
#include "itkTriangleTree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <random>
#include <set>

namespace
{

using ImageType = itk::Image<std::uint8_t, 3>;
using Point = itk::Point<double, 3>;
using Vector = itk::Vector<double, 3>;
using rhombic::LabelMap;
using rhombic::LabelSurface;

Point
At(double x, double y, double z)
{
  const double coordinates[3] = { x, y, z };
  return Point(coordinates);
}

/** The label at each point: 0 is the background. */
using LabelFunction = std::function<int(const Point &)>;

/** Positive inside, in mm. */
using DistanceFunction = std::function<double(const Point &)>;

LabelMap
MapOf(const rhombic::Scan & scan)
{
  LabelMap map;
  map.scan = scan;
  map.labels = rhombic::SummarizeLabels(map.scan, {});
  return map;
}

/** A label map of so many voxels around the world's origin. */
LabelMap
MakeMap(const itk::Size<3> & size, const Vector & spacing, const LabelFunction & label)
{
  const auto image = ImageType::New();
  image->SetRegions(size);
  image->SetSpacing(spacing);
  Point origin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    origin[axis] = -0.5 * spacing[axis] * static_cast<double>(size[axis] - 1);
  }
  image->SetOrigin(origin);
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<std::uint8_t>(label(image->TransformIndexToPhysicalPoint<double>(it.GetIndex()))));
  }
  rhombic::Scan scan;
  scan.image = image;
  return MapOf(scan);
}

LabelMap
MakeMap(itk::SizeValueType size, const LabelFunction & label)
{
  return MakeMap({ { size, size, size } }, Vector(1.0), label);
}

LabelFunction
Inside(const DistanceFunction & distance)
{
  return [distance](const Point & point) { return distance(point) >= 0.0 ? 1 : 0; };
}

std::vector<LabelSurface>
MakeSurfaces(const LabelMap & map, const rhombic::LabelSurfaceSettings & settings, const rhombic::Events & events)
{
  rhombic::LabelMesh mesh = rhombic::LabelsToWalls(map, settings, events);
  rhombic::ExtractSurfaces(mesh);
  return mesh.labels;
}

LabelSurface
OnlySurface(const LabelMap & map, const rhombic::LabelSurfaceSettings & settings = {})
{
  const auto surfaces = MakeSurfaces(map, settings, {});
  EXPECT_EQ(surfaces.size(), 1);
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*surfaces.front().scene.surface).IsWatertight());
  return surfaces.front();
}

/** Errors of a surface's facets against a shape, weighted by their areas. */
struct FacetErrors
{
  double distance = 0.0;      ///< mean, in mm
  double degrees = 0.0;       ///< mean of the angle between the normals
  double commonDegrees = 0.0; ///< 95 % are below
  double area = 0.0;          ///< of those facets
};

FacetErrors
CompareFacets(
  const itk::TriangleSurface & surface,
  const DistanceFunction & distance,
  const std::function<bool(const Point &)> & isCompared = [](const Point &) { return true; })
{
  FacetErrors errors;
  std::vector<std::pair<double, double>> angles;
  for (const auto & triangle : surface.GetTriangles())
  {
    Point corners[3];
    Vector middle(0.0);
    for (unsigned int n = 0; n < 3; ++n)
    {
      const auto & p = surface.GetPoints()[triangle[n]];
      corners[n] = At(p[0], p[1], p[2]);
      middle += corners[n].GetVectorFromOrigin() / 3.0;
    }
    const Point center = At(middle[0], middle[1], middle[2]);
    if (!isCompared(center))
    {
      continue;
    }
    const Vector normal = itk::CrossProduct(corners[1] - corners[0], corners[2] - corners[0]);
    Vector outwards;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      Vector step(0.0);
      step[axis] = 0.01;
      outwards[axis] = distance(center - step) - distance(center + step);
    }
    const double area = normal.GetNorm() / 2.0;
    const double cosine = normal * outwards / (normal.GetNorm() * outwards.GetNorm());
    const double degrees = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / itk::Math::pi;
    errors.area += area;
    errors.distance += area * std::abs(distance(center));
    errors.degrees += area * degrees;
    angles.emplace_back(degrees, area);
  }
  errors.distance /= errors.area;
  errors.degrees /= errors.area;
  std::sort(angles.begin(), angles.end());
  double sum = 0.0;
  for (const auto & [degrees, area] : angles)
  {
    sum += area;
    if (sum <= 0.95 * errors.area)
    {
      errors.commonDegrees = degrees;
    }
  }
  return errors;
}

DistanceFunction
Ball(const Point & center, double radius)
{
  return [=](const Point & point) { return radius - (point - center).GetNorm(); };
}

/** A torus whose axis leans 37 degrees. */
DistanceFunction
Torus(double major, double minor)
{
  return [=](const Point & point) {
    const double height = 0.8 * point[2] + 0.6 * point[0];
    const double ring = std::hypot(0.8 * point[0] - 0.6 * point[2], point[1]) - major;
    return minor - std::hypot(ring, height);
  };
}

/** A unit vector in a random direction. */
Vector
RandomDirection(std::mt19937 & random)
{
  std::normal_distribution<double> normal;
  Vector direction;
  do
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      direction[axis] = normal(random);
    }
  } while (direction.GetNorm() < 0.1);
  return direction / direction.GetNorm();
}

TEST(LabelSurfaces, BallsAreRoundWhateverTheirPlace)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  for (const double radius : { 5.0, 6.5, 9.0, 13.0, 20.0, 30.0 })
  {
    const auto distance = Ball(At(place(random), place(random), place(random)), radius);
    const auto size = static_cast<itk::SizeValueType>(2.0 * radius + 4.0);
    const LabelSurface ball = OnlySurface(MakeMap(size, Inside(distance)));
    EXPECT_LT(std::abs(ball.GetVolumeDifference()), 0.0025) << radius;
    const double trueArea = 4.0 * itk::Math::pi * radius * radius;
    EXPECT_NEAR(ComputeTriangleSurfaceArea(*ball.scene.surface) / trueArea, 1.0, 0.01) << radius;
    const FacetErrors errors = CompareFacets(*ball.scene.surface, distance);
    EXPECT_LT(errors.distance, 0.05) << radius;
    EXPECT_LT(errors.degrees, radius < 8.0 ? 4.0 : 2.5) << radius;
    EXPECT_LT(errors.commonDegrees, radius < 8.0 ? 9.0 : 6.0) << radius;
    EXPECT_EQ(ball.surfacePieces, 1);
  }
}

TEST(LabelSurfaces, ATorusKeepsItsHole)
{
  const auto distance = Torus(25.0, 7.3);
  const LabelSurface torus = OnlySurface(MakeMap(72, Inside(distance)));
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*torus.scene.surface).eulerCharacteristic, 0);
  EXPECT_LT(std::abs(torus.GetVolumeDifference()), 0.0025);
  const double trueArea = 4.0 * itk::Math::pi * itk::Math::pi * 25.0 * 7.3;
  EXPECT_NEAR(ComputeTriangleSurfaceArea(*torus.scene.surface) / trueArea, 1.0, 0.01);
  EXPECT_LT(CompareFacets(*torus.scene.surface, distance).degrees, 2.5);
}

TEST(LabelSurfaces, SlantedPlanesHaveNoSteps)
{
  std::mt19937 random(6);
  for (unsigned int n = 0; n < 6; ++n)
  {
    const Vector normal = RandomDirection(random);
    const auto plane = [&](const Point & point) { return -(point.GetVectorFromOrigin() * normal); };
    const auto ball = Ball(At(0.0, 0.0, 0.0), 30.0);
    const LabelSurface half =
      OnlySurface(MakeMap(70, Inside([&](const Point & point) { return std::min(plane(point), ball(point)); })));
    const FacetErrors errors = CompareFacets(*half.scene.surface, plane, [&](const Point & point) {
      return std::abs(plane(point)) < 1.0 && ball(point) > 6.0;
    });
    const double projected = itk::Math::pi * 24.0 * 24.0;
    EXPECT_NEAR(errors.area / projected, 1.0, 0.015) << normal;
    EXPECT_LT(errors.distance, 0.15) << normal;
    EXPECT_LT(errors.degrees, 4.0) << normal;
    EXPECT_LT(std::abs(half.GetVolumeDifference()), 0.0025);
  }
}

TEST(LabelSurfaces, SheetsOfOneVoxelAreWhole)
{
  std::mt19937 random(7);
  unsigned int withHoles = 0;
  for (unsigned int n = 0; n < 8; ++n)
  {
    // The voxels nearest to a plane along the axis that is nearest to its normal: no thicker part anywhere.
    const Vector normal = RandomDirection(random);
    unsigned int axis = 0;
    for (unsigned int other = 1; other < 3; ++other)
    {
      axis = std::abs(normal[other]) > std::abs(normal[axis]) ? other : axis;
    }
    const LabelMap map = MakeMap(48, [&](const Point & point) {
      const double offset = point.GetVectorFromOrigin() * normal / normal[axis];
      return offset > -0.5 && offset <= 0.5 && point.GetVectorFromOrigin().GetNorm() < 20.0 ? 1 : 0;
    });
    const LabelSurface sheet = OnlySurface(map);
    EXPECT_EQ(sheet.pieces, 1) << normal;
    EXPECT_EQ(sheet.surfacePieces, 1) << normal;
    EXPECT_LT(std::abs(sheet.GetVolumeDifference()), 0.01) << normal;
    withHoles += ComputeTriangleSurfaceTopology(*sheet.scene.surface).eulerCharacteristic != 2 ? 1 : 0;
  }
  EXPECT_LE(withHoles, 2) << "where the normal is near a diagonal, voxels touch at corners only";
}

/** The voxels that a curve passes through. */
LabelMap
MapOfCurve(itk::SizeValueType size, double from, double to, const std::function<Point(double)> & curve)
{
  LabelMap map = MakeMap(size, [](const Point &) { return 0; });
  auto & image = *std::get<ImageType::Pointer>(map.scan.image);
  for (double t = from; t <= to; t += 0.002)
  {
    image.SetPixel(image.TransformPhysicalPointToIndex(curve(t)), 1);
  }
  return MapOf(map.scan);
}

TEST(LabelSurfaces, VesselsAsWideAsAVoxelAreNotTorn)
{
  const auto helix = [](double t) { return At(18.0 * std::cos(t), 18.0 * std::sin(t), 2.3 * t - 21.0); };
  const auto knot = [](double t) {
    return At(8.0 * (std::sin(t) + 2.0 * std::sin(2.0 * t)),
              8.0 * (std::cos(t) - 2.0 * std::cos(2.0 * t)),
              -8.0 * std::sin(3.0 * t));
  };
  const auto diagonal = [](double t) { return At(t, t + 0.1, -t); };
  for (const LabelMap & map : { MapOfCurve(50, 0.0, 18.0, helix),
                                MapOfCurve(56, 0.0, 2.0 * itk::Math::pi, knot),
                                MapOfCurve(50, -20.0, 20.0, diagonal),
                                MakeMap(64, Inside(Torus(24.0, 0.87))),
                                MakeMap(64, Inside(Torus(24.0, 1.1))),
                                MakeMap(64, Inside(Torus(24.0, 1.5))) })
  {
    const LabelSurface vessel = OnlySurface(map);
    EXPECT_EQ(vessel.pieces, 1);
    EXPECT_EQ(vessel.surfacePieces, 1) << vessel.numberOfVoxels << " voxels";
    EXPECT_LT(std::abs(vessel.GetVolumeDifference()), 0.01) << vessel.numberOfVoxels << " voxels";
    EXPECT_FALSE(vessel.isTorn);
  }
}

TEST(LabelSurfaces, NodulesOfAnySizeStay)
{
  // 1, 8, 27 and 64 voxels
  const LabelMap map = MakeMap(60, [](const Point & point) {
    for (int edge = 1; edge <= 4; ++edge)
    {
      const double begin = 14.0 * edge - 42.5;
      const auto isIn = [&](double coordinate) { return coordinate > begin - 0.1 && coordinate < begin + edge - 0.9; };
      if (isIn(point[0]) && isIn(point[1]) && isIn(point[2]))
      {
        return 1;
      }
    }
    return 0;
  });
  const LabelSurface nodules = OnlySurface(map);
  EXPECT_EQ(nodules.numberOfVoxels, 100);
  EXPECT_EQ(nodules.pieces, 4);
  const auto components = itk::FindTriangleSurfaceComponents(*nodules.scene.surface);
  const auto volumes = itk::ComputeTriangleSurfaceComponentVolumes(*nodules.scene.surface, components);
  ASSERT_EQ(volumes.size(), 4);
  for (unsigned int edge = 1; edge <= 4; ++edge)
  {
    EXPECT_NEAR(volumes[edge - 1] / (edge * edge * edge), 1.0, 0.01);
  }
}

TEST(LabelSurfaces, TouchingLabelsHaveTheVolumesOfTheirVoxels)
{
  std::mt19937 random(8);
  for (unsigned int n = 0; n < 4; ++n)
  {
    const Vector normal = RandomDirection(random);
    const auto ball = Ball(At(0.2, -0.1, 0.3), 22.0);
    const LabelMap map = MakeMap(52, [&](const Point & point) {
      return ball(point) < 0.0 ? 0 : (point.GetVectorFromOrigin() * normal <= 0.0 ? 1 : 2);
    });
    const auto surfaces = MakeSurfaces(map, {}, {});
    ASSERT_EQ(surfaces.size(), 2);
    for (const LabelSurface & surface : surfaces)
    {
      EXPECT_LT(std::abs(surface.GetVolumeDifference()), 0.0025) << normal;
    }
  }
}

/** The triangles of a surface, each from its least corner on; of those \a isTurned the order is reversed. */
std::set<std::array<std::array<float, 3>, 3>>
CornersOf(const itk::TriangleSurface & surface, bool isTurned)
{
  std::set<std::array<std::array<float, 3>, 3>> all;
  for (const auto & triangle : surface.GetTriangles())
  {
    std::array<std::array<float, 3>, 3> corners;
    for (unsigned int k = 0; k < 3; ++k)
    {
      corners[isTurned ? 2 - k : k] = surface.GetPoints()[triangle[k]];
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.insert(corners);
  }
  return all;
}

TEST(LabelSurfaces, WallsAreTheSameForBothOfTheirLabels)
{
  // Two halves of a ball, once with thick slices, finished in every way.
  for (const double thickness : { 1.0, 4.0 })
  {
    const auto map = MakeMap({ { 40, 40, static_cast<itk::SizeValueType>(40 / thickness) } },
                             Vector(std::array{ 1.0, 1.0, thickness }.data()),
                             [](const Point & p) {
                               const double distance = std::hypot(p[0] - 0.3, p[1] + 0.1, p[2] - 0.4);
                               return distance > 15.0 ? 0 : (p[0] + 0.3 * p[2] > 4.0 ? 1 : 2);
                             });
    rhombic::LabelMesh mesh = rhombic::LabelsToWalls(map, {}, {});
    rhombic::SurfaceFinish finish;
    finish.smoothing = 0.2;
    finish.maximumError = 0.2;
    rhombic::RefineWalls(mesh, finish, 1.0, {});
    rhombic::ExtractSurfaces(mesh);
    ASSERT_EQ(mesh.labels.size(), 2);
    std::vector<std::set<std::array<std::array<float, 3>, 3>>> triangles;
    for (const LabelSurface & label : mesh.labels)
    {
      EXPECT_TRUE(ComputeTriangleSurfaceTopology(*label.scene.surface).IsWatertight()) << thickness;
      EXPECT_NEAR(ComputeTriangleSurfaceVolume(*label.scene.surface) / (1000.0 * label.voxelMillilitres), 1.0, 0.01)
        << thickness;
      EXPECT_EQ(label.pieces, 1);
      EXPECT_EQ(label.surfacePieces, 1);
      triangles.push_back(CornersOf(*label.scene.surface, &label == &mesh.labels.front()));
    }
    double onPlane = 0.0;
    for (const auto & corners : triangles[0])
    {
      if (triangles[1].count(corners) != 0)
      {
        EXPECT_NEAR(corners[0][0] + 0.3 * corners[0][2], 4.0, 1.0) << thickness;
        onPlane += 1.0;
      }
    }
    EXPECT_GT(onPlane, 20.0) << thickness;
  }
}

TEST(LabelSurfaces, RandomBlobsAreClosedAndWhole)
{
  for (unsigned int seed = 0; seed < 5; ++seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-16.0, 16.0);
    std::uniform_real_distribution<double> width(1.0, 5.0);
    std::vector<DistanceFunction> balls;
    for (unsigned int n = 0; n < 30; ++n)
    {
      balls.push_back(Ball(At(place(random), place(random), place(random)), width(random)));
    }
    const LabelMap map = MakeMap(40, [&](const Point & point) {
      for (std::size_t n = 0; n < balls.size(); ++n)
      {
        if (balls[n](point) >= 0.0)
        {
          return static_cast<int>(n % 3) + 1;
        }
      }
      return 0;
    });
    for (const LabelSurface & blob : MakeSurfaces(map, {}, {}))
    {
      EXPECT_TRUE(ComputeTriangleSurfaceTopology(*blob.scene.surface).IsWatertight()) << seed;
      EXPECT_GE(blob.surfacePieces, blob.pieces) << seed;
      EXPECT_FALSE(blob.isTorn) << seed;
      EXPECT_LT(std::abs(blob.GetVolumeDifference()), 0.01) << seed;
    }
  }
}

/** Boxes of one label, two to five voxels long, with one voxel of background or of another label between them. */
TEST(LabelSurfaces, PiecesOneVoxelApartStayApart)
{
  std::mt19937 random(11);
  for (unsigned int n = 0; n < 4; ++n)
  {
    std::array<std::array<bool, 16>, 3> isGap{};
    std::size_t boxes = 1;
    for (auto & axis : isGap)
    {
      std::size_t count = 1;
      for (std::size_t place = 2 + random() % 4; place < 14; place += 3 + random() % 4)
      {
        axis[place] = true;
        ++count;
      }
      boxes *= count;
    }
    const int between = n % 2 == 0 ? 0 : 2;
    const LabelMap map = MakeMap(16, [&](const Point & p) {
      const auto isIn = [&](unsigned int axis) { return isGap[axis][static_cast<std::size_t>(p[axis] + 7.6)]; };
      return isIn(0) || isIn(1) || isIn(2) ? between : 1;
    });
    const LabelSurface label = MakeSurfaces(map, {}, {}).front();
    EXPECT_EQ(label.pieces, boxes);
    EXPECT_EQ(label.surfacePieces, boxes) << "with label " << between << " between them";
    EXPECT_TRUE(ComputeTriangleSurfaceTopology(*label.scene.surface).IsWatertight());
    EXPECT_LT(std::abs(label.GetVolumeDifference()), 0.01) << boxes;
  }
}

/** Specks so near to each other that sites are scarce. */
TEST(LabelSurfaces, AllPiecesOfSparseNoiseStay)
{
  std::mt19937 random(12);
  for (const unsigned int share : { 12, 30 })
  {
    const LabelMap map = MakeMap(16, [&](const Point &) {
      const unsigned int value = random() % share;
      return value < 3 ? static_cast<int>(value) : 0;
    });
    for (const LabelSurface & noise : MakeSurfaces(map, {}, {}))
    {
      EXPECT_GE(noise.surfacePieces, noise.pieces) << share;
      EXPECT_FALSE(noise.isTorn) << share;
      EXPECT_TRUE(ComputeTriangleSurfaceTopology(*noise.scene.surface).IsWatertight());
      EXPECT_LT(std::abs(noise.GetVolumeDifference()), 0.02) << noise.pieces;
    }
  }
}

TEST(LabelSurfaces, NoiseIsClosed)
{
  std::mt19937 random(9);
  const LabelMap map = MakeMap(24, [&](const Point &) { return static_cast<int>(random() % 3); });
  for (const LabelSurface & noise : MakeSurfaces(map, {}, {}))
  {
    EXPECT_TRUE(ComputeTriangleSurfaceTopology(*noise.scene.surface).IsWatertight());
    EXPECT_LT(std::abs(noise.GetVolumeDifference()), 0.01);
  }
}

TEST(LabelSurfaces, VoxelsNeedNotBeCubes)
{
  const auto distance = Ball(At(0.3, -0.4, 0.2), 30.0);
  const double spacings[3][3] = { { 3.0, 3.0, 3.0 }, { 1.0, 1.0, 1.5 }, { 0.8, 0.8, 5.0 } };
  const double areaTolerance[3] = { 0.01, 0.01, 0.04 };
  for (unsigned int n = 0; n < 3; ++n)
  {
    const Vector spacing(spacings[n]);
    itk::Size<3> size;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      size[axis] = static_cast<itk::SizeValueType>(64.0 / spacing[axis]) + 2;
    }
    const LabelSurface ball = OnlySurface(MakeMap(size, spacing, Inside(distance)));
    EXPECT_LT(std::abs(ball.GetVolumeDifference()), 0.01) << spacing;
    EXPECT_NEAR(ComputeTriangleSurfaceArea(*ball.scene.surface) / (4.0 * itk::Math::pi * 900.0), 1.0, areaTolerance[n])
      << spacing;
    EXPECT_EQ(ball.surfacePieces, 1);
  }
}

/** A ball in slices tilted by 15 degrees, evenly spaced or not. */
LabelMap
MakeTiltedBall(double radius, bool isUneven)
{
  const LabelMap flat = MakeMap({ { 64, 72, 40 } }, Vector(1.0), [](const Point &) { return 0; });
  const auto & image = std::get<ImageType::Pointer>(flat.scan.image);
  ImageType::DirectionType direction;
  direction.SetIdentity();
  direction[1][2] = std::sin(itk::Math::pi / 12.0);
  direction[2][2] = std::cos(itk::Math::pi / 12.0);
  image->SetDirection(direction);
  const double spacing[3] = { 1.0, 1.0, 1.5 };
  image->SetSpacing(spacing);
  std::vector<Point> origins{ At(-32.0, -36.0 - 30.0 * direction[1][2], -30.0 * direction[2][2]) };
  while (origins.size() < 40)
  {
    const double step = !isUneven ? 1.5 : (origins.size() < 20 ? 1.0 : 2.0);
    origins.push_back(origins.back());
    origins.back()[1] += step * direction[1][2];
    origins.back()[2] += step * direction[2][2];
  }
  image->SetOrigin(origins[0]);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    Point point = origins[static_cast<std::size_t>(it.GetIndex()[2])];
    point[0] += static_cast<double>(it.GetIndex()[0]);
    point[1] += static_cast<double>(it.GetIndex()[1]);
    it.Set(point.GetVectorFromOrigin().GetNorm() <= radius ? 1 : 0);
  }
  rhombic::Scan scan = flat.scan;
  if (isUneven)
  {
    scan.sliceOrigins = origins;
  }
  return MapOf(scan);
}

TEST(LabelSurfaces, TiltedAndUnevenStacksKeepTheirPlaces)
{
  for (const bool isUneven : { false, true })
  {
    const LabelSurface ball = OnlySurface(MakeTiltedBall(20.0, isUneven));
    EXPECT_LT(std::abs(ball.GetVolumeDifference()), 0.0025);
    const double trueArea = 4.0 * itk::Math::pi * 400.0;
    EXPECT_NEAR(ComputeTriangleSurfaceArea(*ball.scene.surface) / trueArea, 1.0, 0.015);
    EXPECT_LT(CompareFacets(*ball.scene.surface, Ball(At(0.0, 0.0, 0.0), 20.0)).distance, 0.1);
  }
}

TEST(LabelSurfaces, CloseAtTheBorder)
{
  // A ball cut by the map's faces at 15.5 mm.
  const LabelSurface ball = OnlySurface(MakeMap(31, Inside(Ball(At(0.0, 0.0, 0.0), 18.0))));
  EXPECT_LT(std::abs(ball.GetVolumeDifference()), 0.0025);
  const auto bounds = ball.scene.surface->GetBounds();
  for (unsigned int n = 0; n < 6; ++n)
  {
    EXPECT_NEAR(std::abs(bounds[n]), 15.5, 0.3) << "at the rim";
  }
  double height = 0.0;
  double count = 0.0;
  for (const auto & point : ball.scene.surface->GetPoints())
  {
    if (point[2] > 14.0 && std::hypot(point[0], point[1]) < 6.0)
    {
      height += point[2];
      count += 1.0;
    }
  }
  EXPECT_NEAR(height / count, 15.5, 0.06); // moved by the constant that keeps the volume
  // All of it: a box with rounded edges.
  const LabelSurface box = OnlySurface(MakeMap({ { 20, 30, 10 } }, Vector(1.0), [](const Point &) { return 1; }));
  EXPECT_EQ(box.surfacePieces, 1);
  EXPECT_LT(std::abs(box.GetVolumeDifference()), 0.01);
  // One slice, and one voxel.
  const LabelSurface slice = OnlySurface(MakeMap({ { 20, 30, 1 } }, Vector(1.0), [](const Point &) { return 1; }));
  EXPECT_EQ(slice.surfacePieces, 1);
  EXPECT_LT(std::abs(slice.GetVolumeDifference()), 0.01);
  const LabelSurface voxel = OnlySurface(MakeMap({ { 1, 1, 1 } }, Vector(1.0), [](const Point &) { return 1; }));
  EXPECT_EQ(voxel.surfacePieces, 1);
  EXPECT_LT(std::abs(voxel.GetVolumeDifference()), 0.01);
}

TEST(LabelSurfaces, HollowLabelsHaveShellsInside)
{
  const auto ball = Ball(At(0.1, 0.2, -0.3), 18.0);
  const LabelSurface shell = OnlySurface(MakeMap(40, [&](const Point & point) {
    const double depth = ball(point);
    return depth >= 0.0 && depth < 3.0 ? 1 : 0;
  }));
  EXPECT_EQ(shell.surfacePieces, 1);
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*shell.scene.surface).components, 2);
  EXPECT_LT(std::abs(shell.GetVolumeDifference()), 0.0025);
}

TEST(LabelSurfaces, AreTheSameForAnyNumberOfThreads)
{
  const auto make = [](itk::ThreadIdType threads) {
    const auto before = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    const auto torus = Torus(18.0, 1.4);                  // of more voxels than threads do side by side
    const auto isInside = [&torus](const Point & point) { // and 100 or so specks around it
      const auto isSpeck = [](double x) { return std::abs(std::remainder(x, 9.0)) < 1.2; };
      return torus(point) >= 0.0 || (torus(point) < -3.0 && isSpeck(point[0]) && isSpeck(point[1]) && isSpeck(point[2]))
               ? 1
               : 0;
    };
    const LabelSurface made = OnlySurface(MakeMap(48, isInside));
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(before);
    return made;
  };
  const LabelSurface one = make(1);
  EXPECT_GT(one.pieces, 50);
  for (const itk::ThreadIdType threads : { 2, 3, 8 })
  {
    const auto many = make(threads).scene.surface;
    EXPECT_EQ(one.scene.surface->GetPoints(), many->GetPoints());
    EXPECT_EQ(one.scene.surface->GetNormals(), many->GetNormals());
    EXPECT_EQ(one.scene.surface->GetTriangles(), many->GetTriangles());
  }
}

LabelMap
MakeThreeLabels()
{
  LabelMap map = MakeMap(30, [](const Point & point) {
    return point.GetVectorFromOrigin().GetNorm() > 12.0 ? 0 : (point[0] < -4.0 ? 3 : (point[0] < 4.0 ? 5 : 9));
  });
  map.labels[0].label.name = "liver";
  map.labels[0].label.colour = { 255, 51, 0 };
  map.labels[0].label.opacity = 0.5;
  map.labels[1].label.name = "spleen";
  map.labels[1].label.isVisible = false;
  map.labels[2].label.name = "kidney";
  return map;
}

std::vector<std::string>
NamesOf(const std::vector<LabelSurface> & surfaces)
{
  std::vector<std::string> names;
  for (const LabelSurface & surface : surfaces)
  {
    names.push_back(surface.scene.name);
  }
  return names;
}

TEST(LabelSurfaces, AreThoseAskedFor)
{
  const LabelMap map = MakeThreeLabels();
  rhombic::LabelSurfaceSettings settings;
  const auto visible = MakeSurfaces(map, settings, {});
  EXPECT_EQ(NamesOf(visible), (std::vector<std::string>{ "liver", "kidney" }));
  EXPECT_EQ(visible[0].scene.colour, (rhombic::Colour{ 1.0, 0.2, 0.0 }));
  EXPECT_EQ(visible[0].scene.opacity, 0.5);
  EXPECT_EQ(visible[0].value, 3);
  settings.labels = { "9", "spleen" };
  EXPECT_EQ(NamesOf(MakeSurfaces(map, settings, {})), (std::vector<std::string>{ "spleen", "kidney" }));
}

TEST(LabelSurfaces, AreCalledInUpperOrLowerCaseUnlessTheTwoDiffer)
{
  LabelMap map = MakeThreeLabels();
  const auto namesFor = [&map](const std::string & wanted) {
    rhombic::LabelSurfaceSettings settings;
    settings.labels = { wanted };
    return NamesOf(MakeSurfaces(map, settings, {}));
  };
  EXPECT_EQ(namesFor("Liver"), (std::vector<std::string>{ "liver" }));
  EXPECT_EQ(namesFor("KIDNEY"), (std::vector<std::string>{ "kidney" }));
  map.labels[1].label.name = "Liver";
  EXPECT_EQ(namesFor("liver"), (std::vector<std::string>{ "liver" }));
  EXPECT_EQ(namesFor("Liver"), (std::vector<std::string>{ "Liver" }));
  EXPECT_EQ(namesFor("LIVER"), (std::vector<std::string>{ "liver", "Liver" })) << "either is meant";
}

TEST(LabelSurfaces, ThatThereAreNotComeWithASuggestion)
{
  const LabelMap map = MakeThreeLabels();
  const auto sentenceFor = [&map](const std::string & wanted) {
    rhombic::LabelSurfaceSettings settings;
    settings.labels = { wanted };
    try
    {
      MakeSurfaces(map, settings, {});
    }
    catch (const rhombic::Failure & failure)
    {
      return std::string(failure.GetDescription());
    }
    return std::string("no failure");
  };
  EXPECT_NE(sentenceFor("livre").find("'livre'; did you mean liver?"), std::string::npos) << sentenceFor("livre");
  EXPECT_NE(sentenceFor("heart").find("'heart'; see rhombic info"), std::string::npos) << sentenceFor("heart");
}

TEST(LabelSurfaces, ReportProgress)
{
  double last = 0.0;
  rhombic::Events events;
  events.progress = [&last](const std::string &, double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  };
  MakeSurfaces(MakeThreeLabels(), {}, events);
  EXPECT_EQ(last, 1.0);
}

TEST(LabelSurfaces, RefuseWhatCannotBe)
{
  const LabelMap map = MakeThreeLabels();
  const auto kindOf = [](const LabelMap & labels, const rhombic::LabelSurfaceSettings & settings) {
    try
    {
      MakeSurfaces(labels, settings, {});
    }
    catch (const rhombic::Failure & failure)
    {
      return failure.GetKind();
    }
    return rhombic::FailureKind::Internal;
  };
  rhombic::LabelSurfaceSettings settings;
  settings.labels = { "pancreas" };
  EXPECT_EQ(kindOf(map, settings), rhombic::FailureKind::Usage);
  settings = {};
  settings.density = 0.0;
  EXPECT_EQ(kindOf(map, settings), rhombic::FailureKind::Usage);
  settings = {};
  settings.maximumMemory = 1000;
  EXPECT_EQ(kindOf(map, settings), rhombic::FailureKind::Memory);
  EXPECT_EQ(kindOf(MakeMap(8, [](const Point &) { return 0; }), {}), rhombic::FailureKind::Empty);
}

/** A label map among the real scans; empty where there are none. */
std::filesystem::path
RealMap(const std::string & name)
{
  const char * const folder = std::getenv("RHOMBIC_SCANS");
  return folder != nullptr ? std::filesystem::path(folder) / name : std::filesystem::path();
}

TEST(LabelSurfaces, OfRealMapsHaveTheirVoxelsVolumes)
{
  for (const char * const name : { "ct_body_totalseg_nifti/example_seg_fast_force_split.nii.gz",
                                   "ct_body_totalseg_nifti/example_seg.nii.gz",
                                   "ct_body_totalseg_nifti/example_seg_dicom.nii.gz",
                                   "dicom_seg_dcmqi/segmentations/partial_overlaps-1.nrrd",
                                   "dicom_seg_dcmqi/segmentations/heart_seg.nrrd",
                                   "dicom_seg_dcmqi/segmentations/24x38x3/nrrd/label.nrrd" })
  {
    rhombic::LabelMapSource source;
    source.paths = { RealMap(name) };
    if (source.paths.front().empty())
    {
      GTEST_SKIP() << "RHOMBIC_SCANS is not set";
    }
    LabelMap map;
    map.scan = rhombic::ReadScan(source.paths.front());
    map.labels = rhombic::FindLabels(map.scan, source);
    for (const LabelSurface & surface : MakeSurfaces(map, {}, {}))
    {
      const std::string what = std::string(name) + ", " + surface.scene.name;
      EXPECT_TRUE(ComputeTriangleSurfaceTopology(*surface.scene.surface).IsWatertight()) << what;
      EXPECT_GE(surface.surfacePieces, surface.pieces) << what;
      EXPECT_FALSE(surface.isTorn) << what;
      EXPECT_LT(std::abs(surface.GetVolumeDifference()), surface.voxelMillilitres > 1.0 ? 0.001 : 0.01) << what;
    }
  }
}

/** A kidney of radius 12, labelled 1, and a spleen that touches it; in a further layer a tumour inside the kidney and
 * partly outside of it, and a copy of the spleen in a third one. */
LabelMap
MakeOverlappingMap()
{
  const auto inside = [](const Point & p, double x, double radius) {
    return std::hypot(p[0] - x, p[1], p[2]) < radius;
  };
  LabelMap map = MakeMap(48, [&](const Point & p) {
    return p[0] > 8.0 && inside(p, 10.0, 9.0) ? 2 : inside(p, -4.0, 12.0) ? 1 : 0;
  });
  map.scan.furtherLayers = { MakeMap(48, [&](const Point & p) { return inside(p, -12.0, 6.0) ? 3 : 0; }).scan.image,
                             MakeMap(48, [&](const Point & p) {
                               return p[0] > 8.0 && inside(p, 10.0, 9.0) ? 4 : 0;
                             }).scan.image };
  map.labels = rhombic::SummarizeLabels(map.scan, {});
  return map;
}

TEST(LabelSurfaces, LabelsThatOverlapAreWhole)
{
  const LabelMap map = MakeOverlappingMap();
  ASSERT_EQ(map.labels.size(), 4);
  rhombic::LabelMesh mesh = rhombic::LabelsToWalls(map, {}, {});
  rhombic::ExtractSurfaces(mesh);
  ASSERT_EQ(mesh.walls.size(), 3);
  for (std::size_t n = 0; n < 4; ++n)
  {
    const LabelSurface & label = mesh.labels[n];
    EXPECT_EQ(label.value, static_cast<int>(n + 1));
    EXPECT_EQ(label.layer, n < 2 ? 0 : n - 1);
    EXPECT_TRUE(ComputeTriangleSurfaceTopology(*label.scene.surface).IsWatertight());
    EXPECT_NEAR(ComputeTriangleSurfaceVolume(*label.scene.surface) / 1000.0,
                map.labels[n].millilitres,
                0.01 * map.labels[n].millilitres);
    EXPECT_EQ(label.surfacePieces, 1);
  }
  const auto & spleen = *mesh.labels[1].scene.surface;
  const auto & copy = *mesh.labels[3].scene.surface;
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(spleen),
              ComputeTriangleSurfaceVolume(copy),
              0.01 * ComputeTriangleSurfaceVolume(copy));

  LabelMap kidney = map;
  kidney.scan.furtherLayers.clear();
  kidney.labels.resize(2);
  const auto alone = MakeSurfaces(kidney, {}, {});
  EXPECT_EQ(alone[0].scene.surface->GetPoints(), mesh.labels[0].scene.surface->GetPoints())
    << "a layer has the walls that it has alone";

  const auto tumour = MakeSurfaces(map, { { "3" } }, {});
  ASSERT_EQ(tumour.size(), 1);
  EXPECT_EQ(tumour[0].layer, 0) << "the first of those that hold any chosen label";
  EXPECT_EQ(tumour[0].scene.surface->GetPoints(), mesh.labels[2].scene.surface->GetPoints());
}

TEST(LabelSurfaces, LayersShareALimitOfTriangles)
{
  rhombic::LabelMesh mesh = rhombic::LabelsToWalls(MakeOverlappingMap(), {}, {});
  rhombic::SurfaceFinish finish;
  finish.maximumTriangles = 3000;
  finish.maximumError = 5.0;
  const auto refinements = rhombic::RefineWalls(mesh, finish, 1.0, {});
  ASSERT_EQ(refinements.size(), 3);
  itk::SizeValueType triangles = 0;
  for (const auto & walls : mesh.walls)
  {
    triangles += walls->GetNumberOfTriangles();
  }
  EXPECT_LE(triangles, 3000);
  EXPECT_GE(triangles, 2900);
  rhombic::ExtractSurfaces(mesh);
  for (const LabelSurface & label : mesh.labels)
  {
    EXPECT_TRUE(ComputeTriangleSurfaceTopology(*label.scene.surface).IsWatertight());
  }
}

TEST(LabelSurfaces, OfAPartOfTheMapAreThoseOfTheWholeMap)
{
  // Two halves of a body as long as a patient, and a ball far from the part.
  const LabelMap map = MakeMap({ { 52, 52, 140 } }, Vector(1.0), [](const Point & point) {
    const double radius = 14.0 + 3.0 * std::sin(point[2] / 5.0) + 2.0 * std::cos(point[1] / 3.0);
    const bool isInBody = std::hypot(point[0], point[1]) < radius && std::abs(point[2]) < 66.0;
    const bool isInBall = (point - At(19.0, 19.0, -60.0)).GetNorm() < 4.0;
    return isInBall ? 3 : !isInBody ? 0 : point[0] + 2.0 * std::sin(point[2] / 4.0) < 0.0 ? 1 : 2;
  });
  rhombic::LabelSurfaceSettings settings;
  settings.part = itk::ImageRegion<3>({ { 0, 0, 73 } }, { { 52, 52, 1 } });
  const auto whole = MakeSurfaces(map, {}, {});
  const auto part = MakeSurfaces(map, settings, {});
  ASSERT_EQ(part.size(), 3);
  for (std::size_t n = 0; n < 3; ++n)
  {
    EXPECT_TRUE(part[n].isPart);
    EXPECT_FALSE(whole[n].isPart);
    EXPECT_EQ(part[n].scene.name, whole[n].scene.name);
    EXPECT_EQ(part[n].voxelMillilitres, whole[n].voxelMillilitres);
    const itk::TriangleSurface & surface = *part[n].scene.surface;
    EXPECT_LT(surface.GetNumberOfTriangles(), whole[n].scene.surface->GetNumberOfTriangles() / 3);
    const itk::TriangleTree tree(*whole[n].scene.surface);
    std::vector<double> distances; // the lattices of part and whole lie elsewhere between the voxels
    for (const auto & point : surface.GetPoints())
    {
      if (std::abs(point[2] - 3.5) < 1.5)
      {
        distances.push_back(std::sqrt(tree.FindClosestPoint({ point[0], point[1], point[2] }).squaredDistance));
      }
    }
    std::sort(distances.begin(), distances.end());
    EXPECT_LT(distances.empty() ? 0.0 : distances[distances.size() * 95 / 100], 0.05);
    EXPECT_LT(distances.empty() ? 0.0 : distances.back(), 0.25); // at curves where three labels meet
  }
  EXPECT_EQ(part[2].scene.surface->GetNumberOfTriangles(), 0);
}

/** The share of the edges within walls, at the curves where these meet, that fold by more than a right angle. */
double
ShareOfFolds(const itk::LabelWalls & walls)
{
  using Edge = std::pair<itk::LabelWalls::LabelPairType, std::array<std::uint32_t, 2>>;
  std::map<Edge, std::vector<std::size_t>> trianglesAt;
  std::vector<std::set<itk::LabelWalls::LabelPairType>> wallsAt(walls.GetNumberOfPoints());
  for (std::size_t n = 0; n < walls.GetNumberOfTriangles(); ++n)
  {
    const auto & triangle = walls.GetTriangles()[n];
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      const auto [low, high] = std::minmax({ triangle[corner], triangle[(corner + 1) % 3] });
      trianglesAt[{ walls.GetTriangleLabels()[n], { low, high } }].push_back(n);
      wallsAt[low].insert(walls.GetTriangleLabels()[n]);
    }
  }
  double folds = 0.0;
  double edges = 0.0;
  for (const auto & [edge, triangles] : trianglesAt)
  {
    const auto & [low, high] = edge.second;
    if (triangles.size() == 2 && (wallsAt[low].size() > 1 || wallsAt[high].size() > 1))
    {
      const auto normal = [&](std::size_t n) {
        return itk::AreaVector(itk::CornersOf(walls, walls.GetTriangles()[n]));
      };
      folds += itk::Dot(normal(triangles[0]), normal(triangles[1])) < 0.0 ? 1.0 : 0.0;
      edges += 1.0;
    }
  }
  EXPECT_GT(edges, 1000.0);
  return folds / edges;
}

TEST(LabelSurfaces, HardlyFoldWhereThreeMeet)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-13.0, 13.0);
  std::vector<Point> centres; // of cells with plane walls
  for (unsigned int n = 0; n < 40; ++n)
  {
    const double x = place(random);
    const double y = place(random);
    centres.push_back(At(x, y, place(random)));
  }
  const rhombic::LabelMesh mesh = rhombic::LabelsToWalls(
    MakeMap(32,
            [&centres](const Point & p) {
              const auto isNearer = [&p](const Point & a, const Point & b) {
                return (p - a).GetNorm() < (p - b).GetNorm();
              };
              const auto nearest = std::min_element(centres.begin(), centres.end(), isNearer);
              return p.GetVectorFromOrigin().GetNorm() > 13.0 ? 0 : 1 + static_cast<int>(nearest - centres.begin());
            }),
    {},
    {});
  EXPECT_LT(ShareOfFolds(*mesh.walls.front()), 0.002);
}

/** Distance of the point that is farthest from a surface. */
double
FarthestPoint(const itk::TriangleSurface & points, const itk::TriangleSurface & surface)
{
  const itk::TriangleTree tree(surface);
  double farthest = 0.0;
  for (const auto & point : points.GetPoints())
  {
    farthest = std::max(farthest, std::sqrt(tree.FindClosestPoint({ point[0], point[1], point[2] }).squaredDistance));
  }
  return farthest;
}

/** The surfaces of all labels. */
std::vector<rhombic::SceneSurface>
ScenesOf(const rhombic::LabelMesh & mesh)
{
  std::vector<rhombic::SceneSurface> surfaces;
  for (const LabelSurface & label : mesh.labels)
  {
    surfaces.push_back(label.scene);
  }
  return surfaces;
}

/** The corners of a surface's triangles, whichever way they face. */
std::set<std::array<itk::TriangleSurface::PointType, 3>>
CornersOfTriangles(const itk::TriangleSurface & surface)
{
  std::set<std::array<itk::TriangleSurface::PointType, 3>> corners;
  for (const auto & [a, b, c] : surface.GetTriangles())
  {
    std::array<itk::TriangleSurface::PointType, 3> triangle{ surface.GetPoints()[a],
                                                             surface.GetPoints()[b],
                                                             surface.GetPoints()[c] };
    std::sort(triangle.begin(), triangle.end());
    corners.insert(triangle);
  }
  return corners;
}

TEST(LabelSurfaces, InFewerTrianglesAreAtTheirPlaces)
{
  rhombic::LabelMesh mesh = rhombic::LabelsToWalls( // two halves of a ball around a smaller ball
    MakeMap(40,
            [](const Point & point) {
              const double radius = point.GetVectorFromOrigin().GetNorm();
              return radius < 8.0 ? 3 : radius < 16.0 ? (point[0] < 0.0 ? 1 : 2) : 0;
            }),
    {},
    {});
  rhombic::ExtractSurfaces(mesh);
  constexpr double distance = 0.05;
  const auto fewer = rhombic::InFewerTriangles(ScenesOf(mesh), distance);
  ASSERT_EQ(fewer.size(), 3);
  for (std::size_t n = 0; n < fewer.size(); ++n)
  {
    const itk::TriangleSurface & whole = *mesh.labels[n].scene.surface;
    const itk::TriangleSurface & small = *fewer[n].surface;
    EXPECT_TRUE(ComputeTriangleSurfaceTopology(small).IsWatertight());
    EXPECT_LT(2 * small.GetNumberOfTriangles(), whole.GetNumberOfTriangles());
    EXPECT_EQ(small.GetNormals().size(), small.GetNumberOfPoints());
    EXPECT_NEAR(ComputeTriangleSurfaceVolume(small) / ComputeTriangleSurfaceVolume(whole), 1.0, 0.01);
    EXPECT_LT(FarthestPoint(whole, small), 3.0 * distance) << n;
  }
  const auto first = CornersOfTriangles(*fewer[0].surface);
  const auto second = CornersOfTriangles(*fewer[1].surface);
  for (const auto & triangle : CornersOfTriangles(*fewer[2].surface))
  {
    EXPECT_EQ(first.count(triangle) + second.count(triangle), 1); // the same walls from both sides
  }
}

TEST(LabelSurfaces, InFewerTrianglesStayClosedWhereWallsMeet)
{
  std::mt19937 random(37);
  std::uniform_real_distribution<double> place(-10.0, 10.0);
  for (int repetition = 0; repetition < 8; ++repetition)
  {
    std::vector<Point> centres;
    for (int label = 0; label < 9; ++label)
    {
      centres.push_back(At(place(random), place(random), place(random)));
    }
    rhombic::LabelMesh mesh = rhombic::LabelsToWalls( // cells around random centres in a ball
      MakeMap(28,
              [&](const Point & point) {
                const auto nearest =
                  std::min_element(centres.begin(), centres.end(), [&](const auto & a, const auto & b) {
                    return point.SquaredEuclideanDistanceTo(a) < point.SquaredEuclideanDistanceTo(b);
                  });
                const bool isInside = point.GetVectorFromOrigin().GetNorm() < 11.0;
                return isInside ? static_cast<int>(nearest - centres.begin()) + 1 : 0;
              }),
      {},
      {});
    rhombic::ExtractSurfaces(mesh);
    const std::vector<rhombic::SceneSurface> surfaces = ScenesOf(mesh);
    constexpr double distance = 0.2;
    const auto fewer = rhombic::InFewerTriangles(surfaces, distance);
    std::size_t all = 0;
    std::size_t left = 0;
    for (std::size_t n = 0; n < surfaces.size(); ++n)
    {
      const itk::TriangleSurface & whole = *surfaces[n].surface;
      EXPECT_TRUE(ComputeTriangleSurfaceTopology(*fewer[n].surface).IsWatertight()) << surfaces[n].name;
      EXPECT_LT(FarthestPoint(whole, *fewer[n].surface), 3.0 * distance) << surfaces[n].name;
      all += whole.GetNumberOfTriangles();
      left += fewer[n].surface->GetNumberOfTriangles();
    }
    EXPECT_LT(left, 3 * all / 4);
  }
}

/** A layer so thin that it is in pieces, as fat is between muscle and skin in coarse maps. */
TEST(LabelSurfaces, PatchesInFewTrianglesAreNotTurnedInsideOut)
{
  constexpr double thickness = 0.45;
  for (const auto & [size, error] : { std::pair{ 15.0, 0.6 }, std::pair{ 14.5, 0.7 } })
  {
    SCOPED_TRACE(size);
    rhombic::LabelMesh mesh = rhombic::LabelsToWalls(
      MakeMap(36,
              [size = size](const Point & point) {
                const double radius = std::hypot(point[0], 0.8 * point[1], 1.1 * point[2]);
                const double beyond = radius - size;
                return beyond < 0.0 ? 1 : beyond < thickness ? 2 : beyond < thickness + 1.3 ? 3 : 0;
              }),
      {},
      {});
    rhombic::SurfaceFinish finish;
    finish.maximumError = error;
    rhombic::RefineWalls(mesh, finish, 1.0, {});
    rhombic::ExtractSurfaces(mesh);
    for (const LabelSurface & label : mesh.labels)
    {
      EXPECT_EQ(CountTriangleSurfaceShells(*label.scene.surface).misfacing, 0u) << label.scene.name;
    }
  }
}

TEST(LabelSurfaces, VoxelsOfLabelsHavePlaces)
{
  const LabelMap map = MakeMap(12, [](const Point & point) { return point[0] < 0.0 ? 0 : point[2] < 2.0 ? 4 : 9; });
  const auto found = rhombic::FindLabelVoxels(map, {});
  ASSERT_EQ(found.size(), 2);
  EXPECT_EQ(found[0].name, "label 4");
  EXPECT_EQ(found[0].count, 6 * 12 * 8);
  EXPECT_EQ(found[0].region, itk::ImageRegion<3>({ { 6, 0, 0 } }, { { 6, 12, 8 } }));
  EXPECT_EQ(found[0].centroid[0], 8.5);
  EXPECT_EQ(found[0].centroid[1], 5.5);
  EXPECT_EQ(found[0].centroid[2], 3.5);
  EXPECT_EQ(found[1].region, itk::ImageRegion<3>({ { 6, 0, 8 } }, { { 6, 12, 4 } }));
  EXPECT_THROW(rhombic::FindLabelVoxels(map, { "label 5" }), rhombic::Failure);
}

} // namespace
