#include "itkFCCCells.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

namespace
{

using Cells = itk::FCCCells;
using Site = itk::FCCLattice::SiteType;
using Step = itk::FCCStep;

/** The sites of a simplex that is stored by the site 0. */
std::set<Site>
SitesOf(const Cells::Simplex & simplex)
{
  return { simplex.steps, simplex.steps + simplex.size };
}

bool
AreJoined(unsigned int a, unsigned int b)
{
  return (Cells::Adjacent[a] >> b & 1) != 0;
}

TEST(FCCCells, SimplicesAreStoredOnceByTheirLowestSite)
{
  std::set<std::set<Site>> found;
  unsigned int sizes[5] = {};
  for (const Cells::Simplex & simplex : Cells::Simplices)
  {
    ++sizes[simplex.size];
    EXPECT_TRUE(found.insert(SitesOf(simplex)).second);
    EXPECT_EQ(simplex.steps[0], (Site{ 0, 0, 0 }));
    for (unsigned int n = 0; n < simplex.size; ++n)
    {
      EXPECT_TRUE(itk::FCCLattice::IsSite(simplex.steps[n]));
      EXPECT_TRUE(n == 0 || Step::IsLower(simplex.steps[n - 1], simplex.steps[n]));
    }
  }
  EXPECT_EQ(sizes[2], Cells::Edges);
  EXPECT_EQ(sizes[3], Cells::Faces);
  EXPECT_EQ(sizes[4], Cells::Tetrahedra);
}

TEST(FCCCells, PartsAreWhereTheirSitesAre)
{
  for (const Cells::Simplex & simplex : Cells::Simplices)
  {
    for (unsigned int set = 1; set < 1u << simplex.size; ++set)
    {
      if (Cells::SizeOf(set) < 2)
      {
        continue;
      }
      const Cells::Part & part = simplex.parts[set];
      ASSERT_LT(part.type, Cells::Types);
      const Cells::Simplex & type = Cells::Simplices[part.type];
      unsigned int member = 0;
      for (unsigned int n = 0; n < simplex.size; ++n)
      {
        if ((set >> n & 1) != 0)
        {
          EXPECT_EQ(Step::Subtract(simplex.steps[n], simplex.steps[part.site]), type.steps[member++]);
        }
      }
      EXPECT_EQ(member, type.size);
    }
  }
}

/** The edges, faces and tetrahedra are all sets of two, three and four sites that OwnedEdges join pairwise. */
TEST(FCCCells, SimplicesAreAllSetsOfNeighbors)
{
  std::set<std::set<Site>> expected;
  for (unsigned int a = 0; a < Cells::Edges; ++a)
  {
    expected.insert({ { 0, 0, 0 }, Cells::StepOf(a) });
    for (unsigned int b = 0; b < a; ++b)
    {
      for (unsigned int c = 0; AreJoined(a, b) && c <= b; ++c)
      {
        if (c == b || (AreJoined(a, c) && AreJoined(b, c)))
        {
          expected.insert({ { 0, 0, 0 }, Cells::StepOf(a), Cells::StepOf(b), Cells::StepOf(c) });
        }
      }
    }
  }
  std::set<std::set<Site>> found;
  for (const Cells::Simplex & simplex : Cells::Simplices)
  {
    found.insert(SitesOf(simplex));
  }
  EXPECT_EQ(found, expected);
}

TEST(FCCCells, TetrahedraFillSpace)
{
  itk::IndexValueType sixVolumes = 0;
  for (unsigned int type = Cells::FirstTetrahedron; type < Cells::Types; ++type)
  {
    const auto & steps = Cells::Simplices[type].steps;
    const auto orientation = Step::Orientation(steps[0], steps[1], steps[2], steps[3]);
    EXPECT_EQ(std::abs(orientation), 2) << "all have a sixth of a Voronoi cell's volume";
    EXPECT_EQ(orientation > 0, Cells::Simplices[type].isPositive);
    sixVolumes += std::abs(orientation);
  }
  EXPECT_EQ(static_cast<double>(sixVolumes), 6.0 * itk::FCCLattice::CellVolume);

  // Each point of a fine grid that avoids all faces is in one tetrahedron. Coordinates are in hundredths.
  constexpr itk::IndexValueType fine = 100;
  std::mt19937 random(5);
  std::uniform_int_distribution<itk::IndexValueType> coordinate(-fine, fine);
  for (int trial = 0; trial < 2000; ++trial)
  {
    const Site point{ coordinate(random), coordinate(random), coordinate(random) };
    int holding = 0;
    bool isOnFace = false;
    for (itk::IndexValueType n = 0; n < 343; ++n)
    {
      const Site lowest{ n % 7 - 3, n / 7 % 7 - 3, n / 49 - 3 };
      for (unsigned int type = Cells::FirstTetrahedron; itk::FCCLattice::IsSite(lowest) && type < Cells::Types; ++type)
      {
        bool isHolding = true;
        for (unsigned int corner = 0; corner < 4; ++corner)
        {
          Site corners[4];
          for (unsigned int site = 0; site < 4; ++site)
          {
            corners[site] = Step::Multiply(fine, Step::Add(lowest, Cells::Simplices[type].steps[site]));
          }
          corners[corner] = point;
          const auto side = Step::Orientation(corners[0], corners[1], corners[2], corners[3]);
          isHolding = isHolding && side != 0 && (side > 0) == Cells::Simplices[type].isPositive;
          isOnFace = isOnFace || side == 0;
        }
        holding += isHolding ? 1 : 0;
      }
    }
    EXPECT_TRUE(holding == 1 || (isOnFace && holding == 0));
  }
}

TEST(FCCCells, NeighborsAreTheNearestSitesAndThoseAlongTheRow)
{
  std::set<Site> found;
  for (unsigned int direction = 0; direction < Cells::Directions; ++direction)
  {
    const Site step = Cells::StepOf(direction);
    EXPECT_TRUE(found.insert(step).second);
    EXPECT_EQ(Cells::DirectionOf(step), direction);
    EXPECT_EQ(Cells::StepOf(Cells::OppositeOf(direction)), Step::Multiply(-1, step));
    EXPECT_EQ(direction < Cells::Edges, Step::IsLower({ 0, 0, 0 }, step)) << "the lower end stores an edge";
  }
  std::set<Site> expected(itk::FCCLattice::NearestNeighbors.begin(), itk::FCCLattice::NearestNeighbors.end());
  expected.insert({ { 2, 0, 0 }, { -2, 0, 0 } });
  EXPECT_EQ(found, expected);
  EXPECT_EQ(Cells::DirectionOf({ 0, 0, 0 }), Cells::Directions);
  EXPECT_EQ(Cells::DirectionOf({ 0, 2, 0 }), Cells::Directions);
}

/** The members of a set, and the edges and triangles of the link between them. */
int
EulerCharacteristic(unsigned int set)
{
  int points = 0;
  int edges = 0;
  int triangles = 0;
  for (unsigned int a = 0; a < Cells::Directions; ++a)
  {
    points += static_cast<int>(set >> a & 1);
    for (unsigned int b = 0; b < a; ++b)
    {
      const bool hasEdge = (set >> a & set >> b & 1) != 0 && AreJoined(a, b);
      edges += hasEdge ? 1 : 0;
      for (unsigned int c = 0; hasEdge && c < b; ++c)
      {
        triangles += (set >> c & 1) != 0 && AreJoined(a, c) && AreJoined(b, c) ? 1 : 0;
      }
    }
  }
  return points - edges + triangles;
}

TEST(FCCCells, LinkIsATriangulatedSphere)
{
  EXPECT_EQ(EulerCharacteristic(Cells::AllDirections), 2);
  int ends = 0;
  for (unsigned int a = 0; a < Cells::Directions; ++a)
  {
    EXPECT_FALSE(AreJoined(a, a));
    ends += __builtin_popcount(Cells::Adjacent[a]);
    for (unsigned int b = 0; b < Cells::Directions; ++b)
    {
      EXPECT_EQ(AreJoined(a, b), AreJoined(b, a));
      if (AreJoined(a, b))
      {
        EXPECT_EQ(__builtin_popcount(Cells::Adjacent[a] & Cells::Adjacent[b]), 2) << "two triangles at each edge";
      }
    }
    const auto first = static_cast<unsigned int>(__builtin_ctz(Cells::Adjacent[a]));
    EXPECT_EQ(Cells::PartOf(Cells::Adjacent[a], first), Cells::Adjacent[a]) << "one fan of triangles at each neighbour";
  }
  EXPECT_EQ(ends, 2 * 36);
}

TEST(FCCCells, DisksAreConnectedSetsOfEulerCharacteristicOne)
{
  EXPECT_FALSE(Cells::IsDisk(0));
  EXPECT_FALSE(Cells::IsDisk(Cells::AllDirections));
  for (unsigned int set = 1; set <= Cells::AllDirections; ++set)
  {
    const bool isConnected = Cells::PartOf(set, static_cast<unsigned int>(__builtin_ctz(set))) == set;
    EXPECT_EQ(Cells::IsDisk(set), isConnected && EulerCharacteristic(set) == 1) << set;
  }
}

} // namespace
