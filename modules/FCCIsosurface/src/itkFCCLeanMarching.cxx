#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkFCCLeanMarching.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkFCCClusterCases.h"
#include "itkFCCLeanMarching.h"

// clang-format off
#ifndef itkFCCLeanMarching_tables
#define itkFCCLeanMarching_tables
// clang-format on
namespace itk
{

/** What follows from FCCMarchingCases for one kind of step. */
struct FCCLeanTables
{
  using Cases = FCCMarchingCases;

  /** The surface's polygon in a tetrahedron: the edges of its corners, in order. */
  struct Polygon
  {
    std::uint8_t corners = 0;
    std::uint8_t edges[4] = {};
    std::uint8_t decider = 0; ///< place of the edge from the lowest corner inside to the lowest one outside
  };

  std::uint8_t storingEnd[Cases::Edges] = {};             ///< which of EdgeSites stores the edge
  std::uint8_t cornerEdges[Cases::Tetrahedra][4][3] = {}; ///< edges at a corner of a tetrahedron
  std::uint8_t cornerEnds[Cases::Tetrahedra][4][3] = {};  ///< which of EdgeSites the corner is
  std::uint8_t edges[Cases::Tetrahedra][6] = {};
  Polygon polygons[Cases::Tetrahedra][16] = {};    ///< by the corners inside
  std::uint64_t use[Cases::Tetrahedra][4][4] = {}; ///< by the corner left out, for each corner
};

/** The lowest of some corners of a tetrahedron by z, then y, then x. */
constexpr unsigned int
LowestSite(unsigned int kind, const std::uint8_t (&sites)[4], unsigned int corners)
{
  unsigned int lowest = FCCMarchingCases::Sites;
  for (unsigned int corner = 0; corner < 4; ++corner)
  {
    if ((corners >> corner & 1) == 0)
    {
      continue;
    }
    if (lowest == FCCMarchingCases::Sites)
    {
      lowest = sites[corner];
      continue;
    }
    const auto candidate = FCCMarchingCases::SiteOf(kind, sites[corner]);
    const auto best = FCCMarchingCases::SiteOf(kind, lowest);
    for (unsigned int axis = 3; axis-- > 0;)
    {
      if (candidate[axis] != best[axis])
      {
        lowest = candidate[axis] < best[axis] ? sites[corner] : lowest;
        break;
      }
    }
  }
  return lowest;
}

constexpr FCCLeanTables
MakeFCCLeanTables(unsigned int kind)
{
  using Cases = FCCMarchingCases;
  FCCLeanTables tables;
  for (unsigned int edge = 0; edge < Cases::Edges; ++edge)
  {
    const Cases::EdgeOwner owner = Cases::OwnerOf(kind, edge);
    const unsigned int first = Cases::EdgeSites[edge][0];
    tables.storingEnd[edge] = Cases::RowOf(kind, first) == owner.row && first / 2 == owner.pair ? 0 : 1;
  }
  for (unsigned int tetrahedron = 0; tetrahedron < Cases::Tetrahedra; ++tetrahedron)
  {
    const auto & sites = Cases::TetrahedronSites[tetrahedron];
    for (unsigned int corner = 0; corner < 4; ++corner)
    {
      for (unsigned int other = 0, n = 0; other < 4; ++other)
      {
        if (other != corner)
        {
          const std::uint8_t edge = Cases::EdgeBetween(sites[corner], sites[other]);
          tables.cornerEdges[tetrahedron][corner][n] = edge;
          tables.cornerEnds[tetrahedron][corner][n] = Cases::EdgeSites[edge][0] == sites[corner] ? 0 : 1;
          ++n;
        }
      }
    }
    for (unsigned int a = 0, n = 0; a < 4; ++a)
    {
      for (unsigned int b = a + 1; b < 4; ++b)
      {
        tables.edges[tetrahedron][n++] = Cases::EdgeBetween(sites[a], sites[b]);
      }
    }
    for (unsigned int inside = 0; inside < 16; ++inside)
    {
      unsigned int pattern = 0;
      for (unsigned int corner = 0; corner < 4; ++corner)
      {
        pattern |= (inside >> corner & 1) << sites[corner];
      }
      Cases::Case found;
      Cases::AddTetrahedron(found, kind, pattern, sites);
      FCCLeanTables::Polygon & polygon = tables.polygons[tetrahedron][inside];
      if (found.triangles > 0)
      {
        polygon.corners = static_cast<std::uint8_t>(2 + found.triangles);
        for (unsigned int n = 0; n < 3; ++n)
        {
          polygon.edges[n] = found.edges[0][n];
        }
        polygon.edges[3] = found.edges[1][2]; // triangles 0 1 2 and 0 2 3
        const std::uint8_t decider =
          Cases::EdgeBetween(LowestSite(kind, sites, inside), LowestSite(kind, sites, ~inside));
        while (polygon.edges[polygon.decider] != decider)
        {
          ++polygon.decider;
        }
      }
    }
    for (unsigned int left = 0; left < 4; ++left)
    {
      for (unsigned int a = 0; a < 4; ++a)
      {
        if (a == left)
        {
          continue;
        }
        tables.use[tetrahedron][left][a] += std::uint64_t{ 1 } << 56;
        for (unsigned int b = 0; b < 4; ++b)
        {
          if (b != left && b != a)
          {
            const std::uint8_t edge = Cases::EdgeBetween(sites[a], sites[b]);
            const unsigned int end = Cases::EdgeSites[edge][0] == sites[a] ? 0 : 1;
            if (tables.storingEnd[edge] == end)
            {
              tables.use[tetrahedron][left][a] += std::uint64_t{ 1 } << (8 * Cases::OwnerOf(kind, edge).type);
            }
          }
        }
      }
    }
  }
  return tables;
}

inline constexpr FCCLeanTables FCCLeanTablesOfKind[FCCMarchingCases::Kinds] = { MakeFCCLeanTables(0),
                                                                                MakeFCCLeanTables(1) };

} // namespace itk
#endif

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{
namespace
{

using WordType = FCCSigns::WordType;
using Cases = FCCMarchingCases;

/** Bits of a row from site \a shift on, 0 or 1. */
HWY_INLINE WordType
Shifted(const WordType * row, SizeValueType shift, SizeValueType word)
{
  return row[word] >> shift | row[word + 1] << 1 << (FCCSigns::WordBits - 1 - shift);
}

/** Where the sites and edges of a column's steps of one kind are found. */
struct LeanColumn
{
  const WordType * signs[Cases::Sites];
  const WordType * owned[Cases::Edges][2]; ///< by either end of EdgeSites
  const WordType * split[Cases::Edges];    ///< the owner is split
  SizeValueType siteShift[Cases::Sites];
  SizeValueType edgeShift[Cases::Edges];
  std::uint8_t edgeType[Cases::Edges];
  bool siteIsUpper[Cases::Sites];
  SizeValueType siteRow[Cases::Sites];
  const WordType * wholes[Cases::Sites];
  const std::uint32_t * before[Cases::Sites]; ///< numbers of the first vertices of the words of wholes

  /** Kind is known to the compiler, so that no table is left. */
  template <unsigned int Kind>
  HWY_INLINE void
  Find(const FCCSigns & allSigns,
       SizeValueType j,
       SizeValueType k,
       const FCCClusterPlane & lower,
       const FCCClusterPlane & upper)
  {
    const auto parity = static_cast<SizeValueType>(allSigns.GetParity(j, k));
    const SizeValueType shiftOfPair[3] = { 0, Kind == 0 ? parity : 1 - parity, 1 };
#pragma GCC unroll 6
    for (unsigned int site = 0; site < Cases::Sites; ++site)
    {
      const Cases::Row row = Cases::RowOf(Kind, site);
      siteRow[site] = j + (row & 1);
      siteIsUpper[site] = (row & 2) != 0;
      siteShift[site] = shiftOfPair[site / 2];
      signs[site] = allSigns.GetRow(siteRow[site], k + (row >> 1));
      const FCCNumberedBits & numbers = (siteIsUpper[site] ? upper : lower).GetWholes();
      wholes[site] = numbers.GetRow(siteRow[site]);
      before[site] = numbers.GetBefore(siteRow[site]);
    }
#pragma GCC unroll 12
    for (unsigned int edge = 0; edge < Cases::Edges; ++edge)
    {
      const Cases::EdgeOwner & owner = FCCMarchingTables.owners[Kind][edge];
      const SizeValueType row = j + (owner.row & 1);
      const FCCClusterPlane & plane = (owner.row & 2) != 0 ? upper : lower;
      const unsigned int end = FCCLeanTablesOfKind[Kind].storingEnd[edge];
      owned[edge][end] = plane.GetOwners().GetFirst(row, owner.type);
      owned[edge][1 - end] = plane.GetOwners().GetSecond(row, owner.type);
      split[edge] = plane.GetSplitRow(row, owner.type);
      edgeType[edge] = owner.type;
      edgeShift[edge] = shiftOfPair[owner.pair];
    }
  }
};

/** The vertex of a site that is whole. */
HWY_INLINE std::uint32_t
VertexOfWhole(const LeanColumn & column, unsigned int site, SizeValueType step)
{
  const SizeValueType i = step + column.siteShift[site];
  const SizeValueType word = i / FCCSigns::WordBits;
  const WordType below = column.wholes[site][word] & ((WordType{ 1 } << (i % FCCSigns::WordBits)) - 1);
  return column.before[site][word] + static_cast<std::uint32_t>(__builtin_popcountll(below));
}

/** One word of a column's steps: signs and ownership, and which tetrahedra keep a triangle between clusters. */
struct LeanSteps
{
  WordType signs[Cases::Sites];
  WordType owned[Cases::Edges][2];
  WordType owners[Cases::Tetrahedra][4]; ///< the corner owns a crossing in the tetrahedron
  WordType spanned[Cases::Tetrahedra];   ///< three or four corners do

  /** Returns whether there are any crossings. */
  template <unsigned int Kind>
  HWY_INLINE bool
  Load(const LeanColumn & column, SizeValueType word)
  {
    constexpr const FCCLeanTables & tables = FCCLeanTablesOfKind[Kind]; // loops unroll, so that no table is left
    WordType any = 0;
    WordType all = ~WordType{ 0 };
#pragma GCC unroll 6
    for (unsigned int site = 0; site < Cases::Sites; ++site)
    {
      signs[site] = Shifted(column.signs[site], column.siteShift[site], word);
      any |= signs[site];
      all &= signs[site];
    }
    if (any == all)
    {
      return false;
    }
#pragma GCC unroll 12
    for (unsigned int edge = 0; edge < Cases::Edges; ++edge)
    {
#pragma GCC unroll 2
      for (unsigned int end = 0; end < 2; ++end)
      {
        owned[edge][end] = Shifted(column.owned[edge][end], column.edgeShift[edge], word);
      }
    }
#pragma GCC unroll 3
    for (unsigned int tetrahedron = 0; tetrahedron < Cases::Tetrahedra; ++tetrahedron)
    {
#pragma GCC unroll 4
      for (unsigned int corner = 0; corner < 4; ++corner)
      {
        const auto & edges = tables.cornerEdges[tetrahedron][corner];
        const auto & ends = tables.cornerEnds[tetrahedron][corner];
        owners[tetrahedron][corner] = owned[edges[0]][ends[0]] | owned[edges[1]][ends[1]] | owned[edges[2]][ends[2]];
      }
      const auto & w = owners[tetrahedron];
      spanned[tetrahedron] = (w[0] & w[1] & (w[2] | w[3])) | (w[2] & w[3] & (w[0] | w[1]));
    }
    return true;
  }

  unsigned int
  PatternOf(unsigned int tetrahedron, unsigned int bit) const
  {
    const auto & sites = Cases::TetrahedronSites[tetrahedron];
    unsigned int pattern = 0;
    for (unsigned int corner = 0; corner < 4; ++corner)
    {
      pattern |= static_cast<unsigned int>(signs[sites[corner]] >> bit & 1) << corner;
      pattern |= static_cast<unsigned int>(owners[tetrahedron][corner] >> bit & 1) << (4 + corner);
    }
    return pattern;
  }
};

/** Whether the rows of a column have any site inside. */
bool
HasInside(const FCCSigns & signs, SizeValueType j, SizeValueType k)
{
  WordType any = 0;
  for (SizeValueType row = 0; row < 4; ++row)
  {
    const WordType * const words = signs.GetRow(j + (row & 1), k + (row >> 1));
    for (SizeValueType word = 0; word < signs.GetNumberOfWords(); ++word)
    {
      any |= words[word];
    }
  }
  return any != 0;
}

template <unsigned int Kind>
SizeValueType
CountColumnUse(const LeanColumn & column, SizeValueType words, FCCTriangleUse & lowerUse, FCCTriangleUse & upperUse)
{
  constexpr const FCCLeanTables & tables = FCCLeanTablesOfKind[Kind];
  SizeValueType count = 0;
  std::uint64_t * uses[Cases::Sites];
  for (unsigned int site = 0; site < Cases::Sites; ++site)
  {
    auto & use = column.siteIsUpper[site] ? upperUse : lowerUse;
    uses[site] = use.counts.data() + column.siteRow[site] * use.stride + column.siteShift[site];
  }
  for (SizeValueType word = 0; word < words; ++word)
  {
    LeanSteps steps;
    if (!steps.Load<Kind>(column, word))
    {
      continue;
    }
    for (unsigned int tetrahedron = 0; tetrahedron < Cases::Tetrahedra; ++tetrahedron)
    {
      const auto & sites = Cases::TetrahedronSites[tetrahedron];
      for (WordType mask = steps.spanned[tetrahedron]; mask != 0; mask &= mask - 1)
      {
        const auto bit = static_cast<unsigned int>(__builtin_ctzll(mask));
        const SizeValueType i = word * FCCSigns::WordBits + bit;
        const auto & found = FCCClusterTables.cases[Kind][tetrahedron][steps.PatternOf(tetrahedron, bit)];
        for (unsigned int n = 0; n < found.triangles; ++n)
        {
          const auto & corners = found.corners[n];
          const unsigned int left = 6u - corners[0] - corners[1] - corners[2];
          for (const std::uint8_t corner : corners)
          {
            uses[sites[corner]][i] += tables.use[tetrahedron][left][corner];
          }
        }
        count += found.triangles;
      }
    }
  }
  return count;
}

SizeValueType
CountTriangleUse(const FCCSigns & signs,
                 SizeValueType k,
                 const FCCClusterPlane & lower,
                 const FCCClusterPlane & upper,
                 FCCTriangleUse & lowerUse,
                 FCCTriangleUse & upperUse)
{
  SizeValueType count = 0;
  for (SizeValueType j = 0; j + 1 < signs.GetHeight(); ++j)
  {
    if (HasInside(signs, j, k))
    {
      const SizeValueType words = signs.GetNumberOfWords();
      LeanColumn column;
      column.Find<0>(signs, j, k, lower, upper);
      count += CountColumnUse<0>(column, words, lowerUse, upperUse);
      column.Find<1>(signs, j, k, lower, upper);
      count += CountColumnUse<1>(column, words, lowerUse, upperUse);
    }
  }
  return count;
}

/** Writes the triangles of a tetrahedron with crossings of split sites. */
SizeValueType
FillMixedTetrahedron(const LeanColumn & column,
                     const FCCLeanTables & tables,
                     const LeanSteps & steps,
                     const WordType * split,
                     unsigned int tetrahedron,
                     unsigned int bit,
                     SizeValueType i,
                     const FCCClusterPlane & lower,
                     const FCCClusterPlane & upper,
                     bool reversed,
                     TriangleSurface::TriangleType * triangles)
{
  unsigned int inside = 0;
  for (unsigned int corner = 0; corner < 4; ++corner)
  {
    inside |= static_cast<unsigned int>(steps.signs[Cases::TetrahedronSites[tetrahedron][corner]] >> bit & 1) << corner;
  }
  const auto & polygon = tables.polygons[tetrahedron][inside];
  std::uint32_t vertices[4] = {};
  bool deciderIsInside = false;
  for (unsigned int n = 0; n < polygon.corners; ++n)
  {
    const std::uint8_t edge = polygon.edges[n];
    const unsigned int end = (steps.owned[edge][0] >> bit & 1) != 0 ? 0 : 1;
    const std::uint8_t owner = Cases::EdgeSites[edge][end];
    const FCCClusterPlane & plane = column.siteIsUpper[owner] ? upper : lower;
    const SizeValueType row = column.siteRow[owner];
    const SizeValueType site = i + column.siteShift[owner];
    const unsigned int direction =
      column.edgeType[edge] + (tables.storingEnd[edge] == end ? 0U : unsigned{ FCCClusterPlane::Types });
    vertices[n] =
      (split[edge] >> bit & 1) != 0 ? plane.GetVertex(row, site, direction) : VertexOfWhole(column, owner, i);
    if (n == polygon.decider)
    {
      deciderIsInside = (steps.signs[owner] >> bit & 1) != 0;
    }
  }
  // Quadrilaterals are cut from the decider to the opposite corner when its owner is inside, else the other way.
  const unsigned int start = polygon.corners == 4 ? (polygon.decider + (deciderIsInside ? 0 : 1)) % 2 : 0;
  SizeValueType count = 0;
  for (unsigned int n = 2; n < polygon.corners; ++n)
  {
    const std::uint32_t a = vertices[start];
    const std::uint32_t b = vertices[(start + n - 1) % polygon.corners];
    const std::uint32_t c = vertices[(start + n) % polygon.corners];
    if (a != b && b != c && c != a)
    {
      triangles[count++] = { a, reversed ? c : b, reversed ? b : c };
    }
  }
  return count;
}

template <unsigned int Kind>
SizeValueType
FillColumn(const LeanColumn & column,
           SizeValueType words,
           const FCCClusterPlane & lower,
           const FCCClusterPlane & upper,
           bool reversed,
           TriangleSurface::TriangleType * triangles)
{
  constexpr const FCCLeanTables & tables = FCCLeanTablesOfKind[Kind];
  const unsigned int second = reversed ? 2 : 1;
  const unsigned int third = reversed ? 1 : 2;
  SizeValueType count = 0;
  for (SizeValueType word = 0; word < words; ++word)
  {
    LeanSteps steps;
    if (!steps.Load<Kind>(column, word))
    {
      continue;
    }
    WordType split[Cases::Edges];
#pragma GCC unroll 12
    for (unsigned int edge = 0; edge < Cases::Edges; ++edge)
    {
      split[edge] = Shifted(column.split[edge], column.edgeShift[edge], word);
    }
    for (unsigned int tetrahedron = 0; tetrahedron < Cases::Tetrahedra; ++tetrahedron)
    {
      const auto & sites = Cases::TetrahedronSites[tetrahedron];
      WordType mixed = 0;
      for (const std::uint8_t edge : tables.edges[tetrahedron])
      {
        mixed |= split[edge];
      }
      for (WordType mask = steps.spanned[tetrahedron] | mixed; mask != 0; mask &= mask - 1)
      {
        const auto bit = static_cast<unsigned int>(__builtin_ctzll(mask));
        const SizeValueType i = word * FCCSigns::WordBits + bit;
        TriangleSurface::TriangleType * const next = triangles + count;
        if ((mixed >> bit & 1) != 0)
        {
          count +=
            FillMixedTetrahedron(column, tables, steps, split, tetrahedron, bit, i, lower, upper, reversed, next);
          continue;
        }
        const auto & found = FCCClusterTables.cases[Kind][tetrahedron][steps.PatternOf(tetrahedron, bit)];
        std::uint32_t vertices[4];
        for (unsigned int corner = 0; corner < 4; ++corner)
        {
          vertices[corner] = VertexOfWhole(column, sites[corner], i);
        }
        for (unsigned int n = 0; n < found.triangles; ++n)
        {
          const auto & corners = found.corners[n];
          next[n] = { vertices[corners[0]], vertices[corners[second]], vertices[corners[third]] };
        }
        count += found.triangles;
      }
    }
  }
  return count;
}

SizeValueType
FillLeanTriangles(const FCCSigns & signs,
                  SizeValueType k,
                  const FCCClusterPlane & lower,
                  const FCCClusterPlane & upper,
                  bool reversed,
                  TriangleSurface::TriangleType * triangles)
{
  const TriangleSurface::TriangleType * const first = triangles;
  for (SizeValueType j = 0; j + 1 < signs.GetHeight(); ++j)
  {
    if (HasInside(signs, j, k))
    {
      const SizeValueType words = signs.GetNumberOfWords();
      LeanColumn column;
      column.Find<0>(signs, j, k, lower, upper);
      triangles += FillColumn<0>(column, words, lower, upper, reversed, triangles);
      column.Find<1>(signs, j, k, lower, upper);
      triangles += FillColumn<1>(column, words, lower, upper, reversed, triangles);
    }
  }
  return static_cast<SizeValueType>(triangles - first);
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace itk
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace itk
{
namespace
{
HWY_EXPORT(CountTriangleUse);
HWY_EXPORT(FillLeanTriangles);
} // namespace

SizeValueType
CountTriangleUse(const FCCSigns & signs,
                 SizeValueType k,
                 const FCCClusterPlane & lower,
                 const FCCClusterPlane & upper,
                 FCCTriangleUse & lowerUse,
                 FCCTriangleUse & upperUse)
{
  return HWY_DYNAMIC_DISPATCH(CountTriangleUse)(signs, k, lower, upper, lowerUse, upperUse);
}

SizeValueType
FillLeanTriangles(const FCCSigns & signs,
                  SizeValueType k,
                  const FCCClusterPlane & lower,
                  const FCCClusterPlane & upper,
                  bool reversed,
                  TriangleSurface::TriangleType * triangles)
{
  return HWY_DYNAMIC_DISPATCH(FillLeanTriangles)(signs, k, lower, upper, reversed, triangles);
}

} // namespace itk
#endif
