#include "itkFCCSplitSites.h"

#include <algorithm>
#include <cstring>

namespace itk
{
namespace
{

/** \class FCCStarReader
 * \brief Reads the stars of a row's sites: which sites are inside, and which crossings are nearer to the sites that
 * store their edges.
 */
class FCCStarReader
{
public:
  /** For the row (\a j, \a k). Planes of nearer ends are given below, at and above \a k. */
  FCCStarReader(const FCCSigns & signs,
                const std::array<const FCCNearerEnds *, 3> & nearerEnds,
                SizeValueType j,
                SizeValueType k)
    : m_Width(signs.GetWidth())
  {
    for (unsigned int site = 0; site < FCCSiteStar::Sites; ++site)
    {
      const FCCStepTarget target(signs, j, k, FCCSiteStar::StepTo(site));
      m_Inside[site] = target.isInBox
                         ? Bits{ signs.GetRow(target.j, target.k), static_cast<SizeValueType>(target.shift) }
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

  /** The surface in the star of a site. */
  FCCSiteStar::Pattern
  Read(SizeValueType i) const
  {
    FCCSiteStar::Pattern star{ 0, 0 };
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

private:
  /** A row of bits, and how far from a site's index its bit is. */
  struct Bits
  {
    const FCCSigns::WordType * row;
    SizeValueType shift;
  };

  /** Bits outside the box are 0. */
  bool
  Test(const Bits & bits, SizeValueType i) const
  {
    const SizeValueType place = i + bits.shift; // below 0 wraps around
    return place < m_Width && FCCBits::Test(bits.row, place);
  }

  SizeValueType m_Width;
  Bits m_Inside[FCCSiteStar::Sites];
  Bits m_Starts[FCCSiteStar::Edges];
};

/** \class FCCSiteDivision
 * \brief Divides one site's crossings into vertices, while the parts of other sites do not change.
 */
class FCCSiteDivision
{
public:
  FCCSiteDivision(const FCCSigns & signs,
                  const FCCSplitRows & split,
                  const FCCSiteStar::Pattern & star,
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

  const FCCSiteParts &
  GetParts() const
  {
    return m_Parts[Center];
  }

  /** Divides the site until none of its vertices breaks a condition of FCCSplitSites. Returns whether it was changed.
   */
  bool
  Divide()
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

  /** Calls use(place of a site) for sites that have a vertex with an edge of more than two triangles to a vertex of
   * one crossing of this site. When the site has been divided, its own larger vertices have no such edge. */
  template <typename TUse>
  void
  ForEachBrokenNeighbor(const TUse & use) const
  {
    const unsigned int single = this->GetVertices() & ~this->GetGatheredVertices();
    if (single != 0)
    {
      this->CountTriangles(single, [&](unsigned int, VertexType end) { use(m_Places[end / VerticesOfSite]); });
    }
  }

  /** The most triangles that the tetrahedra with crossings of the site can have: between the plane below and its own,
   * and between its own and the plane above. These are the triangles before clustering. */
  std::array<SizeValueType, 2>
  GetMostTriangles() const
  {
    std::array<SizeValueType, 2> most{};
    for (unsigned int p = 0; p < m_NumberOfPolygons; ++p)
    {
      most[m_Polygons[p].isBelow ? 0 : 1] += m_Polygons[p].size - 2;
    }
    return most;
  }

private:
  static constexpr unsigned int Center = FCCSiteStar::Center;

  /** A vertex of the star: its site, and its number in the site's parts, or Whole. */
  using VertexType = std::uint8_t;
  static constexpr unsigned int VerticesOfSite = 16;
  static constexpr unsigned int Whole = 15;
  static_assert(FCCCells::Directions <= Whole && FCCSiteStar::Sites * VerticesOfSite <= 256,
                "a vertex has a number of 8 bits");

  static constexpr VertexType
  VertexOf(unsigned int site, unsigned int vertex)
  {
    return static_cast<VertexType>(site * VerticesOfSite + vertex);
  }

  static bool
  IsSingle(unsigned int directions)
  {
    return (directions & (directions - 1)) == 0;
  }

  bool
  IsSplit(unsigned int site) const
  {
    return (m_Split >> site & 1) != 0;
  }

  /** A polygon of the surface with crossings of the site, from the corner where it is cut into triangles on. */
  struct Polygon
  {
    bool isBelow;
    std::uint8_t size;
    VertexType corners[4]; ///< vertices of the site itself are given by directions, whatever its parts
  };

  /** Finds the site's crossings, and the polygons with any of them. */
  void
  FindPolygons(const FCCSiteStar::Pattern & star)
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

  /** Which of some vertices, as bits, have fewer than three triangles, or an edge with more than two. */
  unsigned int
  FindBrokenVertices(unsigned int wanted) const
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

  /** Splits a whole site into its connected parts, and parts that are no disks into single crossings. */
  void
  StartDividing()
  {
    unsigned int single = 0;
    FCCSiteParts(m_Crossings, 0).ForEachVertex([&single](unsigned int part) {
      single |= FCCCells::IsDisk(part) ? 0 : part;
    });
    m_Split |= 1U << Center;
    this->SetParts(FCCSiteParts(m_Crossings, single));
  }

  void
  SetParts(const FCCSiteParts & parts)
  {
    m_Parts[Center] = parts;
    for (unsigned int direction = 0; direction < FCCCells::Directions; ++direction)
    {
      m_Centers[direction] = VertexOf(Center, parts.GetVertex(direction));
    }
    m_NumberOfVertices = std::max(1u, parts.GetNumberOfVertices());
  }

  /** The crossings of the site's parts that break a condition. */
  unsigned int
  FindBroken() const
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

  /** The crossings of a part without which the part may break no condition: the crossings that take part in all edges
   * of the part with more than two triangles. */
  unsigned int
  FindHelpful(unsigned int part) const
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
  DividePart(unsigned int part)
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

  /** The vertex of a polygon's corner, with the parts that the site has now. */
  VertexType
  VertexAt(VertexType corner) const
  {
    return corner < VertexOf(Center, 0) ? corner : m_Centers[corner % VerticesOfSite];
  }

  /** Calls use(three corners, their vertices) for the triangles of the polygons: all that have vertices of the site. */
  template <typename TUse>
  void
  ForEachTriangle(const TUse & use) const
  {
    for (unsigned int p = 0; p < m_NumberOfPolygons; ++p)
    {
      const Polygon & polygon = m_Polygons[p];
      VertexType corners[3] = { polygon.corners[0], 0, polygon.corners[1] };
      VertexType vertices[3] = { this->VertexAt(corners[0]), 0, this->VertexAt(corners[2]) };
      for (unsigned int n = 2; n < polygon.size; ++n)
      {
        corners[1] = corners[2];
        vertices[1] = vertices[2];
        corners[2] = polygon.corners[n];
        vertices[2] = this->VertexAt(corners[2]);
        if (vertices[0] != vertices[1] && vertices[1] != vertices[2] && vertices[2] != vertices[0])
        {
          use(corners, vertices);
        }
      }
    }
  }

  /** The numbers of the site's vertices, as bits. */
  unsigned int
  GetVertices() const
  {
    return (1U << m_NumberOfVertices) - 1;
  }

  /** The numbers of the site's vertices that gather crossings, as bits. */
  unsigned int
  GetGatheredVertices() const
  {
    unsigned int gathered = 0;
    for (unsigned int directions = m_Crossings & ~m_Parts[Center].GetSingle(); directions != 0;
         directions &= directions - 1)
    {
      gathered |= 1U << m_Parts[Center].GetVertex(static_cast<unsigned int>(__builtin_ctz(directions)));
    }
    return gathered;
  }

  /** Counts the triangles of some vertices of the site, and calls use(number of a vertex, other end) for their edges
   * with more than two. */
  template <typename TUse>
  std::array<std::uint8_t, VerticesOfSite>
  CountTriangles(unsigned int wanted, const TUse & use) const
  {
    std::array<std::uint8_t, VerticesOfSite> triangles{};
    std::uint8_t uses[VerticesOfSite][256];
    std::memset(uses, 0, m_NumberOfVertices * sizeof uses[0]);
    this->ForEachTriangle([&](const VertexType(&)[3], const VertexType(&vertices)[3]) {
      for (unsigned int n = 0; n < 3; ++n)
      {
        const unsigned int vertex = vertices[n] % VerticesOfSite;
        if (vertices[n] < VertexOf(Center, 0) || (wanted >> vertex & 1) == 0)
        {
          continue;
        }
        ++triangles[vertex];
        for (const VertexType end : { vertices[(n + 1) % 3], vertices[(n + 2) % 3] })
        {
          if (++uses[vertex][end] == 3)
          {
            use(vertex, end);
          }
        }
      }
    });
    return triangles;
  }

  std::array<SizeValueType, 3> m_Places[FCCSiteStar::Sites];
  unsigned int m_Split{ 0 };
  unsigned int m_Crossings{ 0 }; ///< directions of the crossings that the site is nearer to
  FCCSiteParts m_Parts[FCCSiteStar::Sites];
  unsigned int m_NumberOfVertices{ 1 };
  VertexType m_Centers[VerticesOfSite]; ///< the site's vertices, by direction; a whole site has vertex 0
  unsigned int m_NumberOfPolygons{ 0 };
  Polygon m_Polygons[FCCSiteStar::Tetrahedra];
};

} // namespace

FCCSplitSites::FCCSplitSites(const FCCSigns & signs, std::pmr::memory_resource * scratch)
  : m_Signs(signs)
  , m_Scratch(scratch)
  , m_Split(signs)
  , m_Planes(signs.GetDepth())
{}

void
FCCSplitSites::Suspect(SizeValueType k, const std::vector<std::uint32_t> & numbers, const NearerEndsAround & nearerEnds)
{
  const auto width = static_cast<std::uint32_t>(m_Signs.GetWidth());
  for (auto number = numbers.begin(); number != numbers.end();)
  {
    const std::uint32_t j = *number / width;
    const FCCStarReader stars(m_Signs, nearerEnds, j, k);
    for (; number != numbers.end() && *number < (j + 1) * width; ++number)
    {
      const std::uint32_t i = *number - j * width;
      m_Planes[k].suspects[(i & 1) | (j & 1) << 1].push_back({ *number, stars.Read(i) });
    }
  }
}

bool
FCCSplitSites::HasSuspects() const
{
  return std::any_of(m_Planes.begin(), m_Planes.end(), [](const Plane & plane) {
    return std::any_of(
      plane.suspects.begin(), plane.suspects.end(), [](const auto & suspects) { return !suspects.empty(); });
  });
}

void
FCCSplitSites::SuspectBroken(SizeValueType begin,
                             SizeValueType end,
                             const std::vector<FCCNearerEnds::Packed> & nearerEnds,
                             const FCCSurfaceExtractor::Workers & workers)
{
  std::array<FCCNearerEnds, 3> planes{ FCCNearerEnds(m_Signs, m_Scratch),
                                       FCCNearerEnds(m_Signs, m_Scratch),
                                       FCCNearerEnds(m_Signs, m_Scratch) };
  SizeValueType unpacked = 0; // planes below this one
  for (SizeValueType k = begin; k < end; ++k)
  {
    std::vector<std::uint32_t> numbers;
    numbers.swap(m_Planes[k].broken);
    if (numbers.empty())
    {
      continue;
    }
    workers.checkAbort();
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    for (unpacked = std::max(unpacked, k - std::min<SizeValueType>(k, 1));
         unpacked < std::min(k + 2, m_Signs.GetDepth());
         ++unpacked)
    {
      planes[unpacked % 3].Unpack(unpacked, nearerEnds[unpacked]);
    }
    this->Suspect(k, numbers, { &planes[(k + 2) % 3], &planes[k % 3], &planes[(k + 1) % 3] });
  }
}

void
FCCSplitSites::DivideSuspects(SizeValueType k, unsigned int color, const FCCSurfaceExtractor::Workers & workers)
{
  const auto width = static_cast<std::uint32_t>(m_Signs.GetWidth());
  std::vector<SuspectedSite> sites;
  sites.swap(m_Planes[k].suspects[color]);
  std::vector<std::array<SizeValueType, 3>> broken;
  for (std::size_t n = 0; n < sites.size(); ++n)
  {
    if (n % 64 == 0)
    {
      workers.checkAbort();
    }
    FCCSiteDivision division(m_Signs, m_Split, sites[n].star, { sites[n].number % width, sites[n].number / width, k });
    if (division.Divide())
    {
      m_Planes[k].divided.push_back({ sites[n].number, division.GetParts(), division.GetMostTriangles() });
      division.ForEachBrokenNeighbor([&](const auto & neighbor) { broken.push_back(neighbor); });
    }
  }
  const std::lock_guard<std::mutex> lock(m_Mutex);
  for (const auto [i, j, plane] : broken)
  {
    m_Planes[plane].broken.push_back(static_cast<std::uint32_t>(j * width + i));
  }
}

void
FCCSplitSites::SetDivided(SizeValueType k, std::vector<SizeValueType> & triangles)
{
  const SizeValueType width = m_Signs.GetWidth();
  std::vector<DividedSite> divided;
  divided.swap(m_Planes[k].divided);
  for (const auto & [number, parts, mostTriangles] : divided)
  {
    const bool isNew = m_Split.Set(number % width, number / width, k, parts);
    if (isNew)
    {
      triangles[k] += mostTriangles[1];
      if (k > 0)
      {
        triangles[k - 1] += mostTriangles[0];
      }
    }
  }
}

void
FCCSplitSites::Resolve(const std::vector<FCCNearerEnds::Packed> & nearerEnds,
                       const FCCSurfaceExtractor::Workers & workers,
                       std::vector<SizeValueType> & points,
                       std::vector<SizeValueType> & triangles)
{
  const SizeValueType depth = m_Signs.GetDepth();
  const SizeValueType slabs = (depth + PlanesOfSlab - 1) / PlanesOfSlab;
  for (float share = 0.75f; this->HasSuspects(); share *= 0.25f) // most are found in the first round
  {
    // Planes of one parity are no neighbours.
    for (const SizeValueType parity : { 0, 1 })
    {
      const SizeValueType count = (depth + 1 - parity) / 2;
      for (unsigned int color = 0; color < ColorsOfPlane; ++color)
      {
        workers.forEach(
          count, 0.11f * share, [&](SizeValueType n) { this->DivideSuspects(2 * n + parity, color, workers); });
        workers.forEach(count, 0.01f * share, [&](SizeValueType n) { this->SetDivided(2 * n + parity, triangles); });
      }
    }
    workers.forEach(slabs, 0.04f * share, [&](SizeValueType slab) {
      const SizeValueType begin = slab * PlanesOfSlab;
      this->SuspectBroken(begin, std::min(begin + PlanesOfSlab, depth), nearerEnds, workers);
    });
  }
  workers.forEach(depth, 0.0f, [&](SizeValueType k) {
    for (SizeValueType j = 0; j < m_Signs.GetHeight(); ++j)
    {
      for (const FCCSiteParts & parts : m_Split.GetParts(j, k))
      {
        points[k] += parts.GetNumberOfVertices() - 1;
      }
    }
  });
}

} // namespace itk
