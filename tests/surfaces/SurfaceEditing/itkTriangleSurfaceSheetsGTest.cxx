#include "itkExampleSurfaces.h"
#include "itkTriangleSurfaceSimplification.h"
#include "itkTriangleSurfaceSmoothing.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace
{

using Surface = itk::TriangleSurface;
using Sheets = itk::BulkVector<std::uint32_t>;

constexpr std::uint32_t Length = 12;
constexpr double Pi = 3.14159265358979323846;

/** Flat pages of Length x Length squares that meet at the z axis, each turned by one of \a turns from the last. */
Surface::Pointer
MakeBook(std::uint32_t pages, std::uint32_t turns, Sheets & sheets)
{
  const auto book = Surface::New();
  for (std::uint32_t z = 0; z <= Length; ++z)
  {
    book->GetPoints().push_back({ 0.0f, 0.0f, static_cast<float>(z) });
  }
  for (std::uint32_t page = 0; page < pages; ++page)
  {
    const double angle = 2.0 * Pi * page / turns;
    const auto idOf = [&](std::uint32_t column, std::uint32_t z) {
      return column == 0 ? z : (1 + page * Length + column - 1) * (Length + 1) + z;
    };
    for (std::uint32_t column = 1; column <= Length; ++column)
    {
      for (std::uint32_t z = 0; z <= Length; ++z)
      {
        book->GetPoints().push_back({ static_cast<float>(column * std::cos(angle)),
                                      static_cast<float>(column * std::sin(angle)),
                                      static_cast<float>(z) });
      }
    }
    for (std::uint32_t column = 0; column < Length; ++column)
    {
      for (std::uint32_t z = 0; z < Length; ++z)
      {
        book->GetTriangles().push_back({ idOf(column, z), idOf(column + 1, z), idOf(column + 1, z + 1) });
        book->GetTriangles().push_back({ idOf(column, z), idOf(column + 1, z + 1), idOf(column, z + 1) });
        sheets.insert(sheets.end(), 2, page);
      }
    }
  }
  return book;
}

/** Two spheres of radius 1 that have one point in common. */
Surface::Pointer
MakeTouchingSpheres(Sheets & sheets, std::uint32_t & common)
{
  const auto isLess = [](const auto & a, const auto & b) { return a[0] < b[0]; };
  const auto both = itk::example::MakeSphere(1.0, 3);
  const auto second = itk::example::MakeSphere(1.0, 3);
  auto & points = both->GetPoints();
  common = static_cast<std::uint32_t>(std::max_element(points.begin(), points.end(), isLess) - points.begin());
  const auto & others = second->GetPoints();
  const auto replaced =
    static_cast<std::uint32_t>(std::min_element(others.begin(), others.end(), isLess) - others.begin());
  const std::array<float, 3> shift{ points[common][0] - others[replaced][0],
                                    points[common][1] - others[replaced][1],
                                    points[common][2] - others[replaced][2] };
  const auto first = static_cast<std::uint32_t>(points.size());
  sheets.assign(both->GetNumberOfTriangles(), 0);
  sheets.resize(2 * sheets.size(), 1);
  for (const auto & point : others)
  {
    points.push_back({ point[0] + shift[0], point[1] + shift[1], point[2] + shift[2] });
  }
  for (auto triangle : second->GetTriangles())
  {
    for (std::uint32_t & point : triangle)
    {
      point = point == replaced ? common : first + point;
    }
    both->GetTriangles().push_back(triangle);
  }
  both->GetNormals().clear();
  both->RemoveUnusedPoints();
  return both;
}

itk::TriangleSurfaceSmoothingSettings
MovesUpTo(double maximumMove)
{
  itk::TriangleSurfaceSmoothingSettings settings;
  settings.maximumMove = maximumMove;
  return settings;
}

itk::TriangleSurfaceSimplificationSettings
ErrorUpTo(double maximumError)
{
  itk::TriangleSurfaceSimplificationSettings settings;
  settings.maximumError = maximumError;
  return settings;
}

/** How far a point is from the z axis. */
double
FromAxis(const Surface::PointType & point)
{
  return std::hypot(double{ point[0] }, double{ point[1] });
}

TEST(TriangleSurfaceSheets, CurvesAreSmoothedAndBordersStay)
{
  for (const std::uint32_t pages : { 3u, 4u, 7u })
  {
    Sheets sheets;
    const auto book = MakeBook(pages, pages, sheets);
    std::mt19937 random(pages);
    std::uniform_real_distribution<float> noise(-0.2f, 0.2f);
    double before = 0.0;
    for (std::uint32_t z = 1; z < Length; ++z)
    {
      book->GetPoints()[z][0] += noise(random);
      book->GetPoints()[z][1] += noise(random);
      before += FromAxis(book->GetPoints()[z]);
    }
    const auto start = book->GetPoints();
    const auto report = SmoothTriangleSurface(*book, MovesUpTo(0.5));
    double after = 0.0;
    for (std::uint32_t z = 1; z < Length; ++z)
    {
      after += FromAxis(book->GetPoints()[z]);
    }
    EXPECT_LT(after, 0.7 * before);
    const itk::SizeValueType onBorder = 2 + pages * (3 * Length - 1); // the axis' ends, and three sides of each page
    EXPECT_EQ(report.pointsOnBorder, onBorder);
    EXPECT_EQ(book->GetPoints()[0], start[0]);
    EXPECT_EQ(book->GetPoints()[Length], start[Length]);
  }
}

TEST(TriangleSurfaceSheets, FlatPagesStayFlatAndMeetAtTheirCurve)
{
  for (const auto & [pages, turns] : { std::array{ 3u, 3u }, { 3u, 4u }, { 4u, 4u }, { 7u, 7u } }) // 3 of 4: a T
  {
    Sheets sheets;
    const auto book = MakeBook(pages, turns, sheets);
    const auto report = SimplifyTriangleSurface(*book, sheets, ErrorUpTo(0.05));
    EXPECT_LT(report.trianglesAfter, report.trianglesBefore / 2);
    ASSERT_EQ(sheets.size(), book->GetNumberOfTriangles());
    std::map<std::array<std::uint32_t, 2>, std::set<std::uint32_t>> sheetsOfEdges;
    std::vector<double> areas(pages, 0.0);
    for (std::size_t id = 0; id < sheets.size(); ++id)
    {
      const auto & triangle = book->GetTriangles()[id];
      const double angle = 2.0 * Pi * sheets[id] / turns;
      std::array<std::array<double, 2>, 3> onPage{};
      for (unsigned int corner = 0; corner < 3; ++corner)
      {
        const auto & point = book->GetPoints()[triangle[corner]];
        ASSERT_NEAR(point[1] * std::cos(angle) - point[0] * std::sin(angle), 0.0, 1e-3);
        onPage[corner] = { point[0] * std::cos(angle) + point[1] * std::sin(angle), point[2] };
        const auto [low, high] = std::minmax(triangle[corner], triangle[(corner + 1) % 3]);
        sheetsOfEdges[{ low, high }].insert(sheets[id]);
      }
      const auto & [a, b, c] = onPage;
      areas[sheets[id]] += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
    for (const double area : areas)
    {
      EXPECT_NEAR(area, Length * Length, 1e-2);
    }
    double curve = 0.0;
    for (const auto & [edge, found] : sheetsOfEdges)
    {
      if (found.size() > 1)
      {
        const auto & a = book->GetPoints()[edge[0]];
        const auto & b = book->GetPoints()[edge[1]];
        EXPECT_EQ(found.size(), pages);
        EXPECT_NEAR(FromAxis(a) + FromAxis(b), 0.0, 1e-3);
        curve += std::abs(double{ a[2] } - b[2]);
      }
    }
    EXPECT_NEAR(curve, Length, 1e-3);
  }
}

/** Two cones and a disc, each of \a edges triangles, that meet in a ring. */
Surface::Pointer
MakeRing(std::uint32_t edges, Sheets & sheets)
{
  const auto ring = Surface::New();
  for (std::uint32_t n = 0; n < edges; ++n)
  {
    const double angle = 2.0 * Pi * n / edges;
    ring->GetPoints().push_back({ static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.0f });
  }
  for (std::uint32_t sheet = 0; sheet < 3; ++sheet)
  {
    ring->GetPoints().push_back({ 0.0f, 0.0f, static_cast<float>(sheet) - 1.0f });
    for (std::uint32_t n = 0; n < edges; ++n)
    {
      ring->GetTriangles().push_back({ n, (n + 1) % edges, edges + sheet });
    }
    sheets.insert(sheets.end(), edges, sheet);
  }
  return ring;
}

TEST(TriangleSurfaceSheets, RingsKeepThreeEdges)
{
  for (const std::uint32_t edges : { 3u, 4u, 5u, 24u })
  {
    Sheets sheets;
    const auto ring = MakeRing(edges, sheets);
    SimplifyTriangleSurface(*ring, sheets, ErrorUpTo(10.0));
    const auto topology = itk::ComputeTriangleSurfaceTopology(*ring);
    EXPECT_GE(topology.nonManifoldEdges, 3u) << edges;
    EXPECT_LE(topology.nonManifoldEdges, std::max(3u, edges / 2)) << edges;
    EXPECT_EQ(topology.eulerCharacteristic, 3) << "a ring with three discs";
    EXPECT_EQ(topology.degenerateTriangles + topology.duplicateTriangles, 0u);
    EXPECT_EQ(std::set<std::uint32_t>(sheets.begin(), sheets.end()).size(), 3u);
  }
}

TEST(TriangleSurfaceSheets, PointsWhereSheetsTouchStay)
{
  Sheets sheets;
  std::uint32_t common = 0;
  const auto spheres = MakeTouchingSpheres(sheets, common);
  const auto point = spheres->GetPoints()[common];
  ASSERT_EQ(itk::ComputeTriangleSurfaceTopology(*spheres).nonManifoldPoints, 1u);
  EXPECT_EQ(SmoothTriangleSurface(*spheres, MovesUpTo(0.05)).pointsOnBorder, 1u);
  EXPECT_EQ(spheres->GetPoints()[common], point);
  SimplifyTriangleSurface(*spheres, sheets, ErrorUpTo(0.1));
  EXPECT_EQ(itk::ComputeTriangleSurfaceTopology(*spheres).nonManifoldPoints, 1u);
  EXPECT_EQ(std::count(spheres->GetPoints().begin(), spheres->GetPoints().end(), point), 1);
}

TEST(TriangleSurfaceSheets, RefusesSheetsThatPartWithinAManifold)
{
  const auto sphere = itk::example::MakeSphere(1.0, 3);
  Sheets sheets(sphere->GetNumberOfTriangles(), 0);
  sheets[7] = 1;
  EXPECT_THROW(SimplifyTriangleSurface(*sphere, sheets, ErrorUpTo(0.1)), itk::ExceptionObject);
  sheets.pop_back();
  EXPECT_THROW(SimplifyTriangleSurface(*sphere, sheets, ErrorUpTo(0.1)), itk::ExceptionObject);
}

} // namespace
