#include "itkFCCSplitSites.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

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
    std::iota(std::begin(m_Vertices), std::end(m_Vertices), VertexType{ 0 });
    this->FindTriangles(star);
    this->SetParts(m_Parts[Center]);
    m_TrianglesBefore = this->IsSplit(Center) ? this->CountOwnTriangles() : LayerCounts{};
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
      m_Split |= 1U << Center;
      this->SetParts(FCCSiteParts(m_Crossings, 0));
      broken = this->FindBroken();
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
  ForEachBrokenNeighbor(const TUse & use)
  {
    unsigned int single = this->GetVertices() & ~this->GetGatheredVertices();
    for (this->CountTriangles(); single != 0; single &= single - 1)
    {
      for (std::uint64_t ends = m_Uses[1 + __builtin_ctz(single)].many; ends != 0; ends &= ends - 1)
      {
        const auto end = static_cast<unsigned int>(__builtin_ctzll(ends));
        use(m_Places[end < FirstOfCenter ? m_Nearer[end] : Center]);
      }
    }
  }

  /** How many triangles division has added, which a vertex of all its crossings would leave without area. */
  FCCSplitSites::LayerCounts
  CountAddedTriangles() const
  {
    const LayerCounts now = this->CountOwnTriangles();
    return { now[0] - m_TrianglesBefore[0], now[1] - m_TrianglesBefore[1] };
  }

private:
  using LayerCounts = FCCSplitSites::LayerCounts;
  static constexpr unsigned int Center = FCCSiteStar::Center;

  /** A vertex of the star. That of another site is the first of the edges whose crossings it has; that of the center is
   * FirstOfCenter and its number in the center's parts. So sets of vertices are the bits of a word. */
  using VertexType = std::uint8_t;
  static constexpr unsigned int FirstOfCenter = FCCSiteStar::Edges;
  static_assert(std::max(FirstOfCenter + FCCCells::Directions, 2 * FCCSiteStar::Tetrahedra) <= 64, "bits of one word");

  static constexpr std::uint64_t
  BitOf(VertexType vertex)
  {
    return std::uint64_t{ 1 } << vertex;
  }

  /** Corners of one vertex leave no triangle. */
  static bool
  IsTriangle(VertexType a, VertexType b, VertexType c)
  {
    return (a != b) & (b != c) & (c != a);
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

  /** A triangle of the surface before clustering. Its corners are vertices of other sites, or FirstOfCenter and the
   * directions of crossings of the center. */
  using Triangle = std::array<std::uint8_t, 3>;

  /** The triangles of a vertex. */
  struct Use
  {
    unsigned int triangles = 0;
    std::uint64_t once = 0;  ///< the other ends of the edges that have a triangle
    std::uint64_t twice = 0; ///< of those that have two
    std::uint64_t many = 0;  ///< of those that have more

    /** Adds a triangle with two other ends if \a isThere, without a branch, as that can't be foretold. */
    void
    Add(std::uint64_t ends, bool isThere)
    {
      ends &= std::uint64_t{ 0 } - std::uint64_t{ isThere };
      triangles += isThere;
      many |= twice & ends;
      twice |= once & ends;
      once |= ends;
    }
  };

  /** Finds the site's crossings, and the triangles of the polygons with any of them. */
  void
  FindTriangles(const FCCSiteStar::Pattern & star)
  {
    const auto & edges = FCCStarOfSite.edges;
    std::uint8_t corners[FCCSiteStar::Edges];                    // by edge, if it is cut
    VertexType firsts[FCCSiteStar::Sites][FCCCells::Directions]; // by the vertices of sites
    std::memset(firsts, 0xFF, sizeof firsts);
    for (std::uint64_t cut = FCCStarOfSite.GetCutEdges(star.inside); cut != 0; cut &= cut - 1)
    {
      const auto n = static_cast<unsigned int>(__builtin_ctzll(cut));
      const unsigned int end = (star.starts >> n & 1) != 0 ? 0 : 1;
      const unsigned int site = edges[n].ends[end];
      const unsigned int direction = edges[n].directions[end];
      m_Nearer[n] = static_cast<std::uint8_t>(site);
      if (site == Center)
      {
        m_Crossings |= 1U << direction;
        corners[n] = static_cast<std::uint8_t>(FirstOfCenter + direction);
      }
      else
      {
        VertexType & first = firsts[site][this->IsSplit(site) ? m_Parts[site].GetVertex(direction) : 0];
        corners[n] = first = std::min(first, static_cast<VertexType>(n));
      }
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
      const bool isDeciderNearerToInside = (star.inside >> m_Nearer[crossed[found.decider]] & 1) != 0;
      unsigned int corner = found.FindFirstCorner(isDeciderNearerToInside);
      std::uint8_t polygon[4] = {};
      for (unsigned int n = 0; n < found.size; ++n)
      {
        polygon[n] = corners[crossed[corner]];
        corner = corner + 1u < found.size ? corner + 1 : 0;
      }
      m_Triangles[m_NumberOfTriangles] = { polygon[0], polygon[1], polygon[2] };
      m_Triangles[m_NumberOfTriangles + 1] = { polygon[0], polygon[2], polygon[3] }; // of quadrilaterals
      const unsigned int added = found.size - 2u;
      m_Above |= std::uint64_t{ tetrahedron.isBelow ? 0 : (1U << added) - 1 } << m_NumberOfTriangles;
      m_NumberOfTriangles += added;
    }
  }

  /** The triangles with two or three corners at the site. How many there are depends on no other site. */
  LayerCounts
  CountOwnTriangles() const
  {
    LayerCounts counts{};
    for (unsigned int n = 0; n < m_NumberOfTriangles; ++n)
    {
      const auto [a, b, c] = m_Triangles[n];
      const bool isOwn = (a >= FirstOfCenter) + (b >= FirstOfCenter) + (c >= FirstOfCenter) >= 2;
      counts[m_Above >> n & 1] += isOwn && IsTriangle(m_Vertices[a], m_Vertices[b], m_Vertices[c]) ? 1 : 0;
    }
    return counts;
  }

  /** Which of some vertices, as bits, have fewer than three triangles, or an edge with more than two. */
  unsigned int
  FindBrokenVertices(unsigned int wanted)
  {
    constexpr unsigned int fewest = 3;
    this->CountTriangles();
    unsigned int broken = 0;
    for (unsigned int vertex = 0; vertex < m_NumberOfVertices; ++vertex)
    {
      broken |= unsigned{ m_Uses[1 + vertex].triangles < fewest || m_Uses[1 + vertex].many != 0 } << vertex;
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
      m_Vertices[FirstOfCenter + direction] = static_cast<VertexType>(FirstOfCenter + parts.GetVertex(direction));
    }
    m_NumberOfVertices = std::max(1u, parts.GetNumberOfVertices());
    m_AreCounted = false;
  }

  /** The crossings of the site's parts that break a condition. */
  unsigned int
  FindBroken()
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
  FindHelpful(unsigned int part)
  {
    const auto vertex = static_cast<VertexType>(FirstOfCenter + this->NumberOf(part));
    this->CountTriangles();
    unsigned int helpful = part;
    for (std::uint64_t ends = m_Uses[1 + this->NumberOf(part)].many; ends != 0; ends &= ends - 1)
    {
      const std::uint64_t edge = BitOf(vertex) | (ends & ~(ends - 1));
      unsigned int touching = 0;
      for (unsigned int n = 0; n < m_NumberOfTriangles; ++n)
      {
        std::uint64_t all = 0;
        unsigned int own = 0;
        for (const std::uint8_t corner : m_Triangles[n])
        {
          all |= BitOf(m_Vertices[corner]);
          own |= m_Vertices[corner] == vertex ? 1U << (corner - FirstOfCenter) : 0;
        }
        touching |= (edge & ~all) == 0 && __builtin_popcountll(all) == 3 ? own : 0;
      }
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
        if (IsSingle(rest) || this->FindBrokenVertices(1U << this->NumberOf(rest)) == 0)
        {
          return;
        }
      }
    }
    this->SetParts(FCCSiteParts(m_Crossings, single | part));
  }

  /** The number of the vertex that a part makes. */
  unsigned int
  NumberOf(unsigned int part) const
  {
    return m_Parts[Center].GetVertex(static_cast<unsigned int>(__builtin_ctz(part)));
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

  /** Finds the triangles of the site's vertices, with the parts that the site has now, where that has not been done. */
  void
  CountTriangles()
  {
    if (std::exchange(m_AreCounted, true))
    {
      return;
    }
    std::fill_n(m_Uses, 1 + m_NumberOfVertices, Use());
    for (unsigned int n = 0; n < m_NumberOfTriangles; ++n)
    {
      const auto [a, b, c] = m_Triangles[n];
      const VertexType vertices[3] = { m_Vertices[a], m_Vertices[b], m_Vertices[c] };
      const bool isThere = IsTriangle(vertices[0], vertices[1], vertices[2]);
      const std::uint64_t all = BitOf(vertices[0]) | BitOf(vertices[1]) | BitOf(vertices[2]);
      for (const VertexType vertex : vertices)
      {
        const unsigned int place = std::max<unsigned int>(vertex, FirstOfCenter - 1) - (FirstOfCenter - 1);
        m_Uses[place].Add(all & ~BitOf(vertex), isThere);
      }
    }
  }

  std::array<SizeValueType, 3> m_Places[FCCSiteStar::Sites];
  unsigned int m_Split{ 0 };
  unsigned int m_Crossings{ 0 }; ///< directions of the crossings that the site is nearer to
  FCCSiteParts m_Parts[FCCSiteStar::Sites];
  std::uint8_t m_Nearer[FCCSiteStar::Edges]; ///< the sites that are nearer to the crossings of cut edges
  unsigned int m_NumberOfVertices{ 1 };
  VertexType m_Vertices[64]; ///< by the corners of triangles, with the parts that the site has now
  unsigned int m_NumberOfTriangles{ 0 };
  Triangle m_Triangles[2 * FCCSiteStar::Tetrahedra];
  std::uint64_t m_Above{ 0 }; ///< the triangles above the site's plane, as bits
  LayerCounts m_TrianglesBefore{};
  bool m_AreCounted{ false };
  Use m_Uses[1 + FCCCells::Directions]; ///< of all other sites, then of the site's vertices, if they are counted
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
      m_Planes[k].divided.push_back({ sites[n].number, division.GetParts(), division.CountAddedTriangles() });
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
  for (const auto & [number, parts, added] : divided)
  {
    m_Split.Set(number % width, number / width, k, parts);
    triangles[k] += added[1];
    k > 0 ? void(triangles[k - 1] += added[0]) : void();
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
