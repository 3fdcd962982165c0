#include "itkFCCCellMarching.h"

#include "itkFCCOctahedraCases.h"
#include "itkFCCParallelepipedCases.h"

namespace itk
{
namespace
{

using WordType = FCCSigns::WordType;
using SiteType = FCCLattice::SiteType;

/** Calls \a use(kind) for each kind of cells of a scheme. */
template <typename TUse>
void
ForEachKind(FCCCellScheme scheme, const TUse & use)
{
  switch (scheme)
  {
    case FCCCellScheme::Octahedra:
      use(FCCOctahedraCases::Octahedron{});
      use(FCCOctahedraCases::TetrahedronAfter{});
      use(FCCOctahedraCases::TetrahedronBefore{});
      break;
    case FCCCellScheme::Parallelepipeds:
      use(FCCParallelepipedCases::Parallelepiped{});
      break;
  }
}

/** The bits i + shift of a row, for the bits i of one word. Rows have a spare word at their end. */
WordType
Shifted(const WordType * row, SizeValueType word, IndexValueType shift)
{
  constexpr SizeValueType top = FCCSigns::WordBits - 1;
  switch (shift)
  {
    case 0:
      return row[word];
    case 1:
      return row[word] >> 1 | row[word + 1] << top;
    default:
      return row[word] << 1 | (word > 0 ? row[word - 1] >> top : 0);
  }
}

/** The bits of one word that stand for sites from \a begin on and before \a end. */
WordType
Between(SizeValueType begin, SizeValueType end, SizeValueType word)
{
  const auto below = [word](SizeValueType count) -> WordType {
    const SizeValueType first = word * FCCSigns::WordBits;
    if (count <= first)
    {
      return 0;
    }
    return count - first >= FCCSigns::WordBits ? ~WordType{ 0 } : (WordType{ 1 } << (count - first)) - 1;
  };
  return below(end) & ~below(begin);
}

/** Where the site at a step from the anchors of a row is: its row, and how far its index is from the anchor's. */
struct StepTarget
{
  IndexValueType j;
  IndexValueType k;
  IndexValueType shift;

  StepTarget(const FCCSigns & signs, SizeValueType fromJ, SizeValueType fromK, const SiteType & step)
    : j(static_cast<IndexValueType>(fromJ) + step[1])
    , k(static_cast<IndexValueType>(fromK) + step[2])
    , shift(FCCLattice::OffsetOf(step, signs.GetParity(fromJ, fromK))[0])
  {}

  bool
  IsInBox(const FCCSigns & signs) const
  {
    return j >= 0 && j < static_cast<IndexValueType>(signs.GetHeight()) && k >= 0 &&
           k < static_cast<IndexValueType>(signs.GetDepth());
  }
};

/** The cells of one kind whose anchors are in one row. */
template <typename TKind>
class CellRow
{
public:
  /** \a nothing is a row of sites outside, for those beyond the box of a closed surface; nullptr when it is open. */
  CellRow(const FCCSigns & signs, SizeValueType j, SizeValueType k, const WordType * nothing)
    : m_Words(signs.GetNumberOfWords())
    , m_End(signs.GetWidth())
  {
    for (unsigned int corner = 0; corner < TKind::Cell.numberOfCorners; ++corner)
    {
      const StepTarget target(signs, j, k, TKind::Cell.corners[corner]);
      m_Shift[corner] = target.shift;
      m_Rows[corner] = target.IsInBox(signs)
                         ? signs.GetRow(static_cast<SizeValueType>(target.j), static_cast<SizeValueType>(target.k))
                         : nothing;
      m_Exists = m_Exists && m_Rows[corner] != nullptr;
      // Cells that stick out along x hold sites of the padding only.
      m_Begin = target.shift < 0 ? 1 : m_Begin;
      m_End = target.shift > 0 ? signs.GetWidth() - 1 : m_End;
    }
  }

  /** Calls \a use(index of the anchor, case) for each cell through which the surface passes. */
  template <typename TUse>
  void
  ForEachCutCell(const TUse & use) const
  {
    for (SizeValueType word = 0; m_Exists && word < m_Words; ++word)
    {
      WordType corners[FCCCell::MaximumCorners];
      WordType any = 0;
      WordType all = ~WordType{ 0 };
      for (unsigned int corner = 0; corner < TKind::Cell.numberOfCorners; ++corner)
      {
        corners[corner] = Shifted(m_Rows[corner], word, m_Shift[corner]);
        any |= corners[corner];
        all &= corners[corner];
      }
      for (WordType cut = any & ~all & Between(m_Begin, m_End, word); cut != 0; cut &= cut - 1)
      {
        const auto bit = static_cast<unsigned int>(__builtin_ctzll(cut));
        unsigned int pattern = 0;
        for (unsigned int corner = 0; corner < TKind::Cell.numberOfCorners; ++corner)
        {
          pattern |= static_cast<unsigned int>(corners[corner] >> bit & 1) << corner;
        }
        use(word * FCCSigns::WordBits + bit, TKind::Cases.cases[pattern]);
      }
    }
  }

private:
  SizeValueType m_Words;
  SizeValueType m_Begin{ 0 };
  SizeValueType m_End;
  bool m_Exists{ true };
  const WordType * m_Rows[FCCCell::MaximumCorners];
  IndexValueType m_Shift[FCCCell::MaximumCorners];
};

/** Finds the vertex ids of the cells of one kind whose anchors are in one row. */
template <typename TKind>
class CellRowIds
{
public:
  CellRowIds(const FCCSigns & signs, SizeValueType j, SizeValueType k, const FCCLayerEdges & edges)
  {
    for (unsigned int edge = 0; edge < TKind::Cell.numberOfEdges; ++edge)
    {
      const FCCCell::Edge & found = TKind::Cell.edges[edge];
      const SiteType & step = TKind::Cell.corners[found.owner];
      const StepTarget owner(signs, j, k, step);
      m_Shift[edge] = owner.shift;
      if (owner.IsInBox(signs)) // edges of other owners are not cut
      {
        const bool isBetween = FCCCutEdges::IsBetween(found.type);
        const FCCCutEdges & plane = isBetween ? *edges.between[step[2] + 1] : *edges.inPlane[step[2] + 1];
        m_Rows[edge] = plane.GetRow(static_cast<SizeValueType>(owner.j), found.type);
      }
    }
  }

  std::uint32_t
  GetId(unsigned int edge, SizeValueType i) const
  {
    return m_Rows[edge].GetId(static_cast<SizeValueType>(static_cast<IndexValueType>(i) + m_Shift[edge]));
  }

private:
  FCCCutEdges::Row m_Rows[FCCCell::MaximumEdges];
  IndexValueType m_Shift[FCCCell::MaximumEdges];
};

/** A row of sites outside. */
std::vector<WordType>
MakeEmptyRow(const FCCSigns & signs)
{
  return std::vector<WordType>(signs.GetNumberOfWords() + 1, 0);
}

} // namespace

std::uint8_t
GetEdgeTypes(FCCCellScheme scheme)
{
  unsigned int types = 0;
  ForEachKind(scheme, [&types](auto kind) { types |= decltype(kind)::Cell.GetEdgeTypes(); });
  return static_cast<std::uint8_t>(types);
}

SizeValueType
CountCellTriangles(const FCCSigns & signs, FCCCellScheme scheme, SizeValueType k, bool closed)
{
  const std::vector<WordType> nothing = MakeEmptyRow(signs);
  SizeValueType triangles = 0;
  ForEachKind(scheme, [&](auto kind) {
    for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
    {
      const CellRow<decltype(kind)> cells(signs, j, k, closed ? nothing.data() : nullptr);
      cells.ForEachCutCell([&triangles](SizeValueType, const auto & found) { triangles += found.triangles; });
    }
  });
  return triangles;
}

void
FillCellTriangles(const FCCSigns & signs,
                  FCCCellScheme scheme,
                  SizeValueType k,
                  const FCCLayerEdges & edges,
                  bool closed,
                  bool reversed,
                  TriangleSurface::TriangleType * triangles)
{
  const unsigned int second = reversed ? 2 : 1;
  const unsigned int third = reversed ? 1 : 2;
  const std::vector<WordType> nothing = MakeEmptyRow(signs);
  ForEachKind(scheme, [&](auto kind) {
    for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
    {
      const CellRow<decltype(kind)> cells(signs, j, k, closed ? nothing.data() : nullptr);
      const CellRowIds<decltype(kind)> ids(signs, j, k, edges);
      cells.ForEachCutCell([&](SizeValueType i, const auto & found) {
        for (unsigned int n = 0; n < found.triangles; ++n)
        {
          const auto & corners = found.edges[n];
          *triangles++ = { ids.GetId(corners[0], i), ids.GetId(corners[second], i), ids.GetId(corners[third], i) };
        }
      });
    }
  });
}

} // namespace itk
