#include "itkFCCSiteDivision.h"

#include <algorithm>

namespace itk
{

FCCStarReader::FCCStarReader(const FCCSigns & signs,
                             const std::array<const FCCNearerEnds *, 3> & nearerEnds,
                             SizeValueType j,
                             SizeValueType k)
  : m_Width(signs.GetWidth())
{
  for (unsigned int site = 0; site < FCCSiteStar::Sites; ++site)
  {
    const FCCStepTarget target(signs, j, k, FCCSiteStar::StepTo(site));
    m_Inside[site] = target.isInBox ? Bits{ signs.GetRow(target.j, target.k), static_cast<SizeValueType>(target.shift) }
                                    : Bits{ nullptr, m_Width };
  }
  for (unsigned int n = 0; n < FCCSiteStar::Edges; ++n)
  {
    const FCCSiteStar::Edge & edge = FCCStarOfSite.edges[n];
    const unsigned int start = edge.ends[0];
    const FCCStepTarget target(signs, j, k, FCCSiteStar::StepTo(start));
    const auto plane = static_cast<std::size_t>(FCCSiteStar::StepTo(start)[2] + 1);
    m_Starts[n] = target.isInBox ? Bits{ nearerEnds[plane]->GetStarts(target.j, edge.directions[0]),
                                         static_cast<SizeValueType>(target.shift) }
                                 : Bits{ nullptr, m_Width };
  }
}

auto
FCCStarReader::Read(SizeValueType i) const -> Star
{
  Star star{ 0, 0 };
  for (unsigned int site = 0; site < FCCSiteStar::Sites; ++site)
  {
    star.inside |= static_cast<std::uint16_t>(unsigned{ this->Test(m_Inside[site], i) } << site);
  }
  for (std::uint64_t cut = FCCStarOfSite.GetCutEdges(star.inside); cut != 0; cut &= cut - 1)
  {
    const auto n = static_cast<unsigned int>(__builtin_ctzll(cut));
    star.starts |= std::uint64_t{ this->Test(m_Starts[n], i) } << n;
  }
  return star;
}

FCCSiteDivision::FCCSiteDivision(const FCCSigns & signs,
                                 const FCCSplitRows & split,
                                 const FCCStarReader::Star & star,
                                 const std::array<SizeValueType, 3> & place)
{
  const SizeValueType size[3] = { signs.GetWidth(), signs.GetHeight(), signs.GetDepth() };
  const IndexValueType parity = signs.GetParity(place[1], place[2]);
  for (unsigned int site = 0; site < FCCSiteStar::Sites; ++site)
  {
    const auto offset = FCCLattice::OffsetOf(FCCSiteStar::StepTo(site), parity);
    auto & [i, j, k] = m_Places[site];
    i = place[0] + static_cast<SizeValueType>(offset[0]);
    j = place[1] + static_cast<SizeValueType>(offset[1]);
    k = place[2] + static_cast<SizeValueType>(offset[2]);
    const bool isInBox = i < size[0] && j < size[1] && k < size[2];
    if (isInBox && FCCBits::Test(split.GetRow(j, k), i))
    {
      m_Split |= 1U << site;
      m_Parts[site] = split.GetParts(i, j, k);
    }
  }
  this->FindPolygons(star);
  this->SetParts(m_Parts[Center]);
}

/** Finds the site's crossings, and the polygons with any of them. */
void
FCCSiteDivision::FindPolygons(const FCCStarReader::Star & star)
{
  const auto & edges = FCCStarOfSite.edges;
  std::uint8_t nearerSites[FCCSiteStar::Edges]; // by edge, if it is cut; so are the corners
  VertexType corners[FCCSiteStar::Edges];
  for (std::uint64_t cut = FCCStarOfSite.GetCutEdges(star.inside); cut != 0; cut &= cut - 1)
  {
    const auto n = static_cast<unsigned int>(__builtin_ctzll(cut));
    const unsigned int end = (star.starts >> n & 1) != 0 ? 0 : 1;
    const unsigned int site = edges[n].ends[end];
    const unsigned int direction = edges[n].directions[end];
    nearerSites[n] = static_cast<std::uint8_t>(site);
    corners[n] = VertexOf(site,
                          site == Center        ? direction
                          : this->IsSplit(site) ? m_Parts[site].GetVertex(direction)
                                                : Whole);
    m_Crossings |= site == Center ? 1U << direction : 0;
  }
  for (const FCCSiteStar::Tetrahedron & tetrahedron : FCCStarOfSite.tetrahedra)
  {
    if ((tetrahedron.far & m_Crossings) == 0)
    {
      continue;
    }
    unsigned int pattern = 0;
    for (unsigned int corner = 0; corner < 4; ++corner)
    {
      pattern |= (unsigned{ star.inside } >> tetrahedron.sites[corner] & 1) << corner;
    }
    const FCCTetrahedronPolygon & found = tetrahedron.polygons[pattern];
    const std::uint8_t(&crossed)[4] = tetrahedron.edges[pattern];
    const bool isDeciderNearerToInside = (star.inside >> nearerSites[crossed[found.decider]] & 1) != 0;
    unsigned int corner = found.FindFirstCorner(isDeciderNearerToInside);
    Polygon & polygon = m_Polygons[m_NumberOfPolygons++];
    polygon.isBelow = tetrahedron.isBelow;
    polygon.size = found.size;
    for (unsigned int n = 0; n < found.size; ++n)
    {
      polygon.corners[n] = corners[crossed[corner]];
      corner = corner + 1u < found.size ? corner + 1 : 0;
    }
  }
}

void
FCCSiteDivision::SetParts(const FCCSiteParts & parts)
{
  m_Parts[Center] = parts;
  for (unsigned int direction = 0; direction < FCCCells::Directions; ++direction)
  {
    m_Centers[direction] = VertexOf(Center, parts.GetVertex(direction));
  }
  m_NumberOfVertices = std::max(1u, parts.GetNumberOfVertices());
}

std::array<SizeValueType, 2>
FCCSiteDivision::GetMostTriangles() const
{
  std::array<SizeValueType, 2> most{};
  for (unsigned int p = 0; p < m_NumberOfPolygons; ++p)
  {
    most[m_Polygons[p].isBelow ? 0 : 1] += m_Polygons[p].size - 2;
  }
  return most;
}

bool
FCCSiteDivision::Divide()
{
  bool changed = false;
  unsigned int broken = 0;
  if (this->IsSplit(Center))
  {
    broken = this->FindBroken();
  }
  else if (FCCCells::IsDisk(m_Crossings))
  {
    broken = this->FindBrokenVertices(1) != 0 ? m_Crossings : 0;
    m_Split |= 1U << Center;
    this->SetParts(FCCSiteParts(m_Crossings, 0));
  }
  else if (m_Crossings != 0)
  {
    this->StartDividing();
    broken = this->FindBroken();
    changed = true;
  }
  for (; broken != 0; broken = this->FindBroken())
  {
    this->DividePart(FCCCells::PartOf(broken, static_cast<unsigned int>(__builtin_ctz(broken))));
    changed = true;
  }
  return changed;
}

/** Splits a whole site into its connected parts, and parts that are no disks into single crossings. */
void
FCCSiteDivision::StartDividing()
{
  unsigned int single = 0;
  FCCSiteParts(m_Crossings, 0).ForEachVertex([&single](unsigned int part) {
    single |= FCCCells::IsDisk(part) ? 0 : part;
  });
  m_Split |= 1U << Center;
  this->SetParts(FCCSiteParts(m_Crossings, single));
}

unsigned int
FCCSiteDivision::GetGatheredVertices() const
{
  unsigned int gathered = 0;
  for (unsigned int directions = m_Crossings & ~m_Parts[Center].GetSingle(); directions != 0;
       directions &= directions - 1)
  {
    gathered |= 1U << m_Parts[Center].GetVertex(static_cast<unsigned int>(__builtin_ctz(directions)));
  }
  return gathered;
}

/** Which of some vertices, as bits, have fewer than three triangles, or an edge with more than two. */
unsigned int
FCCSiteDivision::FindBrokenVertices(unsigned int wanted) const
{
  constexpr unsigned int fewest = 3;
  unsigned int broken = 0;
  const auto triangles =
    this->CountTriangles(wanted, [&broken](unsigned int vertex, VertexType) { broken |= 1U << vertex; });
  for (unsigned int vertex = 0; vertex < m_NumberOfVertices; ++vertex)
  {
    broken |= unsigned{ triangles[vertex] < fewest } << vertex;
  }
  return broken & wanted;
}

/** The crossings of the site's parts that break a condition. */
unsigned int
FCCSiteDivision::FindBroken() const
{
  const unsigned int gathered = this->GetGatheredVertices();
  const unsigned int broken = gathered == 0 ? 0 : this->FindBrokenVertices(gathered);
  unsigned int crossings = 0;
  for (unsigned int direction = 0; broken != 0 && direction < FCCCells::Directions; ++direction)
  {
    const bool isBroken = (m_Crossings >> direction & broken >> m_Parts[Center].GetVertex(direction) & 1) != 0;
    crossings |= unsigned{ isBroken } << direction;
  }
  return crossings;
}

/** The crossings of a part without which the part may break no condition: the crossings that take part in all edges of
 * the part with more than two triangles. */
unsigned int
FCCSiteDivision::FindHelpful(unsigned int part) const
{
  const VertexType vertex = m_Centers[__builtin_ctz(part)];
  VertexType ends[256];
  unsigned int count = 0;
  this->CountTriangles(1U << vertex % VerticesOfSite, [&](unsigned int, VertexType end) { ends[count++] = end; });
  unsigned int helpful = part;
  for (unsigned int n = 0; n < count; ++n)
  {
    unsigned int touching = 0;
    this->ForEachTriangle([&](const VertexType(&corners)[3], const VertexType(&vertices)[3]) {
      const bool hasEnd = vertices[0] == ends[n] || vertices[1] == ends[n] || vertices[2] == ends[n];
      for (unsigned int corner = 0; corner < 3; ++corner)
      {
        touching |= hasEnd && vertices[corner] == vertex ? 1U << (corners[corner] % VerticesOfSite) : 0;
      }
    });
    helpful &= touching;
  }
  return helpful;
}

/** Makes one crossing of a part single where that leaves a part that breaks no condition, else all of them. */
void
FCCSiteDivision::DividePart(unsigned int part)
{
  const unsigned int single = m_Parts[Center].GetSingle();
  for (unsigned int remaining = this->FindHelpful(part); remaining != 0; remaining &= remaining - 1)
  {
    const unsigned int crossing = remaining & ~(remaining - 1);
    const unsigned int rest = part & ~crossing;
    if (FCCCells::IsDisk(rest))
    {
      this->SetParts(FCCSiteParts(m_Crossings, single | crossing));
      if (IsSingle(rest) || this->FindBrokenVertices(1U << m_Centers[__builtin_ctz(rest)] % VerticesOfSite) == 0)
      {
        return;
      }
    }
  }
  this->SetParts(FCCSiteParts(m_Crossings, single | part));
}

} // namespace itk
