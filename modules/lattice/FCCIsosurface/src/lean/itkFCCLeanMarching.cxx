#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkFCCLeanMarching.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkFCCLeanMarching.h"

#include <algorithm>
#include <type_traits>

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
    const WordType * starts; ///< rows of FCCNearerEnds, type by type, as the next two
    const WordType * ends;
    const WordType * splitCrossings;
    FCCNumberedBits::Row wholeSites;
    FCCClusterPlane::SplitRow splitSites;
  };

  Row rows[4];
  SizeValueType stride; ///< from a type to the next

  LeanColumn(const FCCLeanLayer & layer, SizeValueType j)
    : stride(layer.lower.GetNearerEnds().GetStride())
  {
    for (SizeValueType row = 0; row < 4; ++row)
    {
      const FCCClusterPlane & plane = (row & 2) != 0 ? layer.upper : layer.lower;
      const SizeValueType y = j + (row & 1);
      rows[row] = { layer.signs.GetRow(y, layer.k + (row >> 1)), plane.GetNearerEnds().GetStarts(y, 0),
                    plane.GetNearerEnds().GetEnds(y, 0),         plane.GetSplitCrossings(y, 0),
                    plane.GetWholeSites().GetNumberedRow(y),     plane.GetSplitRow(y) };
    }
  }
};

/** The steps of one kind. \tparam Shift 1 when the next pair's index is one more than this pair's, else 0. All loops
 * over its tables unroll, so that no loop remains. */
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

  /** The index of a step's site in its row. */
  static constexpr SizeValueType
  IndexOf(unsigned int site, SizeValueType i)
  {
    return i + ShiftOfPair[site / 2];
  }

  static constexpr Cases::StoredEdge
  StoredEdgeOf(unsigned int edge)
  {
    return FCCMarchingTables.storedEdges[Kind][edge];
  }

  /** The row of bits of one end of an edge, one of EdgeSites: is the crossing nearer to it? */
  static HWY_INLINE const WordType *
  NearerRow(const LeanColumn & column, unsigned int edge, unsigned int end)
  {
    const LeanColumn::Row & row = column.rows[StoredEdgeOf(edge).row];
    return (StoredEdgeOf(edge).start == end ? row.starts : row.ends) + StoredEdgeOf(edge).type * column.stride;
  }

  static HWY_INLINE const WordType *
  SplitRow(const LeanColumn & column, unsigned int edge)
  {
    return column.rows[StoredEdgeOf(edge).row].splitCrossings + StoredEdgeOf(edge).type * column.stride;
  }

  static HWY_INLINE bool
  IsInside(const LeanColumn & column, unsigned int site, SizeValueType i)
  {
    return FCCBits::Test(column.rows[RowOf(site)].signs, IndexOf(site, i));
  }
  static HWY_INLINE bool
  IsNearer(const LeanColumn & column, unsigned int edge, unsigned int end, SizeValueType i)
  {
    return FCCBits::Test(NearerRow(column, edge, end), i + ShiftOfPair[StoredEdgeOf(edge).pair]);
  }
  static HWY_INLINE bool
  IsSplit(const LeanColumn & column, unsigned int edge, SizeValueType i)
  {
    return FCCBits::Test(SplitRow(column, edge), i + ShiftOfPair[StoredEdgeOf(edge).pair]);
  }

  /** The vertex of a whole site. */
  static HWY_INLINE std::uint32_t
  VertexOf(const LeanColumn & column, unsigned int site, SizeValueType i)
  {
    return column.rows[RowOf(site)].wholeSites.GetNumber(IndexOf(site, i));
  }

  template <unsigned int Site>
  static HWY_INLINE std::uint32_t
  VertexOf(const LeanColumn & column, SizeValueType i)
  {
    constexpr unsigned int row = RowOf(Site);
    return column.rows[row].wholeSites.GetNumber(i + ShiftOfPair[Site / 2]);
  }

  /** The vertex of a crossing that is nearer to one of its edge's sites. */
  static HWY_INLINE std::uint32_t
  CrossingVertexOf(const LeanColumn & column, unsigned int edge, unsigned int site, SizeValueType i)
  {
    if (!IsSplit(column, edge, i))
    {
      return VertexOf(column, site, i);
    }
    const Cases::StoredEdge stored = StoredEdgeOf(edge);
    const bool isStart = stored.start == Cases::EndOf(edge, site);
    return column.rows[RowOf(site)].splitSites.GetVertex(IndexOf(site, i),
                                                         isStart ? stored.type : FCCCells::OppositeOf(stored.type));
  }

  /** Words that are worked at together, whatever the width of vectors: the order of triangles depends on it. */
  static constexpr SizeValueType Together = 8;
  static_assert(Together <= FCCBitRows::WordsBeyond, "whole groups of words are read");

  /** Some words of bits. */
  struct Group
  {
    alignas(64) WordType words[Together];
  };

  /** The triangles of a group of words. */
  struct Triangles
  {
    Group wholes[Cases::Tetrahedra][4]; ///< between whole sites, by the omitted corner
    Group mixed[Cases::Tetrahedra];     ///< tetrahedra with crossings of split sites, which have no others
  };

  using Tag = hn::CappedTag<WordType, Together>;
  using Words = hn::Vec<Tag>;

  /** Calls use(i) for the steps of a group, from word \a first on. */
  template <typename TUse>
  static HWY_INLINE void
  ForEachStep(const Group & group, SizeValueType first, SizeValueType numberOfWords, const TUse & use)
  {
    for (SizeValueType word = first; word < std::min(numberOfWords, first + Together); ++word)
    {
      FCCBits::ForEach(group.words[word - first], word * FCCBits::WordBits, use);
    }
  }

  /** Calls use(tetrahedron, omitted corner, steps, first word) for the triangles between whole sites of some steps,
   * and with \a WithMixed, useMixed(tetrahedron, steps, first word) for tetrahedra with crossings of split sites. The
   * tetrahedron and the corner are constants. */
  template <bool WithMixed, typename TUse, typename TMixed>
  static HWY_INLINE void
  ForEachTriangle(const LeanColumn & column, SizeValueType numberOfWords, const TUse & use, const TMixed & useMixed)
  {
    Triangles triangles;
    const auto useTetrahedron = [&](auto tetrahedron, SizeValueType word) HWY_ATTR {
      const auto & wholes = triangles.wholes[tetrahedron];
      use(tetrahedron, std::integral_constant<unsigned int, 0>{}, wholes[0], word);
      use(tetrahedron, std::integral_constant<unsigned int, 1>{}, wholes[1], word);
      use(tetrahedron, std::integral_constant<unsigned int, 2>{}, wholes[2], word);
      use(tetrahedron, std::integral_constant<unsigned int, 3>{}, wholes[3], word);
      if (WithMixed)
      {
        useMixed(tetrahedron, triangles.mixed[tetrahedron], word);
      }
    };
    for (SizeValueType word = 0; word < numberOfWords; word += Together)
    {
      if (FindInGroup<WithMixed>(column, word, numberOfWords, triangles))
      {
        useTetrahedron(std::integral_constant<unsigned int, 0>{}, word);
        useTetrahedron(std::integral_constant<unsigned int, 1>{}, word);
        useTetrahedron(std::integral_constant<unsigned int, 2>{}, word);
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

  /** Finds the triangles of a group of words. Returns whether there may be any. */
  template <bool WithMixed>
  static HWY_INLINE bool
  FindInGroup(const LeanColumn & column, SizeValueType first, SizeValueType numberOfWords, Triangles & triangles)
  {
    const Tag tag;
    bool isAny = false;
    for (SizeValueType place = 0; place < Together && first + place < numberOfWords; place += hn::Lanes(tag))
    {
      Words inside[Cases::Sites];
      Words any = hn::Zero(tag);
      Words all = hn::Not(hn::Zero(tag));
#pragma GCC unroll 6
      for (unsigned int site = 0; site < Cases::Sites; ++site)
      {
        inside[site] = Load(column.rows[RowOf(site)].signs, site / 2, first + place);
        any = hn::Or(any, inside[site]);
        all = hn::And(all, inside[site]);
      }
      const Words crossed = hn::AndNot(all, any);
      isAny = isAny || !hn::AllTrue(tag, hn::Eq(crossed, hn::Zero(tag)));
      if (!isAny && hn::Lanes(tag) == Together)
      {
        return false;
      }
      FindInVector<WithMixed>(column, first, place, crossed, inside, triangles);
    }
    return isAny;
  }

  /** Finds the triangles of a vector of words, given the steps that the surface crosses and the sites inside. */
  template <bool WithMixed>
  static HWY_INLINE void
  FindInVector(const LeanColumn & column,
               SizeValueType first,
               SizeValueType place,
               Words crossed,
               const Words (&inside)[Cases::Sites],
               Triangles & triangles)
  {
    const Tag tag;
    Words split[Cases::Edges];
    if (WithMixed)
    {
#pragma GCC unroll 12
      for (unsigned int edge = 0; edge < Cases::Edges; ++edge)
      {
        split[edge] = Load(SplitRow(column, edge), StoredEdgeOf(edge).pair, first + place);
      }
    }
#pragma GCC unroll 3
    for (unsigned int tetrahedron = 0; tetrahedron < Cases::Tetrahedra; ++tetrahedron)
    {
      const auto & sites = Cases::TetrahedronSites[tetrahedron];
      Words hasCrossing[4];
      Words anySplit = hn::Zero(tag);
#pragma GCC unroll 4
      for (unsigned int corner = 0; corner < 4; ++corner)
      {
        hasCrossing[corner] = hn::Zero(tag);
#pragma GCC unroll 4
        for (unsigned int other = 0; other < 4; ++other)
        {
          if (other != corner)
          {
            const unsigned int edge = Tables.edges[tetrahedron][corner][other];
            const WordType * const row = NearerRow(column, edge, Cases::EndOf(edge, sites[corner]));
            hasCrossing[corner] = hn::Or(hasCrossing[corner], Load(row, StoredEdgeOf(edge).pair, first + place));
            if (WithMixed && other < corner)
            {
              anySplit = hn::Or(anySplit, split[edge]);
            }
          }
        }
      }
      Words betweenWholes = crossed;
      if (WithMixed)
      {
        hn::Store(hn::And(crossed, anySplit), tag, triangles.mixed[tetrahedron].words + place);
        betweenWholes = hn::AndNot(anySplit, crossed);
      }
#pragma GCC unroll 4
      for (unsigned int omitted = 0; omitted < 4; ++omitted)
      {
        // The omitted corner has no crossing, or all four corners have a crossing and the omitted corner is outside.
        const auto & corners = Tables.triangles[tetrahedron][omitted].corners;
        const Words spanned =
          hn::And(hasCrossing[corners[0]], hn::And(hasCrossing[corners[1]], hasCrossing[corners[2]]));
        const Words excluded = hn::And(hasCrossing[omitted], inside[sites[omitted]]);
        hn::Store(hn::AndNot(excluded, hn::And(spanned, betweenWholes)),
                  tag,
                  triangles.wholes[tetrahedron][omitted].words + place);
      }
    }
  }
};

/** Whether the rows of a column have any site inside. */
bool
HasInside(const FCCLeanLayer & layer, SizeValueType j)
{
  const FCCSigns & signs = layer.signs;
  WordType any = 0;
  for (SizeValueType row = 0; row < 4; ++row)
  {
    const WordType * const words = signs.GetRow(j + (row & 1), layer.k + (row >> 1));
    for (SizeValueType word = 0; word < signs.GetNumberOfWords(); ++word)
    {
      any |= words[word];
    }
  }
  return any != 0;
}

/** Calls work(row, column, LeanSteps) for all steps of a layer. */
template <typename TWork>
HWY_INLINE void
ForEachColumn(const FCCLeanLayer & layer, const TWork & work)
{
  for (SizeValueType j = 0; j + 1 < layer.signs.GetHeight(); ++j)
  {
    if (!HasInside(layer, j))
    {
      continue;
    }
    const LeanColumn column(layer, j);
    if (layer.signs.GetParity(j, layer.k) == 0)
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
CountColumnUse(const LeanColumn & column, SizeValueType words, FCCTriangleUse::CountsType * const (&uses)[4])
{
  SizeValueType count = 0;
  TSteps::template ForEachTriangle<false>(
    column,
    words,
    [&](auto tetrahedron, auto omitted, const auto & steps, SizeValueType first) HWY_ATTR {
      constexpr FCCLeanTables::Triangle triangle =
        TSteps::Tables.triangles[decltype(tetrahedron)::value][decltype(omitted)::value];
      const auto usesOf = [&](unsigned int n) {
        const unsigned int site = Cases::TetrahedronSites[tetrahedron][triangle.corners[n]];
        return uses[TSteps::RowOf(site)] + TSteps::IndexOf(site, 0);
      };
      FCCTriangleUse::CountsType * const corners[3] = { usesOf(0), usesOf(1), usesOf(2) };
      TSteps::ForEachStep(steps, first, words, [&](SizeValueType i) HWY_ATTR {
        corners[0][i] += triangle.use[0];
        corners[1][i] += triangle.use[1];
        corners[2][i] += triangle.use[2];
        ++count;
      });
    },
    [](auto, const auto &, SizeValueType) {});
  return count;
}

SizeValueType
CountTriangleUse(const FCCLeanLayer & layer, FCCTriangleUse & lowerUse, FCCTriangleUse & upperUse)
{
  SizeValueType count = 0;
  ForEachColumn(layer, [&](SizeValueType j, const LeanColumn & column, auto steps) HWY_ATTR {
    FCCTriangleUse::CountsType * const uses[4] = {
      lowerUse.GetRow(j), lowerUse.GetRow(j + 1), upperUse.GetRow(j), upperUse.GetRow(j + 1)
    };
    count += CountColumnUse<decltype(steps)>(column, layer.signs.GetNumberOfWords(), uses);
  });
  return count;
}

/** Writes the triangles of a tetrahedron with crossings of split sites. */
template <typename TSteps, unsigned int Tetrahedron>
HWY_ATTR SizeValueType
FillMixedTetrahedron(const LeanColumn & column,
                     SizeValueType i,
                     bool reversed,
                     TriangleSurface::TriangleType * triangles)
{
  constexpr const auto & sites = Cases::TetrahedronSites[Tetrahedron];
  unsigned int inside = 0;
#pragma GCC unroll 4
  for (unsigned int corner = 0; corner < 4; ++corner)
  {
    inside |= unsigned{ TSteps::IsInside(column, sites[corner], i) } << corner;
  }
  std::uint32_t vertices[4][4]; // of the crossings, by the corners at the ends of their edges
  bool areNearerToInside[4][4];
#pragma GCC unroll 4
  for (unsigned int a = 0; a < 3; ++a)
  {
#pragma GCC unroll 4
    for (unsigned int b = a + 1; b < 4; ++b)
    {
      if (((inside >> a ^ inside >> b) & 1) != 0)
      {
        const unsigned int edge = TSteps::Tables.edges[Tetrahedron][a][b];
        const bool isNearerToA = TSteps::IsNearer(column, edge, Cases::EndOf(edge, sites[a]), i);
        vertices[a][b] = vertices[b][a] = isNearerToA ? TSteps::CrossingVertexOf(column, edge, sites[a], i)
                                                      : TSteps::CrossingVertexOf(column, edge, sites[b], i);
        areNearerToInside[a][b] = areNearerToInside[b][a] = isNearerToA == ((inside >> a & 1) != 0);
      }
    }
  }
  const FCCTetrahedronPolygon & polygon = TSteps::Tables.polygons[Tetrahedron][inside];
  const auto vertexOf = [&](unsigned int n)
                          HWY_ATTR { return vertices[polygon.crossings[n].inside][polygon.crossings[n].outside]; };
  const auto [decidingInside, decidingOutside] = polygon.crossings[polygon.decider];
  const unsigned int first = polygon.FindFirstCorner(areNearerToInside[decidingInside][decidingOutside]);
  SizeValueType count = 0;
  const std::uint32_t a = vertexOf(first);
  std::uint32_t b = vertexOf(first + 1); // the first corner is 0 or 1
  for (unsigned int n = 2; n < polygon.size; ++n)
  {
    const std::uint32_t c = vertexOf(first + n < polygon.size ? first + n : 0);
    if (a != b && b != c && c != a)
    {
      triangles[count++] = { a, reversed ? c : b, reversed ? b : c };
    }
    b = c;
  }
  return count;
}

SizeValueType
FillLeanTriangles(const FCCLeanLayer & layer, bool reversed, TriangleSurface::TriangleType * triangles)
{
  TriangleSurface::TriangleType * next = triangles;
  ForEachColumn(layer, [&](SizeValueType, const LeanColumn & column, auto steps) HWY_ATTR {
    using Steps = decltype(steps);
    Steps::template ForEachTriangle<true>(
      column,
      layer.signs.GetNumberOfWords(),
      [&](auto tetrahedron, auto omitted, const auto & group, SizeValueType first) HWY_ATTR {
        constexpr const auto & sites = Cases::TetrahedronSites[decltype(tetrahedron)::value];
        constexpr const auto & corners =
          Steps::Tables.triangles[decltype(tetrahedron)::value][decltype(omitted)::value].corners;
        Steps::ForEachStep(group, first, layer.signs.GetNumberOfWords(), [&](SizeValueType i) HWY_ATTR {
          const std::uint32_t a = Steps::template VertexOf<sites[corners[0]]>(column, i);
          const std::uint32_t b = Steps::template VertexOf<sites[corners[1]]>(column, i);
          const std::uint32_t c = Steps::template VertexOf<sites[corners[2]]>(column, i);
          const bool turned = Steps::IsInside(column, sites[omitted], i) != reversed;
          *next++ = { a, turned ? c : b, turned ? b : c };
        });
      },
      [&](auto tetrahedron, const auto & group, SizeValueType first) HWY_ATTR {
        Steps::ForEachStep(group, first, layer.signs.GetNumberOfWords(), [&](SizeValueType i) HWY_ATTR {
          next += FillMixedTetrahedron<Steps, decltype(tetrahedron)::value>(column, i, reversed, next);
        });
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
CountTriangleUse(const FCCLeanLayer & layer, FCCTriangleUse & lowerUse, FCCTriangleUse & upperUse)
{
  return HWY_DYNAMIC_DISPATCH(CountTriangleUse)(layer, lowerUse, upperUse);
}

SizeValueType
FillLeanTriangles(const FCCLeanLayer & layer, bool reversed, TriangleSurface::TriangleType * triangles)
{
  return HWY_DYNAMIC_DISPATCH(FillLeanTriangles)(layer, reversed, triangles);
}

} // namespace itk
#endif
