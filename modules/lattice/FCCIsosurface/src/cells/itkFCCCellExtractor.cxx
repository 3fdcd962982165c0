#include "itkFCCCellCases.h"
#include "itkFCCEdgeExtractor.h"
#include "itkFCCExtractors.h"

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
      use(FCCOctahedron{});
      use(FCCTetrahedronAfter{});
      use(FCCTetrahedronBefore{});
      break;
    case FCCCellScheme::Parallelepipeds:
      use(FCCParallelepiped{});
      break;
  }
}

/** The cells of one kind whose anchors are in one row. */
template <typename TKind>
class CellRow
{
public:
  /** \param nothing a row of sites outside, for sites beyond the box of a closed surface; nullptr if open */
  CellRow(const FCCSigns & signs, SizeValueType j, SizeValueType k, const WordType * nothing)
    : m_Words(signs.GetNumberOfWords())
    , m_End(signs.GetWidth())
  {
    for (unsigned int corner = 0; corner < TKind::Cell.numberOfCorners; ++corner)
    {
      const FCCStepTarget target(signs, j, k, TKind::Cell.corners[corner]);
      m_Shift[corner] = target.shift;
      m_Rows[corner] = target.isInBox ? signs.GetRow(target.j, target.k) : nothing;
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
      WordType corners[LatticeCell::MaximumCorners];
      WordType any = 0;
      WordType all = ~WordType{ 0 };
      for (unsigned int corner = 0; corner < TKind::Cell.numberOfCorners; ++corner)
      {
        corners[corner] = FCCBits::Shifted(m_Rows[corner], word, m_Shift[corner]);
        any |= corners[corner];
        all &= corners[corner];
      }
      const WordType exists = FCCBits::Below(m_End, word) & ~FCCBits::Below(m_Begin, word);
      FCCBits::ForEach(any & ~all & exists, 0, [&](SizeValueType bit) {
        unsigned int pattern = 0;
        for (unsigned int corner = 0; corner < TKind::Cell.numberOfCorners; ++corner)
        {
          pattern |= static_cast<unsigned int>(corners[corner] >> bit & 1) << corner;
        }
        use(word * FCCBits::WordBits + bit, TKind::Cases.cases[pattern]);
      });
    }
  }

private:
  SizeValueType m_Words;
  SizeValueType m_Begin{ 0 };
  SizeValueType m_End;
  bool m_Exists{ true };
  const WordType * m_Rows[LatticeCell::MaximumCorners];
  IndexValueType m_Shift[LatticeCell::MaximumCorners];
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
      const LatticeCell::Edge & found = TKind::Cell.edges[edge];
      const SiteType & step = TKind::Cell.corners[found.start];
      const FCCStepTarget start(signs, j, k, step);
      m_Shift[edge] = start.shift;
      if (start.isInBox) // edges that are stored elsewhere are not cut
      {
        const bool isBetween = FCCStoredEdges::GroupOf(found.type) == FCCStoredEdges::Group::Between;
        const FCCCutEdges & plane = isBetween ? *edges.between[step[2] + 1] : *edges.inPlane[step[2] + 1];
        m_Rows[edge] = plane.GetRow(start.j, found.type);
      }
    }
  }

  std::uint32_t
  GetId(unsigned int edge, SizeValueType i) const
  {
    return m_Rows[edge].GetNumber(static_cast<SizeValueType>(static_cast<IndexValueType>(i) + m_Shift[edge]));
  }

private:
  FCCCutEdges::Row m_Rows[LatticeCell::MaximumEdges];
  IndexValueType m_Shift[LatticeCell::MaximumEdges];
};

/** The types of the edges of a scheme's cells, as bits. */
std::uint8_t
EdgeTypesOf(FCCCellScheme scheme)
{
  unsigned int types = 0;
  ForEachKind(scheme, [&types](auto kind) { types |= decltype(kind)::Cell.GetEdgeTypes(); });
  return static_cast<std::uint8_t>(types);
}

/** A *layer* k is the cells whose anchors are in plane k. */
class FCCCellExtractor : public FCCEdgeExtractor
{
public:
  FCCCellExtractor(const FCCSigns & signs, const FCCScalarField & field, FCCCellScheme scheme)
    : FCCEdgeExtractor(signs, field, EdgeTypesOf(scheme), false, true)
    , m_Scheme(scheme)
  {}

protected:
  SizeValueType
  CountTriangles(SizeValueType k) const override
  {
    SizeValueType triangles = 0;
    this->ForEachRow(k, [&triangles](SizeValueType, const auto & cells, auto) {
      cells.ForEachCutCell([&triangles](SizeValueType, const auto & found) { triangles += found.triangles; });
    });
    return triangles;
  }

  /** Cut edges of planes beyond the box are not looked at. */
  void
  FillTriangles(SizeValueType k, const FCCLayerEdges & edges, TriangleSurface::TriangleType * triangles) const override
  {
    const bool reversed = m_Field.frame.IsLeftHanded();
    const unsigned int second = reversed ? 2 : 1;
    const unsigned int third = reversed ? 1 : 2;
    this->ForEachRow(k, [&](SizeValueType j, const auto & cells, auto kind) {
      const CellRowIds<decltype(kind)> ids(m_Signs, j, k, edges);
      cells.ForEachCutCell([&](SizeValueType i, const auto & found) {
        for (unsigned int n = 0; n < found.triangles; ++n)
        {
          const auto & corners = found.edges[n];
          *triangles++ = { ids.GetId(corners[0], i), ids.GetId(corners[second], i), ids.GetId(corners[third], i) };
        }
      });
    });
  }

private:
  /** Calls use(j, CellRow, kind) for the rows of layer \a k, kind by kind. */
  template <typename TUse>
  void
  ForEachRow(SizeValueType k, const TUse & use) const
  {
    const std::vector<WordType> nothing(m_Signs.GetNumberOfWords() + 1, 0); // a row of sites outside
    ForEachKind(m_Scheme, [&](auto kind) {
      for (SizeValueType j = 0; j < m_Signs.GetHeight(); ++j)
      {
        use(j, CellRow<decltype(kind)>(m_Signs, j, k, m_Field.closed ? nothing.data() : nullptr), kind);
      }
    });
  }

  FCCCellScheme m_Scheme;
};

} // namespace

std::unique_ptr<FCCSurfaceExtractor>
MakeFCCCellExtractor(const FCCSigns & signs, const FCCScalarField & field, FCCCellScheme scheme)
{
  return std::make_unique<FCCCellExtractor>(signs, field, scheme);
}

} // namespace itk
