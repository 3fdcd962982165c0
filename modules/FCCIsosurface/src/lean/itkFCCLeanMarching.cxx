#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkFCCLeanMarching.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkFCCLeanMarching.h"
#include "itkFCCMarchingCases.h"

#include <algorithm>

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

  /** The triangle of three corners of a tetrahedron. */
  struct Triangle
  {
    std::uint8_t corners[3] = {}; ///< counter-clockwise seen from outside when the corner left out is outside
    std::uint64_t use[3] = {};    ///< what it adds to FCCTriangleUse at these corners
  };

  std::uint8_t storingEnd[Cases::Edges] = {};             ///< which of EdgeSites stores the edge
  std::uint8_t cornerEdges[Cases::Tetrahedra][4][3] = {}; ///< edges at a corner of a tetrahedron
  std::uint8_t cornerEnds[Cases::Tetrahedra][4][3] = {};  ///< which of EdgeSites the corner is
  std::uint8_t edges[Cases::Tetrahedra][6] = {};
  Polygon polygons[Cases::Tetrahedra][16] = {};  ///< by the corners inside
  Triangle triangles[Cases::Tetrahedra][4] = {}; ///< by the corner left out
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
      FCCLeanTables::Triangle & triangle = tables.triangles[tetrahedron][left];
      for (unsigned int corner = 0, n = 0; corner < 4; ++corner)
      {
        if (corner != left)
        {
          triangle.corners[n++] = static_cast<std::uint8_t>(corner);
        }
      }
      const auto & found = triangle.corners;
      if (Cases::Orientation(kind, sites[found[0]], sites[found[1]], sites[found[2]], sites[left]) < 0)
      {
        const std::uint8_t second = triangle.corners[1];
        triangle.corners[1] = triangle.corners[2];
        triangle.corners[2] = second;
      }
      for (unsigned int n = 0; n < 3; ++n)
      {
        triangle.use[n] = std::uint64_t{ 1 } << 56;
        for (unsigned int m = 0; m < 3; ++m)
        {
          if (m != n)
          {
            const std::uint8_t edge = Cases::EdgeBetween(sites[found[n]], sites[found[m]]);
            const unsigned int end = Cases::EdgeSites[edge][0] == sites[found[n]] ? 0 : 1;
            triangle.use[n] +=
              tables.storingEnd[edge] == end ? std::uint64_t{ 1 } << (8 * Cases::OwnerOf(kind, edge).type) : 0;
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

namespace hn = hwy::HWY_NAMESPACE;
using WordType = FCCSigns::WordType;
using Cases = FCCMarchingCases;

/** The four rows of a column, by FCCMarchingCases::Row. */
struct LeanColumn
{
  struct Row
  {
    const WordType * signs;
    const WordType * first; ///< owners of crossings, type by type
    const WordType * second;
    const WordType * split;
    const WordType * wholes;
    const std::uint32_t * before; ///< numbers of the first vertices of the words of wholes
  };

  Row rows[4];
  SizeValueType stride; ///< from a type to the next

  LeanColumn(const FCCSigns & signs,
             SizeValueType j,
             SizeValueType k,
             const FCCClusterPlane & lower,
             const FCCClusterPlane & upper)
    : stride(lower.GetOwners().GetStride())
  {
    for (SizeValueType row = 0; row < 4; ++row)
    {
      const FCCClusterPlane & plane = (row & 2) != 0 ? upper : lower;
      const SizeValueType y = j + (row & 1);
      rows[row] = { signs.GetRow(y, k + (row >> 1)),   plane.GetOwners().GetFirst(y, 0),
                    plane.GetOwners().GetSecond(y, 0), plane.GetSplitRow(y, 0),
                    plane.GetWholes().GetRow(y),       plane.GetWholes().GetBefore(y) };
    }
  }
};

/** The steps of one kind. \tparam Shift 1 when the next pair's index is one more than this pair's, else 0. All loops
 * over its tables unroll, so that none is left. */
template <unsigned int Kind, unsigned int Shift>
struct LeanSteps
{
  static constexpr const FCCLeanTables & Tables = FCCLeanTablesOfKind[Kind];
  static constexpr unsigned int ShiftOfPair[3] = { 0, Shift, 1 };

  static constexpr unsigned int
  RowOf(unsigned int site)
  {
    return Cases::RowOf(Kind, site);
  }

  /** The place of a step's site in its row. */
  static constexpr SizeValueType
  PlaceOf(unsigned int site, SizeValueType i)
  {
    return i + ShiftOfPair[site / 2];
  }

  static constexpr Cases::EdgeOwner
  OwnerOf(unsigned int edge)
  {
    return FCCMarchingTables.owners[Kind][edge];
  }

  /** The row that says of an edge's crossing whether one of EdgeSites owns it. */
  static HWY_INLINE const WordType *
  OwnedRow(const LeanColumn & column, unsigned int edge, unsigned int end)
  {
    const LeanColumn::Row & row = column.rows[OwnerOf(edge).row];
    return (Tables.storingEnd[edge] == end ? row.first : row.second) + OwnerOf(edge).type * column.stride;
  }

  static HWY_INLINE const WordType *
  SplitRow(const LeanColumn & column, unsigned int edge)
  {
    return column.rows[OwnerOf(edge).row].split + OwnerOf(edge).type * column.stride;
  }

  /** A bit of a row that belongs to a pair. */
  static HWY_INLINE bool
  Test(const WordType * row, unsigned int pair, SizeValueType i)
  {
    const SizeValueType place = i + ShiftOfPair[pair];
    return (row[place / FCCSigns::WordBits] >> (place % FCCSigns::WordBits) & 1) != 0;
  }
  static HWY_INLINE bool
  IsInside(const LeanColumn & column, unsigned int site, SizeValueType i)
  {
    return Test(column.rows[RowOf(site)].signs, site / 2, i);
  }
  static HWY_INLINE bool
  IsOwnedBy(const LeanColumn & column, unsigned int edge, unsigned int end, SizeValueType i)
  {
    return Test(OwnedRow(column, edge, end), OwnerOf(edge).pair, i);
  }
  static HWY_INLINE bool
  IsSplit(const LeanColumn & column, unsigned int edge, SizeValueType i)
  {
    return Test(SplitRow(column, edge), OwnerOf(edge).pair, i);
  }

  /** The vertex of a site that is whole. */
  static HWY_INLINE std::uint32_t
  VertexOfWhole(const LeanColumn & column, unsigned int site, SizeValueType i)
  {
    const LeanColumn::Row & row = column.rows[RowOf(site)];
    const SizeValueType place = PlaceOf(site, i);
    const SizeValueType word = place / FCCSigns::WordBits;
    const WordType below = row.wholes[word] & ((WordType{ 1 } << (place % FCCSigns::WordBits)) - 1);
    return row.before[word] + static_cast<std::uint32_t>(__builtin_popcountll(below));
  }

  /** Words that are worked at together, whatever the width of vectors: the order of triangles depends on it. */
  static constexpr SizeValueType Together = 8;
  static_assert(Together <= FCCSigns::WordsBeyond, "whole groups of words are read");

  /** Some words of bits. */
  struct Group
  {
    alignas(64) WordType words[Together];
  };

  using Tag = hn::CappedTag<WordType, Together>;
  using Words = hn::Vec<Tag>;

  /** Calls use(tetrahedron, corner left out, number of a word, its bits, which may be none) for the triangles between
   * clusters, and with \a WithMixed, useMixed(tetrahedron, number of a word, its bits) for the tetrahedra with
   * crossings of split sites, which have no others. */
  template <bool WithMixed, typename TUse, typename TMixed>
  static HWY_INLINE void
  ForEachTriangle(const LeanColumn & column, SizeValueType numberOfWords, const TUse & use, const TMixed & useMixed)
  {
    Group triangles[Cases::Tetrahedra][4];
    Group mixed[Cases::Tetrahedra];
    for (SizeValueType word = 0; word < numberOfWords; word += Together)
    {
      if (!Find<WithMixed>(column, word, numberOfWords, triangles, mixed))
      {
        continue;
      }
      const SizeValueType end = std::min(numberOfWords - word, Together);
#pragma GCC unroll 3
      for (unsigned int tetrahedron = 0; tetrahedron < Cases::Tetrahedra; ++tetrahedron)
      {
#pragma GCC unroll 4
        for (unsigned int left = 0; left < 4; ++left)
        {
          for (SizeValueType n = 0; n < end; ++n)
          {
            use(tetrahedron, left, word + n, triangles[tetrahedron][left].words[n]);
          }
        }
        if (WithMixed)
        {
          for (SizeValueType n = 0; n < end; ++n)
          {
            useMixed(tetrahedron, word + n, mixed[tetrahedron].words[n]);
          }
        }
      }
    }
  }

private:
  /** Words of a row that belongs to a pair. */
  static HWY_INLINE Words
  Load(const WordType * row, unsigned int pair, SizeValueType word)
  {
    const Tag tag;
    const Words words = hn::LoadU(tag, row + word);
    return ShiftOfPair[pair] == 0 ? words
                                  : hn::Or(hn::ShiftRight<1>(words), hn::ShiftLeft<63>(hn::LoadU(tag, row + word + 1)));
  }

  /** Finds the triangles of a group of words, by tetrahedron and the corner left out. Returns whether there may be any.
   */
  template <bool WithMixed>
  static HWY_INLINE bool
  Find(const LeanColumn & column,
       SizeValueType first,
       SizeValueType end,
       Group (&triangles)[Cases::Tetrahedra][4],
       Group (&mixed)[Cases::Tetrahedra])
  {
    const Tag tag;
    bool isAny = false;
    for (SizeValueType place = 0; place < Together && first + place < end; place += hn::Lanes(tag))
    {
      const SizeValueType word = first + place;
      Words inside[Cases::Sites];
      Words any = hn::Zero(tag);
      Words all = hn::Not(hn::Zero(tag));
#pragma GCC unroll 6
      for (unsigned int site = 0; site < Cases::Sites; ++site)
      {
        inside[site] = Load(column.rows[RowOf(site)].signs, site / 2, word);
        any = hn::Or(any, inside[site]);
        all = hn::And(all, inside[site]);
      }
      const Words crossed = hn::AndNot(all, any);
      isAny = isAny || !hn::AllTrue(tag, hn::Eq(crossed, hn::Zero(tag)));
      if (!isAny && hn::Lanes(tag) == Together)
      {
        return false;
      }
      Words split[Cases::Edges];
      if (WithMixed)
      {
#pragma GCC unroll 12
        for (unsigned int edge = 0; edge < Cases::Edges; ++edge)
        {
          split[edge] = Load(SplitRow(column, edge), OwnerOf(edge).pair, word);
        }
      }
#pragma GCC unroll 3
      for (unsigned int tetrahedron = 0; tetrahedron < Cases::Tetrahedra; ++tetrahedron)
      {
        const auto & sites = Cases::TetrahedronSites[tetrahedron];
        Words owns[4];
#pragma GCC unroll 4
        for (unsigned int corner = 0; corner < 4; ++corner)
        {
          owns[corner] = hn::Zero(tag);
#pragma GCC unroll 3
          for (unsigned int n = 0; n < 3; ++n)
          {
            const unsigned int edge = Tables.cornerEdges[tetrahedron][corner][n];
            const WordType * const row = OwnedRow(column, edge, Tables.cornerEnds[tetrahedron][corner][n]);
            owns[corner] = hn::Or(owns[corner], Load(row, OwnerOf(edge).pair, word));
          }
        }
        Words clusters = crossed;
        if (WithMixed)
        {
          Words anySplit = hn::Zero(tag);
#pragma GCC unroll 6
          for (unsigned int n = 0; n < 6; ++n)
          {
            anySplit = hn::Or(anySplit, split[Tables.edges[tetrahedron][n]]);
          }
          hn::Store(hn::And(crossed, anySplit), tag, mixed[tetrahedron].words + place);
          clusters = hn::AndNot(anySplit, crossed);
        }
#pragma GCC unroll 4
        for (unsigned int left = 0; left < 4; ++left)
        {
          // The corner left out owns nothing, or all four own a crossing each: then it is one of those outside.
          const auto & corners = Tables.triangles[tetrahedron][left].corners;
          const Words spanned = hn::And(owns[corners[0]], hn::And(owns[corners[1]], owns[corners[2]]));
          const Words excluded = hn::And(owns[left], inside[sites[left]]);
          hn::Store(hn::AndNot(excluded, hn::And(spanned, clusters)), tag, triangles[tetrahedron][left].words + place);
        }
      }
    }
    return isAny;
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

/** Calls work(row, column, LeanSteps) for all steps between two planes. */
template <typename TWork>
HWY_INLINE void
ForEachColumn(const FCCSigns & signs,
              SizeValueType k,
              const FCCClusterPlane & lower,
              const FCCClusterPlane & upper,
              const TWork & work)
{
  for (SizeValueType j = 0; j + 1 < signs.GetHeight(); ++j)
  {
    if (!HasInside(signs, j, k))
    {
      continue;
    }
    const LeanColumn column(signs, j, k, lower, upper);
    if (signs.GetParity(j, k) == 0)
    {
      work(j, column, LeanSteps<0, 0>{});
      work(j, column, LeanSteps<1, 1>{});
    }
    else
    {
      work(j, column, LeanSteps<0, 1>{});
      work(j, column, LeanSteps<1, 0>{});
    }
  }
}

template <typename TSteps>
SizeValueType
CountColumnUse(const LeanColumn & column, SizeValueType words, std::uint64_t * const (&uses)[4])
{
  SizeValueType count = 0;
  TSteps::template ForEachTriangle<false>(
    column,
    words,
    [&](unsigned int tetrahedron, unsigned int left, SizeValueType word, WordType bits) HWY_ATTR
    __attribute__((always_inline)) {
      const FCCLeanTables::Triangle & triangle = TSteps::Tables.triangles[tetrahedron][left];
      count += static_cast<SizeValueType>(__builtin_popcountll(bits));
      for (; bits != 0; bits &= bits - 1)
      {
        const SizeValueType i = word * FCCSigns::WordBits + static_cast<SizeValueType>(__builtin_ctzll(bits));
#pragma GCC unroll 3
        for (unsigned int n = 0; n < 3; ++n)
        {
          const unsigned int site = Cases::TetrahedronSites[tetrahedron][triangle.corners[n]];
          uses[TSteps::RowOf(site)][TSteps::PlaceOf(site, i)] += triangle.use[n];
        }
      }
    },
    [](unsigned int, SizeValueType, WordType) {});
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
  ForEachColumn(signs, k, lower, upper, [&](SizeValueType j, const LeanColumn & column, auto steps) HWY_ATTR {
    std::uint64_t * const uses[4] = {
      lowerUse.GetRow(j), lowerUse.GetRow(j + 1), upperUse.GetRow(j), upperUse.GetRow(j + 1)
    };
    count += CountColumnUse<decltype(steps)>(column, signs.GetNumberOfWords(), uses);
  });
  return count;
}

/** Writes the triangles of a tetrahedron with crossings of split sites. */
template <typename TSteps>
SizeValueType
FillMixedTetrahedron(const LeanColumn & column,
                     unsigned int tetrahedron,
                     SizeValueType i,
                     SizeValueType j,
                     const FCCClusterPlane & lower,
                     const FCCClusterPlane & upper,
                     bool reversed,
                     TriangleSurface::TriangleType * triangles)
{
  unsigned int inside = 0;
  for (unsigned int corner = 0; corner < 4; ++corner)
  {
    const bool isInside = TSteps::IsInside(column, Cases::TetrahedronSites[tetrahedron][corner], i);
    inside |= static_cast<unsigned int>(isInside) << corner;
  }
  const auto & polygon = TSteps::Tables.polygons[tetrahedron][inside];
  std::uint32_t vertices[4] = {};
  bool deciderIsInside = false;
  for (unsigned int n = 0; n < polygon.corners; ++n)
  {
    const std::uint8_t edge = polygon.edges[n];
    const unsigned int end = TSteps::IsOwnedBy(column, edge, 0, i) ? 0 : 1;
    const std::uint8_t owner = Cases::EdgeSites[edge][end];
    if (TSteps::IsSplit(column, edge, i))
    {
      const unsigned int row = TSteps::RowOf(owner);
      const unsigned int direction =
        TSteps::OwnerOf(edge).type + (TSteps::Tables.storingEnd[edge] == end ? 0U : unsigned{ FCCClusterPlane::Types });
      vertices[n] = ((row & 2) != 0 ? upper : lower).GetVertex(j + (row & 1), TSteps::PlaceOf(owner, i), direction);
    }
    else
    {
      vertices[n] = TSteps::VertexOfWhole(column, owner, i);
    }
    if (n == polygon.decider)
    {
      deciderIsInside = TSteps::IsInside(column, owner, i);
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

SizeValueType
FillLeanTriangles(const FCCSigns & signs,
                  SizeValueType k,
                  const FCCClusterPlane & lower,
                  const FCCClusterPlane & upper,
                  bool reversed,
                  TriangleSurface::TriangleType * triangles)
{
  TriangleSurface::TriangleType * next = triangles;
  ForEachColumn(signs, k, lower, upper, [&](SizeValueType j, const LeanColumn & column, auto steps) HWY_ATTR {
    using Steps = decltype(steps);
    Steps::template ForEachTriangle<true>(
      column,
      signs.GetNumberOfWords(),
      [&](unsigned int tetrahedron, unsigned int left, SizeValueType word, WordType bits) HWY_ATTR
      __attribute__((always_inline)) {
        const auto & sites = Cases::TetrahedronSites[tetrahedron];
        const auto & corners = Steps::Tables.triangles[tetrahedron][left].corners;
        for (; bits != 0; bits &= bits - 1)
        {
          const SizeValueType i = word * FCCSigns::WordBits + static_cast<SizeValueType>(__builtin_ctzll(bits));
          const std::uint32_t a = Steps::VertexOfWhole(column, sites[corners[0]], i);
          const std::uint32_t b = Steps::VertexOfWhole(column, sites[corners[1]], i);
          const std::uint32_t c = Steps::VertexOfWhole(column, sites[corners[2]], i);
          const bool turned = Steps::IsInside(column, sites[left], i) != reversed;
          *next++ = { a, turned ? c : b, turned ? b : c };
        }
      },
      [&](unsigned int tetrahedron, SizeValueType word, WordType bits) HWY_ATTR {
        for (; bits != 0; bits &= bits - 1)
        {
          const SizeValueType i = word * FCCSigns::WordBits + static_cast<SizeValueType>(__builtin_ctzll(bits));
          next += FillMixedTetrahedron<Steps>(column, tetrahedron, i, j, lower, upper, reversed, next);
        }
      });
  });
  return static_cast<SizeValueType>(next - triangles);
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
