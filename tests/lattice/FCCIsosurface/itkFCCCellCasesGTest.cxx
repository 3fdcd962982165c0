#include "itkFCCCellCases.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace
{

using Octahedron = itk::FCCOctahedron;
using Parallelepiped = itk::FCCParallelepiped;
using Site = itk::FCCLattice::SiteType;
using EdgePair = std::pair<unsigned int, unsigned int>;

template <typename TKind>
class FCCCellCases : public testing::Test
{};
using Kinds = testing::Types<Octahedron, itk::FCCTetrahedronAfter, itk::FCCTetrahedronBefore, Parallelepiped>;
TYPED_TEST_SUITE(FCCCellCases, Kinds, );

bool
IsInside(unsigned int pattern, unsigned int corner)
{
  return (pattern >> corner & 1) != 0;
}

TYPED_TEST(FCCCellCases, CellsAreConvexPolyhedraOfSitesAndStoredEdges)
{
  const itk::LatticeCell & cell = TypeParam::Cell;
  EXPECT_EQ(cell.numberOfCorners + cell.numberOfFaces, cell.numberOfEdges + 2) << "Euler's formula";
  std::map<EdgePair, int> sides;
  for (unsigned int face = 0; face < cell.numberOfFaces; ++face)
  {
    const auto & corners = cell.faces[face].corners;
    const unsigned int size = cell.faces[face].size;
    for (unsigned int n = 0; n < size; ++n)
    {
      ++sides[{ corners[n], corners[(n + 1) % size] }];
      for (unsigned int corner = 0; corner < cell.numberOfCorners; ++corner)
      {
        EXPECT_LE(cell.Orientation(corners[n], corners[(n + 1) % size], corners[(n + 2) % size], corner), 0);
      }
    }
  }
  EXPECT_EQ(sides.size(), 2 * cell.numberOfEdges);
  for (const auto & [side, count] : sides)
  {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(sides.count({ side.second, side.first }), 1u);
  }
  for (unsigned int edge = 0; edge < cell.numberOfEdges; ++edge)
  {
    EXPECT_EQ(itk::FCCStep::Subtract(cell.corners[cell.edges[edge].end], cell.corners[cell.edges[edge].start]),
              itk::FCCLattice::OwnedEdges[cell.edges[edge].type]);
  }
  for (unsigned int corner = 0; corner < cell.numberOfCorners; ++corner)
  {
    EXPECT_TRUE(itk::FCCLattice::IsSite(cell.corners[corner]));
  }
}

// The border of the triangles runs over the faces of the cell with the inside on its left, seen from outside the cell,
// and passes each cut edge once; all other sides of triangles are inner ones.
TYPED_TEST(FCCCellCases, TrianglesSpanTheSegmentsOfTheFaces)
{
  const itk::LatticeCell & cell = TypeParam::Cell;
  for (unsigned int pattern = 0; pattern < TypeParam::Cases.cases.size(); ++pattern)
  {
    const auto & found = TypeParam::Cases.cases[pattern];
    std::set<EdgePair> sides;
    for (unsigned int n = 0; n < found.triangles; ++n)
    {
      for (unsigned int corner = 0; corner < 3; ++corner)
      {
        const EdgePair side(found.edges[n][corner], found.edges[n][(corner + 1) % 3]);
        EXPECT_NE(side.first, side.second);
        EXPECT_TRUE(sides.insert(side).second) << "two triangles run along one side in the same direction";
      }
    }
    std::set<unsigned int> starts;
    for (const EdgePair & side : sides)
    {
      const bool isOnFace = cell.onOneFace[side.first][side.second];
      const bool isInner = sides.count({ side.second, side.first }) == 1;
      ASSERT_NE(isOnFace, isInner) << "diagonals keep off the faces";
      if (isOnFace)
      {
        EXPECT_TRUE(starts.insert(side.first).second);
        for (unsigned int face = 0; face < cell.numberOfFaces; ++face)
        {
          const auto & polygon = cell.faces[face];
          if (cell.IsOn(cell.edges[side.first], polygon) && cell.IsOn(cell.edges[side.second], polygon))
          {
            // Counter-clockwise along the face's border, the surface is entered at the start of a segment.
            for (unsigned int n = 0; n < polygon.size; ++n)
            {
              const unsigned int from = polygon.corners[n];
              const unsigned int to = polygon.corners[(n + 1) % polygon.size];
              if (TypeParam::Cases.EdgeBetween(cell, from, to) == side.first)
              {
                EXPECT_TRUE(!IsInside(pattern, from) && IsInside(pattern, to)) << pattern;
              }
            }
          }
        }
      }
    }
    std::set<unsigned int> cut;
    for (unsigned int edge = 0; edge < cell.numberOfEdges; ++edge)
    {
      if (IsInside(pattern, cell.edges[edge].start) != IsInside(pattern, cell.edges[edge].end))
      {
        cut.insert(edge);
      }
    }
    EXPECT_EQ(starts, cut) << pattern;
  }
}

TEST(FCCOctahedraCases, HaveTheTrianglesOfTheirKinds)
{
  // Corners 0 and 1 are opposite, as are 2 and 3, and 4 and 5.
  const auto trianglesOf = [](unsigned int pattern) {
    EXPECT_EQ(Octahedron::Cases.cases[pattern].triangles, Octahedron::Cases.cases[63 - pattern].triangles);
    return static_cast<unsigned int>(Octahedron::Cases.cases[pattern].triangles);
  };
  EXPECT_EQ(trianglesOf(0b000000), 0u);
  EXPECT_EQ(trianglesOf(0b000001), 2u);
  EXPECT_EQ(trianglesOf(0b000101), 4u) << "a pair of neighbours";
  EXPECT_EQ(trianglesOf(0b000011), 4u) << "an opposite pair: two caps";
  EXPECT_EQ(trianglesOf(0b010101), 4u) << "a face";
  EXPECT_EQ(trianglesOf(0b000111), 6u) << "an opposite pair and another corner";
  EXPECT_EQ(itk::FCCLattice::OwnedEdges.size(), 7u);
  EXPECT_EQ(Octahedron::Cell.GetEdgeTypes(), 0x7e) << "all but the row edge";
}

TEST(FCCParallelepipedCases, ConnectSitesAcrossShortDiagonals)
{
  const itk::LatticeCell & cell = Parallelepiped::Cell;
  EXPECT_EQ(cell.GetEdgeTypes(), 0b101010) << "(1, 1, 0), (1, 0, 1) and (0, 1, 1)";
  for (unsigned int a = 0; a < cell.numberOfCorners; ++a)
  {
    for (unsigned int b = 0; b < a; ++b)
    {
      const auto squared = itk::FCCStep::SquaredLength(itk::FCCStep::Subtract(cell.corners[a], cell.corners[b]));
      const unsigned int triangles = Parallelepiped::Cases.cases[1u << a | 1u << b].triangles;
      const unsigned int inverted = Parallelepiped::Cases.cases[255 ^ (1u << a | 1u << b)].triangles;
      switch (squared)
      {
        case 2: // an edge, or the short diagonal of a face
          EXPECT_TRUE(triangles == 2 || triangles == 4);
          EXPECT_EQ(inverted, triangles) << "connected whether inside or outside";
          break;
        default: // the long diagonal of a face, or one of the cell
          EXPECT_EQ(triangles, 2u) << "two caps";
          EXPECT_EQ(inverted, 2u);
      }
    }
  }
}

} // namespace
