#include "itkFCCMarchingCases.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace
{

using Cases = itk::FCCMarchingCases;
using Vector = std::array<double, 3>;

Vector
PositionOf(unsigned int kind, unsigned int site)
{
  const auto coordinates = Cases::SiteOf(kind, site);
  return { double(coordinates[0]), double(coordinates[1]), double(coordinates[2]) };
}

Vector
MiddleOf(unsigned int kind, unsigned int edge)
{
  const Vector a = PositionOf(kind, Cases::EdgeSites[edge][0]);
  const Vector b = PositionOf(kind, Cases::EdgeSites[edge][1]);
  return { (a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2 };
}

bool
IsInside(unsigned int pattern, unsigned int site)
{
  return (pattern >> site & 1) != 0;
}

/** The tetrahedron whose sites include both ends of all three edges. */
int
TetrahedronOf(const std::uint8_t (&edges)[3])
{
  for (int tetrahedron = 0; tetrahedron < 3; ++tetrahedron)
  {
    const auto & sites = Cases::TetrahedronSites[tetrahedron];
    const std::set<std::uint8_t> set(sites, sites + 4);
    bool all = true;
    for (const auto edge : edges)
    {
      all = all && set.count(Cases::EdgeSites[edge][0]) != 0 && set.count(Cases::EdgeSites[edge][1]) != 0;
    }
    if (all)
    {
      return tetrahedron;
    }
  }
  return -1;
}

class FCCMarchingCasesTest : public testing::TestWithParam<unsigned int>
{};

TEST_P(FCCMarchingCasesTest, TetrahedraFillAColumnStep)
{
  const unsigned int kind = GetParam();
  for (const auto & sites : Cases::TetrahedronSites)
  {
    // Six times a third of the unit cube each; three of them make one step of the column.
    EXPECT_EQ(std::abs(Cases::Orientation(kind, sites[0], sites[1], sites[2], sites[3])), 2);
    for (const unsigned int site : sites)
    {
      const auto first = Cases::SiteOf(kind, 0);
      const auto coordinates = Cases::SiteOf(kind, site);
      EXPECT_EQ((coordinates[0] + coordinates[1] + coordinates[2] - first[0] - first[1] - first[2]) % 2, 0)
        << "is a site";
    }
  }
}

/** Steps of both kinds have the six tetrahedra of FCCCells. */
TEST(FCCMarchingCases, TetrahedraAreThoseOfFCCCells)
{
  using Sites = std::set<itk::FCCLattice::SiteType>;
  std::set<Sites> found;
  for (unsigned int kind = 0; kind < Cases::Kinds; ++kind)
  {
    for (const auto & sites : Cases::TetrahedronSites)
    {
      auto lowest = Cases::SiteOf(kind, sites[0]);
      for (const unsigned int site : sites)
      {
        const auto other = Cases::SiteOf(kind, site);
        lowest = itk::FCCStep::IsLower(other, lowest) ? other : lowest;
      }
      Sites steps;
      for (const unsigned int site : sites)
      {
        steps.insert(itk::FCCStep::Subtract(Cases::SiteOf(kind, site), lowest));
      }
      EXPECT_TRUE(found.insert(steps).second);
    }
  }
  std::set<Sites> expected;
  for (unsigned int type = itk::FCCCells::FirstTetrahedron; type < itk::FCCCells::Types; ++type)
  {
    const auto & steps = itk::FCCCells::Simplices[type].steps;
    expected.insert({ steps, steps + 4 });
  }
  EXPECT_EQ(found, expected);
}

TEST_P(FCCMarchingCasesTest, EdgesAreThoseOfTheTetrahedraAndAreStoredOnce)
{
  const unsigned int kind = GetParam();
  std::set<std::pair<int, int>> expected;
  for (const auto & sites : Cases::TetrahedronSites)
  {
    for (int a = 0; a < 4; ++a)
    {
      for (int b = 0; b < a; ++b)
      {
        expected.insert(std::minmax<int>(sites[a], sites[b]));
      }
    }
  }
  std::set<std::pair<int, int>> found;
  for (unsigned int edge = 0; edge < Cases::Edges; ++edge)
  {
    const unsigned int ends[2] = { Cases::EdgeSites[edge][0], Cases::EdgeSites[edge][1] };
    found.insert(std::minmax<int>(static_cast<int>(ends[0]), static_cast<int>(ends[1])));
    const auto stored = itk::FCCMarchingTables.storedEdges[kind][edge];
    int starts = 0;
    for (unsigned int end = 0; end < 2; ++end)
    {
      const auto from = Cases::SiteOf(kind, ends[end]);
      const auto to = Cases::SiteOf(kind, ends[1 - end]);
      const auto step = itk::FCCLattice::OwnedEdges[stored.type];
      const bool matches = to[0] - from[0] == step[0] && to[1] - from[1] == step[1] && to[2] - from[2] == step[2] &&
                           stored.row == Cases::RowOf(kind, ends[end]) && stored.pair == ends[end] / 2 &&
                           stored.start == end;
      starts += matches ? 1 : 0;
    }
    EXPECT_EQ(starts, 1);
  }
  EXPECT_EQ(found, expected);
  EXPECT_EQ(found.size(), Cases::Edges);
}

TEST_P(FCCMarchingCasesTest, EverySignPatternGivesOrientedTrianglesOnCutEdges)
{
  const unsigned int kind = GetParam();
  for (unsigned int pattern = 0; pattern < Cases::Cases; ++pattern)
  {
    const auto & entry = itk::FCCMarchingTables.cases[kind][pattern];
    int expected[3] = {};
    for (int tetrahedron = 0; tetrahedron < 3; ++tetrahedron)
    {
      int inside = 0;
      for (const auto site : Cases::TetrahedronSites[tetrahedron])
      {
        inside += IsInside(pattern, site) ? 1 : 0;
      }
      expected[tetrahedron] = inside == 2 ? 2 : inside == 1 || inside == 3 ? 1 : 0;
    }
    int found[3] = {};
    for (unsigned int n = 0; n < entry.triangles; ++n)
    {
      const int tetrahedron = TetrahedronOf(entry.edges[n]);
      ASSERT_GE(tetrahedron, 0);
      ++found[tetrahedron];
      EXPECT_EQ(tetrahedron == 0, n < entry.regularTriangles) << "the regular tetrahedron's triangles come first";

      Vector corners[3];
      for (unsigned int corner = 0; corner < 3; ++corner)
      {
        const auto edge = entry.edges[n][corner];
        EXPECT_NE(IsInside(pattern, Cases::EdgeSites[edge][0]), IsInside(pattern, Cases::EdgeSites[edge][1]));
        corners[corner] = MiddleOf(kind, edge);
      }
      const Vector u{ corners[1][0] - corners[0][0], corners[1][1] - corners[0][1], corners[1][2] - corners[0][2] };
      const Vector v{ corners[2][0] - corners[0][0], corners[2][1] - corners[0][1], corners[2][2] - corners[0][2] };
      const Vector normal{ u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
      for (const auto site : Cases::TetrahedronSites[tetrahedron])
      {
        const Vector position = PositionOf(kind, site);
        double side = 0.0;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          side += normal[axis] * (position[axis] - corners[0][axis]);
        }
        EXPECT_TRUE(IsInside(pattern, site) ? side <= 1e-12 : side >= -1e-12) << "normals point from inside to outside";
      }
    }
    for (int tetrahedron = 0; tetrahedron < 3; ++tetrahedron)
    {
      EXPECT_EQ(found[tetrahedron], expected[tetrahedron]);
    }
  }
}

TEST_P(FCCMarchingCasesTest, TrianglesOfOneTetrahedronShareTheirInnerSideOnly)
{
  const unsigned int kind = GetParam();
  for (unsigned int pattern = 0; pattern < Cases::Cases; ++pattern)
  {
    const auto & entry = itk::FCCMarchingTables.cases[kind][pattern];
    // In opposite directions inside a tetrahedron and between two of them; never twice in the same.
    std::map<std::pair<int, int>, int> sides;
    for (unsigned int n = 0; n < entry.triangles; ++n)
    {
      for (unsigned int corner = 0; corner < 3; ++corner)
      {
        EXPECT_EQ(++sides[std::make_pair(int(entry.edges[n][corner]), int(entry.edges[n][(corner + 1) % 3]))], 1);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FCCMarchingCasesTest, testing::Values(0u, 1u));

} // namespace
