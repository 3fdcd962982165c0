#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkFCCTetrahedraExtractor.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkFCCEdgeExtractor.h"
#include "itkFCCExtractors.h"
#include "itkFCCMarchingCases.h"

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{
namespace
{

using WordType = FCCSigns::WordType;
using Cases = FCCMarchingCases;

/** The rows of a column, and the way from a pair to the next. */
struct Column
{
  const WordType * rows[4];
  IndexValueType shift[Cases::Kinds]; ///< 1 when the next pair's index is one more than this pair's

  Column(const FCCSigns & signs, SizeValueType j, SizeValueType k)
    : rows{ signs.GetRow(j, k), signs.GetRow(j + 1, k), signs.GetRow(j, k + 1), signs.GetRow(j + 1, k + 1) }
    , shift{ signs.GetParity(j, k), 1 - signs.GetParity(j, k) }
  {}
};

/** The steps of one kind in one word of a column: the sites' signs, and which of the steps exist. */
struct Steps
{
  WordType sites[Cases::Sites];
  WordType regular;  ///< the next pair exists
  WordType quarters; ///< the pair after the next exists, too

  HWY_INLINE
  Steps(const FCCSigns & signs, const Column & column, unsigned int kind, SizeValueType word)
    : regular(FCCBits::Below(signs.GetWidth() - static_cast<SizeValueType>(column.shift[kind]), word))
    , quarters(FCCBits::Below(signs.GetWidth() - 1, word))
  {
    for (unsigned int place = 0; place < 2; ++place)
    {
      const WordType * const row = column.rows[Cases::PairRows[kind][place]];
      const WordType * const next = column.rows[Cases::PairRows[1 - kind][place]];
      sites[place] = row[word];
      sites[2 + place] = FCCBits::Shifted(next, word, column.shift[kind]);
      sites[4 + place] = FCCBits::Shifted(row, word, 1);
    }
  }

  /** Bits of the steps through which the surface passes. */
  WordType
  Active() const
  {
    const WordType any = sites[0] | sites[1] | sites[2] | sites[3];
    const WordType all = sites[0] & sites[1] & sites[2] & sites[3];
    return ((any & ~all) & regular) | (((any | sites[4] | sites[5]) & ~(all & sites[4] & sites[5])) & quarters);
  }

  /** One triangle for each tetrahedron with an odd number of sites inside, two for each with two. */
  SizeValueType
  CountTriangles() const
  {
    SizeValueType triangles = 0;
    for (unsigned int tetrahedron = 0; tetrahedron < Cases::Tetrahedra; ++tetrahedron)
    {
      const auto & corners = Cases::TetrahedronSites[tetrahedron];
      const WordType a = sites[corners[0]];
      const WordType b = sites[corners[1]];
      const WordType c = sites[corners[2]];
      const WordType d = sites[corners[3]];
      const WordType exists = tetrahedron == 0 ? regular : quarters;
      const WordType odd = a ^ b ^ c ^ d;
      const WordType two = (a | b | c | d) & ~(a & b & c & d) & ~odd;
      triangles += FCCBits::Count(odd & exists) + 2 * FCCBits::Count(two & exists);
    }
    return triangles;
  }

  unsigned int
  PatternOf(SizeValueType bit) const
  {
    unsigned int pattern = 0;
    for (unsigned int site = 0; site < Cases::Sites; ++site)
    {
      pattern |= static_cast<unsigned int>(sites[site] >> bit & 1) << site;
    }
    return pattern;
  }
};

/** Finds the vertex ids of a column's steps. */
class ColumnIds
{
public:
  ColumnIds(const Column & column,
            SizeValueType j,
            const FCCCutEdges & lower,
            const FCCCutEdges & upper,
            const FCCCutEdges & between)
  {
#pragma GCC unroll 2
    for (unsigned int kind = 0; kind < Cases::Kinds; ++kind)
    {
      const SizeValueType shiftOfPair[3] = { 0, static_cast<SizeValueType>(column.shift[kind]), 1 };
#pragma GCC unroll 12
      for (unsigned int edge = 0; edge < Cases::Edges; ++edge)
      {
        const Cases::StoredEdge & stored = FCCMarchingTables.storedEdges[kind][edge];
        const bool isBetween = FCCStoredEdges::GroupOf(stored.type) == FCCStoredEdges::Group::Between;
        const FCCCutEdges & edges = isBetween ? between : (stored.row & 2) != 0 ? upper : lower;
        m_Rows[kind][edge] = edges.GetRow(j + (stored.row & 1), stored.type);
        m_Shift[kind][edge] = shiftOfPair[stored.pair];
      }
    }
  }

  std::uint32_t
  GetId(unsigned int kind, unsigned int edge, SizeValueType i) const
  {
    return m_Rows[kind][edge].GetNumber(i + m_Shift[kind][edge]);
  }

private:
  FCCCutEdges::Row m_Rows[Cases::Kinds][Cases::Edges];
  SizeValueType m_Shift[Cases::Kinds][Cases::Edges];
};

/** Number of triangles between the planes \a k and \a k + 1. */
SizeValueType
CountColumns(const FCCSigns & signs, SizeValueType k)
{
  SizeValueType triangles = 0;
  for (SizeValueType j = 0; j + 1 < signs.GetHeight(); ++j)
  {
    const Column column(signs, j, k);
    for (SizeValueType word = 0; word < signs.GetNumberOfWords(); ++word)
    {
#pragma GCC unroll 2
      for (unsigned int kind = 0; kind < Cases::Kinds; ++kind)
      {
        triangles += Steps(signs, column, kind, word).CountTriangles();
      }
    }
  }
  return triangles;
}

/** The triangles between the planes \a k and \a k + 1, from the cut edges of plane \a k within it, of plane \a k + 1
 * within it, and between the two. Writes as many as CountColumns() says; \a reversed turns them all over. */
void
FillColumns(const FCCSigns & signs,
            SizeValueType k,
            const FCCCutEdges & lower,
            const FCCCutEdges & upper,
            const FCCCutEdges & between,
            bool reversed,
            TriangleSurface::TriangleType * triangles)
{
  const unsigned int second = reversed ? 2 : 1;
  const unsigned int third = reversed ? 1 : 2;
  for (SizeValueType j = 0; j + 1 < signs.GetHeight(); ++j)
  {
    const Column column(signs, j, k);
    const ColumnIds ids(column, j, lower, upper, between);
    for (SizeValueType word = 0; word < signs.GetNumberOfWords(); ++word)
    {
#pragma GCC unroll 2
      for (unsigned int kind = 0; kind < Cases::Kinds; ++kind)
      {
        const Steps steps(signs, column, kind, word);
        for (WordType active = steps.Active(); active != 0; active &= active - 1)
        {
          const auto bit = static_cast<SizeValueType>(__builtin_ctzll(active));
          const SizeValueType i = word * FCCBits::WordBits + bit;
          const Cases::Case & found = FCCMarchingTables.cases[kind][steps.PatternOf(bit)];
          const bool hasQuarters = (steps.quarters >> bit & 1) != 0;
          const unsigned int count = hasQuarters ? found.triangles : found.regularTriangles;
          for (unsigned int n = 0; n < count; ++n)
          {
            const auto & edges = found.edges[n];
            *triangles++ = { ids.GetId(kind, edges[0], i),
                             ids.GetId(kind, edges[second], i),
                             ids.GetId(kind, edges[third], i) };
          }
        }
      }
    }
  }
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
HWY_EXPORT(CountColumns);
HWY_EXPORT(FillColumns);

class FCCTetrahedraExtractor : public FCCEdgeExtractor
{
public:
  FCCTetrahedraExtractor(const FCCSigns & signs, const FCCScalarField & field, bool cubic)
    : FCCEdgeExtractor(signs, field, FCCStoredEdges::AllTypes, cubic, false)
  {}

protected:
  SizeValueType
  CountTriangles(SizeValueType k) const override
  {
    return k + 1 < m_Signs.GetDepth() ? HWY_DYNAMIC_DISPATCH(CountColumns)(m_Signs, k) : 0;
  }

  void
  FillTriangles(SizeValueType k, const FCCLayerEdges & edges, TriangleSurface::TriangleType * triangles) const override
  {
    if (k + 1 < m_Signs.GetDepth())
    {
      HWY_DYNAMIC_DISPATCH(FillColumns)
      (m_Signs, k, *edges.inPlane[1], *edges.inPlane[2], *edges.between[1], m_Field.frame.IsLeftHanded(), triangles);
    }
  }
};

} // namespace

std::unique_ptr<FCCSurfaceExtractor>
MakeFCCTetrahedraExtractor(const FCCSigns & signs, const FCCScalarField & field, bool cubic)
{
  return std::make_unique<FCCTetrahedraExtractor>(signs, field, cubic);
}

} // namespace itk
#endif
