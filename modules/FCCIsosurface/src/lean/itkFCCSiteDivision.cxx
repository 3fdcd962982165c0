#include "itkFCCSiteDivision.h"

#include "itkFCCNearerEnds.h"

namespace itk
{

FCCNeighborhood::FCCNeighborhood(const FCCSigns & signs, SizeValueType number)
{
  const SizeValueType size[3] = { signs.GetWidth(), signs.GetHeight(), signs.GetDepth() };
  const SizeValueType index[3] = { number % size[0], number / size[0] % size[1], number / size[0] / size[1] };
  const IndexValueType parity = signs.GetParity(index[1], index[2]);
  for (unsigned int site = 0; site < FCCSiteStar::Sites; ++site)
  {
    const auto offset = FCCLattice::OffsetOf(FCCSiteStar::StepTo(site), parity);
    bool isInBox = true;
    bool isInImage = true;
    auto & place = places[site];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      place[axis] = index[axis] + static_cast<SizeValueType>(offset[axis]);
      isInBox = isInBox && place[axis] < size[axis];
      isInImage = isInImage && place[axis] - 1 < size[axis] - 2;
    }
    numbers[site] = (place[2] * size[1] + place[1]) * size[0] + place[0];
    inBox |= unsigned{ isInBox } << site;
    inImage |= unsigned{ isInImage } << site;
  }
}

FCCNearerEndsOfStar
FindNearerEndsOfStar(const FCCSigns & signs,
                     const FCCScalarField::ValueReader & readValues,
                     bool insideIsBelow,
                     SizeValueType site)
{
  const FCCNeighborhood sites(signs, site);
  const unsigned int inside = sites.GetBits(signs, sites.inImage);
  float values[FCCSiteStar::Sites] = {};
  readValues(sites.places, sites.inImage, values);
  const auto & edges = FCCSiteStar::Get().GetEdges();
  FCCNearerEndsOfStar nearerEnds = 0;
  for (std::uint64_t cut = FCCSiteStar::Get().GetCutEdges(inside); cut != 0; cut &= cut - 1)
  {
    const auto n = static_cast<unsigned int>(__builtin_ctzll(cut));
    const auto [a, b] = edges[n].ends;
    const unsigned int outside = (inside >> a & 1) != 0 ? b : a;
    const bool isOutsideInImage = (sites.inImage >> outside & 1) != 0;
    const bool nearerToInside = isOutsideInImage && IsNearerToInside(values[a] + values[b], insideIsBelow);
    nearerEnds |= FCCNearerEndsOfStar{ nearerToInside } << n;
  }
  return nearerEnds;
}

FCCSiteDivision::FCCSiteDivision(const FCCSigns & signs,
                                 const FCCSplitRows & split,
                                 FCCNearerEndsOfStar nearerEnds,
                                 SizeValueType number)
  : m_Neighborhood(signs, number)
  , m_Inside(m_Neighborhood.GetBits(signs, m_Neighborhood.inImage))
  , m_Split(m_Neighborhood.GetBits(split, m_Neighborhood.inBox))
{
  for (unsigned int sites = m_Split; sites != 0; sites &= sites - 1)
  {
    const auto site = static_cast<unsigned int>(__builtin_ctz(sites));
    const auto [i, j, k] = m_Neighborhood.places[site];
    m_Parts[site] = split.GetParts(i, j, k);
  }
  const auto & edges = FCCSiteStar::Get().GetEdges();
  for (std::uint64_t cut = FCCSiteStar::Get().GetCutEdges(m_Inside); cut != 0; cut &= cut - 1)
  {
    const auto n = static_cast<unsigned int>(__builtin_ctzll(cut));
    const auto [a, b] = edges[n].ends;
    const unsigned int site = this->IsInside(a) == ((nearerEnds >> n & 1) != 0) ? a : b;
    const unsigned int direction = edges[n].GetDirectionFrom(site);
    m_NearerSite[n] = static_cast<std::uint8_t>(site);
    m_Corners[n] = VertexOf(site,
                            site == Center        ? direction
                            : this->IsSplit(site) ? m_Parts[site].GetVertex(direction)
                                                  : Whole);
    m_Crossings |= site == Center ? 1U << direction : 0;
  }
  this->FindPolygons();
}

void
FCCSiteDivision::FindPolygons()
{
  for (const FCCSiteStar::Tetrahedron & tetrahedron : FCCSiteStar::Get().GetTetrahedra())
  {
    if ((tetrahedron.far & m_Crossings) == 0)
    {
      continue;
    }
    unsigned int pattern = 0;
    for (unsigned int corner = 0; corner < 4; ++corner)
    {
      pattern |= (m_Inside >> tetrahedron.sites[corner] & 1) << corner;
    }
    const FCCTetrahedronPolygon & found = tetrahedron.polygons[pattern];
    const std::uint8_t(&edges)[4] = tetrahedron.edges[pattern];
    unsigned int corner = found.FindFirstCorner(this->IsInside(m_NearerSite[edges[found.decider]]));
    Polygon & polygon = m_Polygons[m_NumberOfPolygons++];
    polygon.tetrahedron = &tetrahedron;
    polygon.size = found.size;
    for (unsigned int n = 0; n < found.size; ++n)
    {
      polygon.corners[n] = m_Corners[edges[corner]];
      corner = corner + 1u < found.size ? corner + 1 : 0;
    }
  }
}

std::array<SizeValueType, 2>
FCCSiteDivision::GetMostTriangles() const
{
  std::array<SizeValueType, 2> most{};
  for (unsigned int p = 0; p < m_NumberOfPolygons; ++p)
  {
    most[m_Polygons[p].tetrahedron->isBelow ? 0 : 1] += m_Polygons[p].size - 2;
  }
  return most;
}

bool
FCCSiteDivision::Divide()
{
  bool changed = false;
  if (!this->IsSplit(Center))
  {
    if (!this->StartDividing())
    {
      return false;
    }
    changed = true;
  }
  for (;;)
  {
    this->FindTriangles();
    const unsigned int broken = this->FindBroken();
    if (broken == 0)
    {
      return changed;
    }
    this->DividePart(FCCSiteStar::Get().PartOf(broken, static_cast<unsigned int>(__builtin_ctz(broken))));
    changed = true;
  }
}

/** Splits a whole site that breaks a condition into its connected parts, those that are no disks into single crossings.
 * Returns whether it breaks one. */
bool
FCCSiteDivision::StartDividing()
{
  const FCCSiteStar & star = FCCSiteStar::Get();
  if (m_Crossings == 0)
  {
    return false;
  }
  if (star.IsDisk(m_Crossings))
  {
    this->FindTriangles();
    if (!this->Breaks(VertexOf(Center, Whole)))
    {
      return false;
    }
  }
  m_Split |= 1U << Center;
  unsigned int single = 0;
  FCCSiteParts(m_Crossings, 0).ForEachVertex([&](unsigned int part) { single |= star.IsDisk(part) ? 0 : part; });
  m_Parts[Center] = FCCSiteParts(m_Crossings, single);
  return true;
}

/** The triangles of the polygons: all that have vertices of the site. */
void
FCCSiteDivision::FindTriangles()
{
  VertexType centers[VerticesOfSite]; // the site's vertices by direction, with the parts that it has now
  for (unsigned int direction = 0; direction < FCCSiteStar::Directions; ++direction)
  {
    centers[direction] = VertexOf(Center, this->IsSplit(Center) ? m_Parts[Center].GetVertex(direction) : Whole);
  }
  const auto currentVertex = [&centers](VertexType corner) {
    return corner < VertexOf(Center, 0) ? corner : centers[corner % VerticesOfSite];
  };
  m_NumberOfTriangles = 0;
  for (unsigned int p = 0; p < m_NumberOfPolygons; ++p)
  {
    const Polygon & polygon = m_Polygons[p];
    const VertexType first = currentVertex(polygon.corners[0]);
    VertexType last = currentVertex(polygon.corners[1]);
    for (unsigned int n = 2; n < polygon.size; ++n)
    {
      const VertexType next = currentVertex(polygon.corners[n]);
      if (first != last && last != next && next != first)
      {
        m_Triangles[m_NumberOfTriangles++] = { first, last, next };
      }
      last = next;
    }
  }
}

/** Whether a vertex has fewer than three triangles, or an edge with more than two. */
bool
FCCSiteDivision::Breaks(VertexType vertex) const
{
  constexpr unsigned int fewest = 3;
  bool hasBrokenEdge = false;
  return this->CountTriangles(vertex, [&](VertexType) { hasBrokenEdge = true; }) < fewest || hasBrokenEdge;
}

/** The crossings of the site's parts that break a condition, by the triangles found last. */
unsigned int
FCCSiteDivision::FindBroken() const
{
  unsigned int broken = 0;
  m_Parts[Center].ForEachVertex([this, &broken](unsigned int part) {
    const auto lowest = static_cast<unsigned int>(__builtin_ctz(part));
    const bool isBroken = !IsSingle(part) && this->Breaks(VertexOf(Center, m_Parts[Center].GetVertex(lowest)));
    broken |= isBroken ? part : 0;
  });
  return broken;
}

/** Makes one crossing of a part single where that leaves a part that breaks no condition, else all of them. */
void
FCCSiteDivision::DividePart(unsigned int part)
{
  const unsigned int single = m_Parts[Center].GetSingle();
  for (unsigned int remaining = part; remaining != 0; remaining &= remaining - 1)
  {
    const unsigned int crossing = remaining & ~(remaining - 1);
    if (FCCSiteStar::Get().IsDisk(part & ~crossing))
    {
      m_Parts[Center] = FCCSiteParts(m_Crossings, single | crossing);
      this->FindTriangles();
      if ((this->FindBroken() & part) == 0)
      {
        return;
      }
    }
  }
  m_Parts[Center] = FCCSiteParts(m_Crossings, single | part);
}

} // namespace itk
