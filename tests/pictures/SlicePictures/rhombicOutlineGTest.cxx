#include "rhombicSlicePicture.h"

#include "itkExampleSurfaces.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkFCCTestImages.h"
#include "itkMultiThreaderBase.h"
#include "itkTriangleSurfaceMeasures.h"
#include "rhombicSliceTestScans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using itk::TriangleSurface;
using rhombic::CutSurface;
using rhombic::Dot;
using rhombic::Outline;
using rhombic::PicturePosition;
using rhombic::Projection;
using rhombic::Vector3;
using slicetest::FrameAlong;
using slicetest::RandomFrame;

constexpr double Pi = 3.14159265358979323846;

/** A plane at a depth from the origin, with pixels of 0.5 mm. */
Projection
PlaneAt(const rhombic::ViewFrame & frame, double depth)
{
  return { frame, { depth * frame.look[0], depth * frame.look[1], depth * frame.look[2] }, 0.5, 200, 100 };
}

const rhombic::ViewFrame AlongZ = FrameAlong({ 0, 0, 1 }, { 1, 0, 0 });

/** In mm^2, positive for curves that run clockwise in the picture. */
double
AreaOf(const Outline & outline, const Projection & plane)
{
  double area = 0.0;
  for (std::size_t n = 0; n < outline.points.size(); ++n)
  {
    const PicturePosition & a = outline.points[n];
    const PicturePosition & b = outline.points[(n + 1) % outline.points.size()];
    area += 0.5 * (a.x * b.y - b.x * a.y);
  }
  return area * plane.pixelSize * plane.pixelSize;
}

double
AreaOf(const std::vector<Outline> & outlines, const Projection & plane)
{
  double area = 0.0;
  for (const Outline & outline : outlines)
  {
    EXPECT_TRUE(outline.isClosed);
    area += AreaOf(outline, plane);
  }
  return area;
}

double
LengthOf(const std::vector<Outline> & outlines, const Projection & plane)
{
  double length = 0.0;
  for (const Outline & outline : outlines)
  {
    for (std::size_t n = outline.isClosed ? 0 : 1; n < outline.points.size(); ++n)
    {
      const PicturePosition & a = outline.points[n == 0 ? outline.points.size() - 1 : n - 1];
      const PicturePosition & b = outline.points[n];
      length += plane.pixelSize * std::hypot(a.x - b.x, a.y - b.y);
    }
  }
  return length;
}

/** The sum of the lengths of all triangles' cuts, one by one, in 3D. */
double
LengthOfTriangleCuts(const TriangleSurface & surface, const Projection & plane)
{
  double sum = 0.0;
  for (const auto & triangle : surface.GetTriangles())
  {
    std::vector<Vector3> ends;
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const auto pointOf = [&surface](std::uint32_t n) {
        const auto & point = surface.GetPoints()[n];
        return Vector3{ point[0], point[1], point[2] };
      };
      const Vector3 a = pointOf(triangle[corner]);
      const Vector3 b = pointOf(triangle[(corner + 1) % 3]);
      const double from = Dot(a, plane.frame.look) - Dot(plane.centre, plane.frame.look);
      const double to = Dot(b, plane.frame.look) - Dot(plane.centre, plane.frame.look);
      if ((from < 0.0) != (to < 0.0))
      {
        const double share = from / (from - to);
        ends.push_back({ a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2]) });
      }
    }
    if (ends.size() == 2)
    {
      const Vector3 d{ ends[0][0] - ends[1][0], ends[0][1] - ends[1][1], ends[0][2] - ends[1][2] };
      sum += std::sqrt(Dot(d, d));
    }
  }
  return sum;
}

TEST(Outline, SpheresGiveCirclesOfTheExactArea)
{
  std::mt19937 random(1);
  const double radius = 20.0;
  const auto sphere = itk::example::MakeSphere(radius, 6, { 3.0, -5.0, 11.0 });
  for (int trial = 0; trial < 30; ++trial)
  {
    Projection plane = PlaneAt(RandomFrame(random), 0.0);
    const double depth = -18.0 + 1.25 * trial;
    for (std::size_t n = 0; n < 3; ++n)
    {
      plane.centre[n] = std::array<double, 3>{ 3.0, -5.0, 11.0 }[n] + depth * plane.frame.look[n];
    }
    const auto outlines = CutSurface(*sphere, plane);
    ASSERT_EQ(outlines.size(), 1U);
    const double circle = radius * radius - depth * depth;
    EXPECT_NEAR(AreaOf(outlines, plane), Pi * circle, 2e-3 * Pi * radius * radius);
    EXPECT_NEAR(LengthOf(outlines, plane), LengthOfTriangleCuts(*sphere, plane), 1e-9 * radius);
    for (const PicturePosition & position : outlines[0].points)
    {
      const double distance = 0.5 * std::hypot(position.x - 100.0, position.y - 50.0);
      EXPECT_NEAR(distance * distance, circle, 2e-3 * radius * radius);
    }
  }
}

TEST(Outline, HolesRunTheOtherWay)
{
  const auto torus = itk::example::MakeTorus(20.0, 6.0, 200);
  const Projection across = PlaneAt(AlongZ, 1.0);
  const auto rings = CutSurface(*torus, across);
  ASSERT_EQ(rings.size(), 2U);
  EXPECT_LT(AreaOf(rings[0], across) * AreaOf(rings[1], across), 0.0);
  EXPECT_NEAR(AreaOf(rings, across), 4 * Pi * 20.0 * std::sqrt(35.0), 3.0);

  const Projection along = PlaneAt(FrameAlong({ 0.6, 0.8, 0 }, { 0, 0, 1 }), 0.0);
  const auto discs = CutSurface(*torus, along);
  ASSERT_EQ(discs.size(), 2U);
  EXPECT_NEAR(AreaOf(discs[0], along), Pi * 36.0, 0.5);
  EXPECT_NEAR(AreaOf(discs[1], along), Pi * 36.0, 0.5);

  const auto shell = itk::example::MakeSphere(10.0, 4);
  const auto cavity = itk::example::MakeSphere(5.0, 4);
  itk::example::TurnInsideOut(*cavity);
  itk::example::Append(*shell, *cavity);
  const Projection middle = PlaneAt(AlongZ, 0.1);
  EXPECT_NEAR(AreaOf(CutSurface(*shell, middle), middle), Pi * 75.0, 2.0);
}

/** The cube from the origin to (size, size, size). */
TriangleSurface::Pointer
MakeCube(float size)
{
  auto cube = TriangleSurface::New();
  for (unsigned int n = 0; n < 8; ++n)
  {
    cube->GetPoints().push_back({ size * (n & 1), size * (n >> 1 & 1), size * (n >> 2 & 1) });
  }
  cube->GetTriangles() = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
                           { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  return cube;
}

// Points in the plane are taken to lie behind it: a face in the plane is cut where the body is before the plane.
TEST(Outline, FacesAndPointsInThePlaneAreOnOneSide)
{
  const auto cube = MakeCube(10.0f);
  ASSERT_GT(ComputeTriangleSurfaceVolume(*cube), 0.0);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double sign : { 1.0, -1.0 })
    {
      Vector3 look{};
      look[axis] = sign;
      const auto frame = FrameAlong(look, { look[2], look[0], look[1] });
      for (const double depth : { -10.0, 0.0, 5.0, 10.0 })
      {
        const Projection plane = PlaneAt(frame, depth);
        const double begin = sign > 0.0 ? 0.0 : -10.0;
        const auto outlines = CutSurface(*cube, plane);
        if (depth > begin && depth <= begin + 10.0)
        {
          ASSERT_EQ(outlines.size(), 1U);
          EXPECT_NEAR(AreaOf(outlines, plane), 100.0, 1e-9);
        }
        else
        {
          EXPECT_TRUE(outlines.empty());
        }
      }
    }
  }
  // Planes through edges and corners.
  const double half = std::sqrt(0.5);
  EXPECT_NEAR(AreaOf(CutSurface(*cube, PlaneAt(FrameAlong({ 1, -1, 0 }, { 0, 0, 1 }), 0.0)),
                     PlaneAt(FrameAlong({ 1, -1, 0 }, { 0, 0, 1 }), 0.0)),
              100.0 / half,
              1e-6);
  EXPECT_TRUE(CutSurface(*cube, PlaneAt(FrameAlong({ 1, 1, 1 }, { 0, 0, 1 }), 0.0)).empty());
}

class OutlineOfMode : public testing::TestWithParam<itk::FCCIsosurfaceMode>
{};

// Isovalues and planes that meet samples, lattice planes and edges, and planes at random.
TEST_P(OutlineOfMode, NoiseGivesClosedCurvesAlways)
{
  std::mt19937 random(4);
  for (unsigned int trial = 0; trial < 40; ++trial)
  {
    const auto image =
      fcctest::MakeNoise({ { 0, 0, 0 }, { 4 + trial % 5, 9, 8 } }, trial, 3 + static_cast<int>(trial % 3));
    const auto filter = itk::FCCIsosurfaceFilter<fcctest::ImageType>::New();
    filter->SetInput(image);
    filter->SetIsovalue(trial % 2 == 0 ? 1.0 : 1.3);
    filter->SetMode(GetParam());
    filter->Update();
    const TriangleSurface & surface = *filter->GetOutput();
    ASSERT_GT(surface.GetNumberOfTriangles(), 0U);
    for (int n = 0; n < 12; ++n)
    {
      const bool isRandom = n % 2 == 0;
      Vector3 look{};
      look[static_cast<std::size_t>(n / 2 % 3)] = n % 4 == 1 ? 1.0 : -1.0;
      const Projection plane = PlaneAt(isRandom ? RandomFrame(random) : FrameAlong(look, { look[2], look[0], look[1] }),
                                       isRandom ? 0.37 * n : (n % 4 == 1 ? 0.5 : -0.5) * n);
      const auto outlines = CutSurface(surface, plane);
      EXPECT_GE(AreaOf(outlines, plane), -1e-9); // also expects that all are closed
      if (isRandom)                              // in others, edges of the surface may only touch the plane
      {
        EXPECT_NEAR(LengthOf(outlines, plane), LengthOfTriangleCuts(surface, plane), 1e-6);
      }
    }
  }
}

TEST_P(OutlineOfMode, AreasOfParallelSlicesAddUpToTheVolume)
{
  const auto image = fcctest::MakeImage(0.5, 12.0, [](const fcctest::PointType & p) {
    return std::max(fcctest::Torus(p, 7.0, 3.0), fcctest::Sphere(p, 3.0));
  });
  const auto filter = itk::FCCIsosurfaceFilter<fcctest::ImageType>::New();
  filter->SetInput(image);
  filter->SetIsovalue(0.0);
  filter->SetMode(GetParam());
  filter->Update();
  std::mt19937 random(8);
  for (int trial = 0; trial < 3; ++trial)
  {
    const auto frame = RandomFrame(random);
    constexpr double step = 0.25;
    double volume = 0.0;
    for (double depth = -12.0; depth < 12.0; depth += step)
    {
      const Projection plane = PlaneAt(frame, depth);
      volume += step * AreaOf(CutSurface(*filter->GetOutput(), plane), plane);
    }
    const double expected = ComputeTriangleSurfaceVolume(*filter->GetOutput());
    EXPECT_NEAR(volume, expected, 1e-3 * expected);
  }
}

INSTANTIATE_TEST_SUITE_P(AllModes,
                         OutlineOfMode,
                         testing::Values(itk::FCCIsosurfaceMode::Tetrahedra,
                                         itk::FCCIsosurfaceMode::Octahedra,
                                         itk::FCCIsosurfaceMode::Parallelepipeds,
                                         itk::FCCIsosurfaceMode::Fine,
                                         itk::FCCIsosurfaceMode::Lean));

TEST(Outline, OpenSurfacesGiveOpenCurves)
{
  auto surface = MakeCube(10.0f);
  surface->GetTriangles().resize(10); // without one side
  const Projection plane = PlaneAt(AlongZ, 4.0);
  const auto outlines = CutSurface(*surface, plane);
  ASSERT_EQ(outlines.size(), 1U);
  EXPECT_FALSE(outlines[0].isClosed);
  EXPECT_NEAR(LengthOf(outlines, plane), 30.0, 1e-9);

  surface->GetTriangles().clear();
  EXPECT_TRUE(CutSurface(*surface, plane).empty());

  // Triangles that face at random give pieces that have the same length together.
  const auto loose = itk::example::MakeRandomTriangles(500, 20.0f, 4.0f, 3);
  EXPECT_NEAR(LengthOf(CutSurface(*loose, plane), plane), LengthOfTriangleCuts(*loose, plane), 1e-6);
}

TEST(Outline, TheNumberOfThreadsChangesNothing)
{
  const auto sphere = itk::example::MakeSphere(20.0, 8); // several blocks of triangles
  std::mt19937 random(6);
  const Projection plane = PlaneAt(RandomFrame(random), 3.0);
  const auto before = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  std::vector<PicturePosition> expected;
  for (const itk::ThreadIdType threads : { 1, 2, 3, 8 })
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    const auto outlines = CutSurface(*sphere, plane);
    ASSERT_EQ(outlines.size(), 1U);
    const auto & points = outlines[0].points;
    expected = expected.empty() ? points : expected;
    ASSERT_EQ(points.size(), expected.size());
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      EXPECT_EQ(points[n].x, expected[n].x);
      EXPECT_EQ(points[n].y, expected[n].y);
    }
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(before);
}

} // namespace
