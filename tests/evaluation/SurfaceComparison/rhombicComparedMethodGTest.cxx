#include "rhombicCartesianSurfaces.h"
#include "rhombicComparedMethod.h"
#include "rhombicFailure.h"
#include "rhombicFieldSampling.h"
#include "rhombicShapeFields.h"
#include "rhombicSurfaceErrors.h"
#include "rhombicSurfaceToPolyData.h"
#include "rhombicExtractSurface.h"

#include "detail/itkPositionArithmetic.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>
#include <vtkHausdorffDistancePointSetFilter.h>
#include <vtkNew.h>

#include <cmath>
#include <random>

using namespace rhombic;

namespace
{

constexpr double pi = 3.14159265358979324;
constexpr double infinity = std::numeric_limits<double>::infinity();
const SurfaceErrorSettings everywhere{ { -infinity, -infinity, -infinity }, { infinity, infinity, infinity }, 1.0 };
const FieldBox cube{ { 0.0, 0.0, 0.0 }, { 20.0, 20.0, 20.0 } };

/** A square of side 10 about the origin in many triangles, turned about the x axis and shifted along its normal. */
itk::TriangleSurface::Pointer
MakePlane(double degrees, double shift)
{
  constexpr std::uint32_t cuts = 40;
  const double c = std::cos(degrees * pi / 180.0);
  const double s = std::sin(degrees * pi / 180.0);
  auto surface = itk::TriangleSurface::New();
  for (std::uint32_t row = 0; row <= cuts; ++row)
  {
    for (std::uint32_t column = 0; column <= cuts; ++column)
    {
      const double y = 10.0 * row / cuts - 5.0;
      surface->GetPoints().push_back({ static_cast<float>(10.0 * column / cuts - 5.0),
                                       static_cast<float>(c * y - s * shift),
                                       static_cast<float>(s * y + c * shift) });
      if (row > 0 && column > 0)
      {
        const std::uint32_t d = row * (cuts + 1) + column;
        surface->GetTriangles().push_back({ d - cuts - 2, d - cuts - 1, d });
        surface->GetTriangles().push_back({ d - cuts - 2, d, d - 1 });
      }
    }
  }
  return surface;
}

/** The cube from 0 to 1, its position shifted. */
itk::TriangleSurface::Pointer
MakeCube(const Vector3 & shift)
{
  auto surface = itk::TriangleSurface::New();
  for (unsigned int n = 0; n < 8; ++n)
  {
    surface->GetPoints().push_back({ static_cast<float>((n & 1U) + shift[0]),
                                     static_cast<float>((n >> 1U & 1U) + shift[1]),
                                     static_cast<float>((n >> 2U) + shift[2]) });
  }
  surface->GetTriangles() = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
                              { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  return surface;
}

SurfaceErrors
Compare(const itk::TriangleSurface & surface, const itk::TriangleSurface & truth)
{
  const itk::TriangleTree tree(truth);
  return ComputeSurfaceErrors(surface, NearestOnMesh(tree), everywhere);
}

} // namespace

TEST(SurfaceErrors, OfConcentricSpheres)
{
  const auto inner = MakeBisectedSphere({ 1, 2, 3 }, 1.0, 6);
  const auto outer = MakeBisectedSphere({ 1, 2, 3 }, 1.25, 6);
  EXPECT_EQ(inner->GetNumberOfTriangles(), 4U * 4096U);
  EXPECT_TRUE(itk::ComputeTriangleSurfaceTopology(*inner).IsWatertight());
  for (const SurfaceErrors & errors : { Compare(*inner, *outer), Compare(*outer, *inner) })
  {
    EXPECT_NEAR(errors.meanDistance, 0.25, 1e-3);
    EXPECT_NEAR(errors.rmsDistance, 0.25, 1e-3);
    EXPECT_NEAR(errors.maximumDistance, 0.25, 3e-3);
    EXPECT_NEAR(errors.facetNormalError, 0.0, 0.5);
  }
  EXPECT_NEAR(ComputeNormalPenalty(*inner, *outer, everywhere), 0.0, 1e-6);
  const itk::TriangleTree tree(*outer);
  EXPECT_NEAR(ComputePointDistances(*inner, NearestOnMesh(tree), everywhere).meanDistance, 0.25, 1e-3);
}

TEST(SurfaceErrors, OfPlanesAtAnAngle)
{
  // The distance from (y, z) on the turned plane to the other is |y sin|, as long as its foot is on that plane.
  const auto truth = MakePlane(0.0, 0.0);
  for (const double degrees : { 5.0, 30.0, 60.0 })
  {
    const auto plane = MakePlane(degrees, 0.0);
    const SurfaceErrors errors = Compare(*plane, *truth);
    const double sine = std::sin(degrees * pi / 180.0);
    EXPECT_NEAR(errors.meanDistance, 2.5 * sine, 2e-3);
    EXPECT_NEAR(errors.rmsDistance, 5.0 * sine / std::sqrt(3.0), 2e-3);
    EXPECT_NEAR(errors.maximumDistance, 5.0 * sine, 1e-5);
    EXPECT_NEAR(errors.facetNormalError, degrees, 1e-4);
    EXPECT_NEAR(ComputeNormalPenalty(*plane, *truth, everywhere), 1.0 - std::cos(degrees * pi / 180.0), 1e-6);
  }
  EXPECT_NEAR(ComputeNormalPenalty(*MakePlane(120.0, 0.0), *truth, everywhere), 1.0, 1e-12);
}

TEST(SurfaceErrors, OfAShiftedCube)
{
  const auto cubeItself = MakeCube({ 0, 0, 0 });
  EXPECT_NEAR(Compare(*cubeItself, *cubeItself).maximumDistance, 0.0, 1e-12);
  EXPECT_NEAR(Compare(*MakeCube({ 0.25, 0, 0 }), *cubeItself).maximumDistance, 0.25, 1e-6);
  const SurfaceErrors corner = Compare(*MakeCube({ 1, 2, 2 }), *MakeCube({ 0, 0, 0 }));
  EXPECT_NEAR(corner.maximumDistance, 3.0, 1e-6); // from (2, 3, 3) to (1, 1, 1)
}

TEST(SurfaceErrors, NormalPenaltyTakesTheNearestPoint)
{
  // Against all points, for random surfaces.
  std::mt19937 random(3);
  std::uniform_real_distribution<float> coordinate(0.0F, 1.0F);
  const auto make = [&] {
    auto surface = itk::TriangleSurface::New();
    for (std::uint32_t n = 0; n < 60; ++n)
    {
      surface->GetPoints().push_back({ coordinate(random), coordinate(random), coordinate(random) });
      if (n % 3 == 2)
      {
        surface->GetTriangles().push_back({ n - 2, n - 1, n });
      }
    }
    return surface;
  };
  const auto normalOf = [](const itk::TriangleSurface & surface, std::size_t point) {
    std::array<Vector3, 3> c;
    for (std::size_t n = 0; n < 3; ++n)
    {
      const auto & p = surface.GetPoints()[point / 3 * 3 + n];
      c[n] = { p[0], p[1], p[2] };
    }
    return itk::Cross(itk::Subtract(c[1], c[0]), itk::Subtract(c[2], c[0]));
  };
  for (unsigned int run = 0; run < 20; ++run)
  {
    const auto surface = make();
    const auto truth = make();
    double expected = 0.0;
    for (std::size_t n = 0; n < 60; ++n)
    {
      const auto distance = [&](const itk::TriangleSurface::PointType & p) {
        const auto & q = surface->GetPoints()[n];
        return std::hypot(double{ p[0] } - q[0], double{ p[1] } - q[1], double{ p[2] } - q[2]);
      };
      const auto & points = truth->GetPoints();
      const auto nearest = std::min_element(
        points.begin(), points.end(), [&](const auto & a, const auto & b) { return distance(a) < distance(b); });
      const Vector3 a = normalOf(*surface, n);
      const Vector3 b = normalOf(*truth, static_cast<std::size_t>(nearest - points.begin()));
      expected += 1.0 - std::max(0.0, itk::Dot(a, b) / (itk::Length(a) * itk::Length(b)));
    }
    EXPECT_NEAR(ComputeNormalPenalty(*surface, *truth, everywhere), expected / 60.0, 1e-9);
  }
}

TEST(ComparedMethods, MakeClosedSurfacesOfTheRightVolume)
{
  const ReferenceField sphere = MakeSphereField({ 9.7, 10.2, 10.1 }, 7.0);
  for (const ComparedMethod & method : GetComparedMethods())
  {
    const PreparedMethod prepared = method.prepare(sphere, cube, 1.0);
    EXPECT_NEAR(prepared.samples, 9261.0, 1500.0) << method.name;
    const auto surface = prepared.extract();
    const auto topology = itk::ComputeTriangleSurfaceTopology(*surface);
    EXPECT_EQ(topology.boundaryEdges, 0U) << method.name;
    EXPECT_EQ(topology.misorientedEdges, 0U) << method.name;
    EXPECT_EQ(topology.components, 1U) << method.name;
    const double volume = itk::ComputeTriangleSurfaceVolume(*surface);
    EXPECT_NEAR(volume, 4.0 / 3.0 * pi * 343.0, 40.0) << method.name;
  }
  EXPECT_THROW(GetComparedMethod("marching-cube"), Failure);
}

TEST(ComparedMethods, HaveTheSamplesAskedFor)
{
  for (const ComparedMethod & method : GetComparedMethods())
  {
    const double density = DensityOfSamples(method, cube, 6912);
    const ReferenceField sphere = MakeSphereField({ 10, 10, 10 }, 7.0);
    EXPECT_NEAR(method.prepare(sphere, cube, density).samples, 6912.0, 600.0) << method.name; // all sides grow at once
  }
}

TEST(CartesianSurfaces, TetrahedraHaveTheirTrianglesPerArea)
{
  // Means over directions, at one sample per unit of volume: edges owned by a site, by their mean projected length.
  const ReferenceField sphere = MakeSphereField({ 10.1, 9.9, 10.3 }, 8.5);
  const double area = 4.0 * pi * 8.5 * 8.5;
  const auto perArea = [&](const char * name) {
    const auto prepared = GetComparedMethod(name).prepare(sphere, cube, 1.0);
    return static_cast<double>(prepared.extract()->GetNumberOfTriangles()) / area;
  };
  EXPECT_NEAR(perArea("marching-cubes"), 3.0, 0.1);
  EXPECT_NEAR(perArea("marching-tetrahedra"), 8.975, 0.25);
  EXPECT_NEAR(perArea("bcc-tetrahedra"), 8.144, 0.25);
}

TEST(CartesianSurfaces, TetrahedraMatchLinearFieldsExactly)
{
  const ReferenceField plane([](const Vector3 & p, Vector3 & gradient) {
    gradient = { -0.3, -0.5, -0.7 };
    return 15.1 - 0.3 * p[0] - 0.5 * p[1] - 0.7 * p[2];
  });
  for (const char * name : { "marching-tetrahedra",
                             "bcc-tetrahedra",
                             "bcc-octahedra",
                             "bcc-hexahedra",
                             "marching-cubes-cubic",
                             "marching-tetrahedra-cubic" })
  {
    const auto surface = GetComparedMethod(name).prepare(plane, cube, 1.0).extract();
    EXPECT_LT(ComputeSurfaceErrors(*surface, NearestOnField(plane, 1.0), everywhere).maximumDistance, 2e-4) << name;
    EXPECT_LT(ComputeSurfaceErrors(*surface, NearestOnField(plane, 1.0), everywhere).facetNormalError, 0.5) << name;
  }
}

TEST(CartesianSurfaces, CubicPointsAreExactOnCubics)
{
  const ReferenceField cubic([](const Vector3 & p, Vector3 & gradient) {
    const double z = p[2] - 10.3;
    gradient = { 0.0, 0.0, -1.0 - 0.3 * z * z };
    return -z - 0.1 * z * z * z;
  });
  for (const char * name : { "marching-cubes-cubic", "marching-tetrahedra-cubic" })
  {
    const auto surface = GetComparedMethod(name).prepare(cubic, cube, 1.0).extract();
    double sum = 0.0;
    for (const auto & point : surface->GetPoints())
    {
      const bool isAtBorder =
        *std::min_element(point.begin(), point.end()) < 1.0F || *std::max_element(point.begin(), point.end()) > 19.0F;
      EXPECT_NEAR(point[2], 10.3, isAtBorder ? 0.05 : 1e-5) << name; // too few samples on diagonals at the border
      sum += point[2];
    }
    EXPECT_NEAR(sum / static_cast<double>(surface->GetNumberOfPoints()), 10.3, 0.01) << name;
  }
}

TEST(InterpolatedField, PassesThroughTheSamples)
{
  const ReferenceField sphere = MakeSphereField({ 4.1, 4.2, 4.4 }, 3.0);
  const auto volume = SampleOnGrid<float>(sphere, 9, 1.0);
  const ReferenceField field = MakeInterpolatedField(volume);
  EXPECT_NEAR(field.Evaluate({ 2, 3, 5 }), sphere.Evaluate({ 2, 3, 5 }), 1e-5);
  Vector3 gradient;
  Vector3 expected;
  EXPECT_NEAR(field.Evaluate({ 2.5, 2.5, 6.5 }, gradient), sphere.Evaluate({ 2.5, 2.5, 6.5 }, expected), 0.02);
  EXPECT_NEAR(gradient[2], expected[2], 0.05);
}

TEST(SilhouetteField, OfABallIsTheBall)
{
  const auto ball = MakeBisectedSphere({ 0, 0, 0 }, 1.0, 5);
  const ReferenceField field = MakeSilhouetteField(*ball, 200);
  EXPECT_EQ(field.Evaluate({ 0.0, 0.0, 0.0 }), 0.5);
  EXPECT_EQ(field.Evaluate({ 0.7, 0.6, 0.0 }), 0.5);
  EXPECT_EQ(field.Evaluate({ 0.7, 0.8, 0.0 }), -0.5);
  EXPECT_EQ(field.Evaluate({ 0.0, 0.0, 3.0 }), -0.5);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1.1, 1.1);
  for (unsigned int n = 0; n < 2000; ++n)
  {
    const Vector3 p{ coordinate(random), coordinate(random), coordinate(random) };
    const double radius = itk::Length(p);
    if (std::abs(radius - 1.0) > 0.02)
    {
      EXPECT_EQ(field.Evaluate(p) > 0.0, radius < 1.0) << radius;
    }
  }
}

TEST(BodyField, IsClosedAndHasExactGradients)
{
  for (const ReferenceField & body : { MakeHand(), MakeQuadruped() })
  {
    const auto surface = MakeTrueSurface(body, { { -1.3, -0.7, -0.4 }, { 1.3, 0.7, 2.2 } }, 0.02);
    const auto topology = itk::ComputeTriangleSurfaceTopology(*surface);
    EXPECT_EQ(topology.boundaryEdges, 0U);
    EXPECT_EQ(topology.components, 1U);
    EXPECT_EQ(topology.genus, 0U);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    for (unsigned int n = 0; n < 200; ++n)
    {
      constexpr double step = 1e-6;
      const Vector3 p{ coordinate(random), coordinate(random), coordinate(random) };
      Vector3 gradient;
      body.Evaluate(p, gradient);
      const double slope =
        (body.Evaluate({ p[0], p[1], p[2] + step }) - body.Evaluate({ p[0], p[1], p[2] - step })) / 2 / step;
      EXPECT_NEAR(gradient[2], slope, 1e-4);
    }
  }
}

TEST(BodyField, GapBetweenFingersOfTheHandWidens)
{
  const ReferenceField hand = MakeHand();
  const auto points = PointsInGapOfHand();
  EXPECT_LT(points.front().width, 0.01);
  EXPECT_NEAR(points.back().width, 0.1, 0.01);
  for (const auto & [p, width] : points)
  {
    for (const double side : { -1.0, 1.0 })
    {
      EXPECT_LT(hand.Evaluate({ p[0] + side * (0.5 * width - 1e-3), p[1], p[2] }), 0.0);
      EXPECT_GT(hand.Evaluate({ p[0] + side * (0.5 * width + 1e-3), p[1], p[2] }), 0.0);
    }
  }
}

TEST(SurfaceErrors, AreThoseOfVTK)
{
  // Of random spheres and tori against each other; vtkHausdorffDistancePointSetFilter has distances from points to
  // cells.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-0.3, 0.3);
  for (unsigned int run = 0; run < 10; ++run)
  {
    const ReferenceField sphere =
      MakeSphereField({ 10.0 + coordinate(random), 10.0 + coordinate(random), 10.0 }, 6.0 + coordinate(random));
    const ReferenceField torus =
      MakeTorusField({ 10.0, 10.0, 10.0 }, { coordinate(random), 0.2, coordinate(random) }, 5.0, 2.0);
    const auto a = GetComparedMethod("flying-edges").prepare(sphere, cube, 1.0).extract();
    const auto b = GetComparedMethod("lean").prepare(torus, cube, 1.0).extract();
    const itk::TriangleTree treeOfA(*a);
    const itk::TriangleTree treeOfB(*b);
    const double ours[]{ ComputePointDistances(*a, NearestOnMesh(treeOfB), everywhere).maximumDistance,
                         ComputePointDistances(*b, NearestOnMesh(treeOfA), everywhere).maximumDistance };
    vtkNew<vtkHausdorffDistancePointSetFilter> filter;
    filter->SetInputData(0, SurfaceToPolyData(a));
    filter->SetInputData(1, SurfaceToPolyData(b));
    filter->SetTargetDistanceMethodToPointToCell();
    filter->Update();
    EXPECT_NEAR(filter->GetRelativeDistance()[0], ours[0], 1e-5);
    EXPECT_NEAR(filter->GetRelativeDistance()[1], ours[1], 1e-5);
    EXPECT_NEAR(filter->GetHausdorffDistance(), std::max(ours[0], ours[1]), 1e-5);
  }
}
