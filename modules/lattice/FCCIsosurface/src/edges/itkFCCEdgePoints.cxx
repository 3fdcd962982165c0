#include "itkFCCEdgePoints.h"

#include <algorithm>
#include <cstring>

namespace itk
{
namespace
{

/** The rows of values and gradients along the line of one type of edge, shifted so that element i belongs to the edge
 * that site i stores. */
struct EdgeRows
{
  bool isCubic;
  bool passesThroughMiddle;
  bool withGradients;
  SizeValueType shift;     ///< from a site to the other end of its edge
  const float * values[4]; ///< at the positions -1, 0, 1, 2 along the line; the outer values for cubics only
  FCCFieldPlanes::GradientRow gradients[2]; ///< at both ends
  const float * nearMiddle[4];              ///< around the middle of an edge along x, for cubics only
  const float * aroundEnds[2][4];           ///< further away, on either side of the middle

  EdgeRows(const FCCFieldPlanes & field,
           const FCCLattice::SiteType & step,
           SizeValueType j,
           SizeValueType k,
           bool cubic,
           bool hasGradients)
    : isCubic(cubic)
    , passesThroughMiddle(cubic && step[1] == 0 && step[2] == 0)
    , withGradients(hasGradients)
  {
    for (IndexValueType place = cubic ? -1 : 0; place <= (cubic ? 2 : 1); ++place)
    {
      values[place + 1] = field.GetValues(j, k, FCCStep::Multiply(place, step));
    }
    const auto toEnd = FCCLattice::OffsetOf(step, field.GetParity(j, k));
    shift = static_cast<SizeValueType>(toEnd[0]);
    if (withGradients)
    {
      gradients[0] = field.GetGradients(j, k);
      gradients[1] =
        field.GetGradients(j + static_cast<SizeValueType>(toEnd[1]), k + static_cast<SizeValueType>(toEnd[2]));
    }
    for (unsigned int n = 0; passesThroughMiddle && n < 4; ++n)
    {
      const IndexValueType sign = n < 2 ? 1 : -1;
      const IndexValueType other = n % 2 == 0 ? sign : -sign;
      nearMiddle[n] = field.GetValues(j, k, { step[0] / 2, n % 2 == 0 ? sign : 0, n % 2 == 0 ? 0 : sign });
      aroundEnds[0][n] = field.GetValues(j, k, { 0, sign, other });
      aroundEnds[1][n] = field.GetValues(j, k, { step[0], sign, other });
    }
  }

  void
  Gather(SizeValueType i, FCCEdgeBatch & batch) const
  {
    const SizeValueType n = batch.count;
    batch.value[1][n] = values[1][i];
    batch.value[2][n] = values[2][i];
    if (isCubic)
    {
      batch.value[0][n] = values[0][i];
      batch.value[3][n] = values[3][i];
    }
    if (passesThroughMiddle)
    {
      this->PassThroughMiddle(i, batch);
    }
    if (withGradients)
    {
      std::memcpy(batch.gradient[0][n], gradients[0].GetGradient(i), sizeof batch.gradient[0][n]);
      std::memcpy(batch.gradient[1][n], gradients[1].GetGradient(i + shift), sizeof batch.gradient[1][n]);
    }
  }

private:
  /** Moves the outer values of an edge along x, so that the cubic has the value of the field at the edge's middle. On
   * this line samples are further apart than around it: without them steps look like stairs. The middle is that of an
   * octahedron: its value follows, to third order, from the values at the 6 corners and the 8 sites above its faces. */
  void
  PassThroughMiddle(SizeValueType i, FCCEdgeBatch & batch) const
  {
    const SizeValueType n = batch.count;
    const auto mean = [i](const float * const(&rows)[4]) {
      return 0.25f * ((rows[0][i] + rows[1][i]) + (rows[2][i] + rows[3][i]));
    };
    const float ends = 0.5f * (batch.value[1][n] + batch.value[2][n]);
    const float outer = 0.5f * (batch.value[0][n] + batch.value[3][n]);
    const float middle = mean(nearMiddle) + 0.5f * (ends - 0.5f * (mean(aroundEnds[0]) + mean(aroundEnds[1])));
    const float move = (9.0f * ends - 8.0f * middle) - outer;
    batch.value[0][n] += move;
    batch.value[3][n] += move;
  }
};

} // namespace

FCCEdgePoints::FCCEdgePoints(const FCCScalarField & field, bool cubic, SizeValueType margin)
  : m_Extent(field.region)
  , m_Frame(field.frame)
  , m_Cubic(cubic)
  , m_MinimumFraction(field.minimumFraction)
  , m_Margin(margin)
{}

void
FCCEdgePoints::Place(const FCCSigns & signs,
                     const FCCCutEdges & edges,
                     SizeValueType k,
                     const FCCFieldPlanes & field,
                     TriangleSurface::PointType * points,
                     TriangleSurface::NormalType * normals) const
{
  const SizeValueType toField = 1 - m_Margin; // the field's sites are counted from a layer around the image always
  FCCEdgeBatch batch{};
  const auto flush = [&] {
    const SizeValueType count = batch.count;
    this->PlaceBatch(batch, points, normals);
    points += count;
    normals += normals != nullptr ? count : 0;
  };
  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    FCCStoredEdges::ForEachType(edges.GetTypes(), [&](std::uint8_t type) {
      const RowOfEdges row{ j + toField, k + toField, type, edges.GetRow(j, type).bits };
      this->GatherRow(signs, row, field, normals != nullptr, batch, flush);
    });
  }
  flush();
}

template <typename TFlush>
void
FCCEdgePoints::GatherRow(const FCCSigns & signs,
                         const RowOfEdges & edges,
                         const FCCFieldPlanes & field,
                         bool withGradients,
                         FCCEdgeBatch & batch,
                         const TFlush & flush) const
{
  const auto end = edges.cut + signs.GetNumberOfWords();
  if (std::all_of(edges.cut, end, [](FCCSigns::WordType word) { return word == 0; })) // as most rows of a type
  {
    return;
  }
  const SizeValueType toField = 1 - m_Margin;
  const SiteType & step = FCCLattice::OwnedEdges[edges.type];
  const auto offset = FCCLattice::OffsetOf(step, field.GetParity(edges.j, edges.k));
  const bool isRealRow = field.IsReal(1, edges.j) && field.IsReal(2, edges.k);
  const bool isOtherRealRow = field.IsReal(1, edges.j + static_cast<SizeValueType>(offset[1])) &&
                              field.IsReal(2, edges.k + static_cast<SizeValueType>(offset[2]));
  const SiteType firstSite = this->SiteOf(toField, edges.j, edges.k);
  const auto forEachEdge = [&](const auto & gather) {
    FCCBits::ForEach(edges.cut, signs.GetNumberOfWords(), [&](SizeValueType i) {
      const SiteType site{ firstSite[0] + 2 * static_cast<IndexValueType>(i), firstSite[1], firstSite[2] };
      gather(i + toField, site);
      AddEdge(site, step, batch);
      if (batch.count == FCCEdgeBatch::Capacity)
      {
        flush();
      }
    });
  };
  const auto isInRow = [width = m_Extent.GetRegion().GetSize(0)](SizeValueType i) { return i - 1 < width; };
  if (!isRealRow || !isOtherRealRow)
  {
    forEachEdge([&](SizeValueType start, const SiteType & site) {
      this->GatherBorder(site, step, !isRealRow || !isInRow(start), batch);
    });
    return;
  }
  const EdgeRows rows(field, step, edges.j, edges.k, m_Cubic, withGradients);
  forEachEdge([&](SizeValueType start, const SiteType & site) {
    if (isInRow(start) && isInRow(start + static_cast<SizeValueType>(offset[0])))
    {
      rows.Gather(start, batch);
    }
    else
    {
      this->GatherBorder(site, step, !isInRow(start), batch);
    }
  });
}

void
FCCEdgePoints::Gather(const std::array<SizeValueType, 3> & site,
                      const SiteType & step,
                      const FCCFieldPlanes & field,
                      bool withGradients,
                      FCCEdgeBatch & batch) const
{
  const auto [i, j, k] = site;
  const auto offset = FCCLattice::OffsetOf(step, field.GetParity(j, k));
  const auto isReal = [&field](SizeValueType x, SizeValueType y, SizeValueType z) {
    return field.IsReal(0, x) && field.IsReal(1, y) && field.IsReal(2, z);
  };
  const bool startIsReal = isReal(i, j, k);
  const bool endIsReal = isReal(i + static_cast<SizeValueType>(offset[0]),
                                j + static_cast<SizeValueType>(offset[1]),
                                k + static_cast<SizeValueType>(offset[2]));
  const SiteType lattice = this->SiteOf(i, j, k);
  if (startIsReal && endIsReal)
  {
    EdgeRows(field, step, j, k, m_Cubic, withGradients).Gather(i, batch);
  }
  else
  {
    this->GatherBorder(lattice, step, !startIsReal, batch);
  }
  AddEdge(lattice, step, batch);
}

void
FCCEdgePoints::AddEdge(const SiteType & site, const SiteType & step, FCCEdgeBatch & batch)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    batch.site[axis][batch.count] = static_cast<double>(site[axis]);
    batch.step[axis][batch.count] = static_cast<float>(step[axis]);
  }
  ++batch.count;
}

/** Values that put the point on the extent's face, and gradients that make its normal the face's. */
void
FCCEdgePoints::GatherBorder(const SiteType & site,
                            const SiteType & step,
                            bool startsOutside,
                            FCCEdgeBatch & batch) const
{
  const SiteType end = FCCStep::Add(site, step);
  const double fraction = startsOutside ? 1.0 - m_Extent.FractionToBorder(end, FCCStep::Multiply(-1, step))
                                        : m_Extent.FractionToBorder(site, step);
  for (unsigned int place = 0; place < 4; ++place)
  {
    batch.value[place][batch.count] = static_cast<float>(fraction + 1.0 - static_cast<double>(place));
  }
  const auto direction = m_Extent.DirectionTo(startsOutside ? site : end);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    batch.gradient[0][batch.count][axis] = static_cast<float>(m_Frame.outwardSign * direction[axis]);
    batch.gradient[1][batch.count][axis] = batch.gradient[0][batch.count][axis];
  }
}

} // namespace itk
