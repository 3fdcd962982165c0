#include "rhombicBCCCells.h"
#include "rhombicCartesianSurfaces.h"

#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

using namespace rhombic;

namespace
{

/** Random values on the BCC lattice, below 0 near the border, so that surfaces are closed. \a share is inside. */
TetrahedraGrid
MakeNoise(unsigned int seed, double share)
{
  constexpr int size = 15;
  const ReferenceField nothing([](const Vector3 &, Vector3 &) { return -1.0; });
  TetrahedraGrid grid = SampleOnBCC(nothing, { 0.0, 0.0, 0.0 }, { size, size, size }, 1.0);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0.0F, 1.0F);
  for (int z = 3; z < size - 3; ++z)
  {
    for (int y = 3; y < size - 3; ++y)
    {
      for (int x = 3; x < size - 3; ++x)
      {
        float & sample = grid.values[grid.GetOffset({ x, y, z })];
        sample = std::isnan(sample) ? sample : static_cast<float>(share) - value(random);
      }
    }
  }
  return grid;
}

/** Counts of the patterns of a cell's corners. */
struct Counts
{
  unsigned int ambiguousFaces = 0; ///< patterns with opposite corners of a quadrilateral inside, the others outside
  unsigned int severalLoops = 0;   ///< with caps, or a band
  unsigned int bands = 0;
  unsigned int aboutAxis = 0; ///< with a point on the axis
  std::size_t mostTriangles = 0;
};

template <typename TKind>
Counts
CountCases()
{
  const auto & cell = TKind::Cell;
  const auto & all = TKind::Cases.cases;
  Counts counts;
  for (unsigned int pattern = 0; pattern < all.size(); ++pattern)
  {
    const auto isInside = [pattern](unsigned int corner) { return (pattern >> corner & 1U) != 0; };
    bool isAmbiguous = false;
    for (unsigned int n = 0; n < cell.numberOfFaces; ++n)
    {
      const auto & face = cell.faces[n];
      isAmbiguous = isAmbiguous || (face.size == 4 && isInside(face.corners[0]) == isInside(face.corners[2]) &&
                                    isInside(face.corners[1]) == isInside(face.corners[3]) &&
                                    isInside(face.corners[0]) != isInside(face.corners[1]));
    }
    counts.ambiguousFaces += isAmbiguous ? 1 : 0;

    // Sides of triangles without an opposite are the loops.
    std::set<std::pair<unsigned int, unsigned int>> sides;
    std::map<unsigned int, unsigned int> next;
    std::set<unsigned int> points;
    for (unsigned int n = 0; n < all[pattern].triangles; ++n)
    {
      for (unsigned int corner = 0; corner < 3; ++corner)
      {
        const unsigned int from = all[pattern].edges[n][corner];
        EXPECT_TRUE(sides.insert({ from, all[pattern].edges[n][(corner + 1) % 3] }).second) << pattern;
        points.insert(from);
      }
    }
    for (const auto & [from, to] : sides)
    {
      if (sides.count({ to, from }) == 0)
      {
        EXPECT_TRUE(next.emplace(from, to).second) << pattern;
        EXPECT_TRUE(cell.onOneFace[from][to]);
      }
    }
    const bool hasAxis = points.erase(cell.numberOfEdges) == 1;
    counts.aboutAxis += hasAxis ? 1 : 0;
    EXPECT_EQ(next.size(), points.size()) << "all other points are on the cell's border";
    unsigned int loops = 0;
    for (auto left = next; !left.empty(); ++loops)
    {
      unsigned int at = left.begin()->first;
      while (left.count(at) != 0)
      {
        const unsigned int to = left[at];
        left.erase(at);
        at = to;
      }
    }
    counts.severalLoops += loops > 1 ? 1 : 0;
    const std::size_t ofCaps = points.size() - 2 * loops + (hasAxis ? 2 : 0);
    const bool isBand = all[pattern].triangles != ofCaps;
    counts.bands += isBand ? 1 : 0;
    EXPECT_TRUE(!isBand || (loops == 2 && all[pattern].triangles == points.size())) << pattern;
    counts.mostTriangles = std::max<std::size_t>(counts.mostTriangles, all[pattern].triangles);
  }
  return counts;
}

/** Six times the volume of a cell's hull. */
itk::IndexValueType
SixVolumes(const itk::LatticeCell & cell)
{
  itk::IndexValueType sum = 0;
  for (unsigned int n = 0; n < cell.numberOfFaces; ++n)
  {
    const auto & face = cell.faces[n];
    for (unsigned int corner = 2; corner < face.size; ++corner)
    {
      sum -= cell.Orientation(face.corners[0], face.corners[corner - 1], face.corners[corner], 0);
    }
  }
  return sum;
}

} // namespace

TEST(BCCCells, AreOctahedraAndHexahedraThatFillSpace)
{
  for (const itk::LatticeCell & cell : { BCCOctahedron<0>::Cell, BCCOctahedron<1>::Cell, BCCOctahedron<2>::Cell })
  {
    EXPECT_EQ(cell.numberOfFaces, 8U);
    EXPECT_EQ(cell.numberOfEdges, 12U) << "all edges are steps of the lattice";
    EXPECT_EQ(3 * SixVolumes(cell), 6 * 8) << "three for each even site, which has a cube of side 2";
  }
  EXPECT_EQ(BCCHexahedron::Cell.numberOfFaces, 6U);
  EXPECT_EQ(BCCHexahedron::Cell.numberOfEdges, 12U);
  EXPECT_EQ(SixVolumes(BCCHexahedron::Cell), 6 * 4) << "one for each site";
}

TEST(BCCCells, CasesAreThoseThatTheReadmeCounts)
{
  const Counts octahedron = CountCases<BCCOctahedron<1>>();
  EXPECT_EQ(octahedron.ambiguousFaces, 0U);
  EXPECT_EQ(octahedron.severalLoops, 6U);
  EXPECT_EQ(octahedron.bands, 2U);
  EXPECT_EQ(octahedron.aboutAxis, 0U);
  EXPECT_EQ(octahedron.mostTriangles, 8U);
  const Counts hexahedron = CountCases<BCCHexahedron>();
  EXPECT_EQ(hexahedron.ambiguousFaces, 120U);
  EXPECT_EQ(hexahedron.severalLoops, 66U);
  EXPECT_EQ(hexahedron.bands, 2U);
  EXPECT_EQ(hexahedron.aboutAxis, 14U);
  EXPECT_EQ(hexahedron.mostTriangles, 12U);
}

TEST(BCCCells, SurfacesOfNoiseAreClosedAndConnectedAsThoseOfTetrahedra)
{
  for (unsigned int seed = 0; seed < 60; ++seed)
  {
    const TetrahedraGrid grid = MakeNoise(seed, 0.1 + 0.8 * (seed % 6) / 5.0);
    const auto tetrahedra = MarchTetrahedra(grid);
    const auto expected = itk::ComputeTriangleSurfaceTopology(*tetrahedra);
    ASSERT_TRUE(expected.IsWatertight());
    for (const auto march : { MarchBCCOctahedra, MarchBCCHexahedra })
    {
      const auto surface = march(grid);
      const auto topology = itk::ComputeTriangleSurfaceTopology(*surface);
      EXPECT_TRUE(topology.IsWatertight()) << seed << '\n' << topology;
      EXPECT_EQ(topology.eulerCharacteristic, expected.eulerCharacteristic) << seed;
      EXPECT_EQ(topology.components, expected.components) << seed;
      EXPECT_EQ(topology.genus, expected.genus) << seed;
      EXPECT_LT(surface->GetNumberOfTriangles(), tetrahedra->GetNumberOfTriangles());
      EXPECT_GT(itk::ComputeTriangleSurfaceVolume(*surface), 0.0) << "triangles look out";
      std::set<std::array<float, 3>> points;
      for (const auto & p : tetrahedra->GetPoints())
      {
        points.insert({ p[0], p[1], p[2] });
      }
      for (const auto & p : surface->GetPoints())
      {
        ASSERT_EQ(points.count({ p[0], p[1], p[2] }), 1U) << "points are those of the tetrahedra";
      }
    }
  }
}
