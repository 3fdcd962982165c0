#include "itkFCCSplitSites.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <deque>
#include <unordered_map>

namespace itk
{
namespace
{

using SiteType = FCCLattice::SiteType;
constexpr unsigned int Directions = FCCSiteStar::Directions;

constexpr SiteType
operator+(const SiteType & a, const SiteType & b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

/** The direction of a step, or Directions if there is no such edge. */
unsigned int
DirectionOf(const SiteType & step)
{
  for (unsigned int direction = 0; direction < Directions; ++direction)
  {
    if (FCCSiteStar::StepOf(direction) == step)
    {
      return direction;
    }
  }
  return Directions;
}

bool
AreAdjacent(unsigned int a, unsigned int b)
{
  const SiteType from = FCCSiteStar::StepOf(a);
  const SiteType to = FCCSiteStar::StepOf(b);
  return DirectionOf({ to[0] - from[0], to[1] - from[1], to[2] - from[2] }) != Directions;
}

/** The edges and triangles between the crossings of a site, as sets of directions. */
struct Star
{
  std::array<unsigned int, Directions> adjacent{};
  std::vector<unsigned int> edges;
  std::vector<std::array<unsigned int, 3>> tetrahedra; ///< the far corners of those at the site
  std::bitset<1U << Directions> isDisk;

  Star()
  {
    for (unsigned int a = 0; a < Directions; ++a)
    {
      for (unsigned int b = 0; b < a; ++b)
      {
        if (AreAdjacent(a, b))
        {
          edges.push_back(1U << a | 1U << b);
          adjacent[a] |= 1U << b;
          adjacent[b] |= 1U << a;
          for (unsigned int c = 0; c < b; ++c)
          {
            if (AreAdjacent(a, c) && AreAdjacent(b, c))
            {
              tetrahedra.push_back({ a, b, c });
            }
          }
        }
      }
    }
    for (unsigned int set = 1; set < 1U << Directions; ++set)
    {
      auto characteristic = static_cast<int>(std::bitset<Directions>(set).count());
      for (const unsigned int edge : edges)
      {
        characteristic -= (edge & set) == edge ? 1 : 0;
      }
      for (const auto & [a, b, c] : tetrahedra)
      {
        characteristic += (set >> a & set >> b & set >> c & 1) != 0 ? 1 : 0;
      }
      isDisk[set] = characteristic == 1 && this->PartOf(set, static_cast<unsigned int>(__builtin_ctz(set))) == set;
    }
  }

  unsigned int
  PartOf(unsigned int set, unsigned int direction) const
  {
    unsigned int part = 1U << direction;
    for (unsigned int added = part; added != 0;)
    {
      unsigned int next = 0;
      for (; added != 0; added &= added - 1)
      {
        next |= adjacent[static_cast<unsigned int>(__builtin_ctz(added))];
      }
      added = next & set & ~part;
      part |= added;
    }
    return part;
  }
};

const Star &
GetStar()
{
  static const Star star;
  return star;
}

/** A vertex in the making: its site's number and the lowest direction of its crossings, or Whole. */
using VertexType = std::uint64_t;
constexpr unsigned int Whole = 15;

/** Resolves one surface. Sites are in lattice coordinates whose rows have the parity of the signs'. */
class Resolver
{
public:
  Resolver(const FCCSigns & signs, const FCCSplitSites::ValueReader & valueAt, bool insideIsBelow)
    : m_Signs(signs)
    , m_ValueAt(valueAt)
    , m_InsideIsBelow(insideIsBelow)
  {}

  void
  Run(const std::vector<SiteType> & suspects)
  {
    for (const auto & [i, j, k] : suspects)
    {
      const SiteType site{ 2 * i + m_Signs.GetParity(static_cast<SizeValueType>(j), static_cast<SizeValueType>(k)),
                           j,
                           k };
      if (!FCCSiteStar::IsDisk(this->OwnedBy(site)))
      {
        this->Divide(site);
        this->FindTriangles(site);
        this->EnqueueNeighbors();
      }
      this->Enqueue(site);
    }
    while (!m_Queue.empty())
    {
      const SiteType site = m_Queue.front();
      m_Queue.pop_front();
      m_Queued.erase(this->NumberOf(site));
      this->Check(site);
    }
  }

  /** Adds to the number of triangles above each plane what splitting has changed. */
  void
  AddChange(std::vector<SizeValueType> & triangles) const
  {
    for (const auto & [number, parts] : m_Parts)
    {
      const SiteType site = this->SiteOf(number);
      for (const auto & far : GetStar().tetrahedra)
      {
        const std::array<SiteType, 4> sites = TetrahedronAt(site, far);
        std::array<Corner, 4> corners;
        const std::size_t count = this->FindPolygon(sites, corners);
        // A tetrahedron with crossings of several split sites is counted at the lowest of them.
        SizeValueType lowest = ~SizeValueType{ 0 };
        for (std::size_t n = 0; n < count; ++n)
        {
          const bool isSplit = corners[n].vertex % 16 != Whole;
          lowest = isSplit ? std::min(lowest, this->NumberOf(corners[n].owner)) : lowest;
        }
        if (lowest != number)
        {
          continue;
        }
        const auto plane = static_cast<std::size_t>(std::min({ sites[0][2], sites[1][2], sites[2][2], sites[3][2] }));
        for (std::size_t n = 2; n < count; ++n)
        {
          const Corner & a = corners[0];
          const Corner & b = corners[n - 1];
          const Corner & c = corners[n];
          triangles[plane] += AreDistinct(a.vertex, b.vertex, c.vertex) ? 1 : 0;
          triangles[plane] -=
            AreDistinct(this->NumberOf(a.owner), this->NumberOf(b.owner), this->NumberOf(c.owner)) ? 1 : 0;
        }
      }
    }
  }

  /** The sites that are not whole, and the directions of those of their crossings that are alone. */
  struct Parts
  {
    unsigned int owned;
    unsigned int lone;
  };
  const std::unordered_map<SizeValueType, Parts> &
  GetParts() const
  {
    return m_Parts;
  }

private:
  std::array<SizeValueType, 3>
  IndexOf(const SiteType & site) const
  {
    const auto j = static_cast<SizeValueType>(site[1]);
    const auto k = static_cast<SizeValueType>(site[2]);
    return { static_cast<SizeValueType>((site[0] - m_Signs.GetParity(j, k)) / 2), j, k };
  }

  SizeValueType
  NumberOf(const SiteType & site) const
  {
    const auto [i, j, k] = this->IndexOf(site);
    return (k * m_Signs.GetHeight() + j) * m_Signs.GetWidth() + i;
  }

  SiteType
  SiteOf(SizeValueType number) const
  {
    const SizeValueType i = number % m_Signs.GetWidth();
    const SizeValueType j = number / m_Signs.GetWidth() % m_Signs.GetHeight();
    const SizeValueType k = number / m_Signs.GetWidth() / m_Signs.GetHeight();
    return { 2 * static_cast<IndexValueType>(i) + m_Signs.GetParity(j, k),
             static_cast<IndexValueType>(j),
             static_cast<IndexValueType>(k) };
  }

  bool
  IsInside(const SiteType & site) const
  {
    if (site[0] < 0 || site[1] < 0 || site[2] < 0)
    {
      return false;
    }
    const auto [i, j, k] = this->IndexOf(site);
    return i < m_Signs.GetWidth() && j < m_Signs.GetHeight() && k < m_Signs.GetDepth() &&
           (m_Signs.GetRow(j, k)[i / FCCSigns::WordBits] >> (i % FCCSigns::WordBits) & 1) != 0;
  }

  bool
  IsReal(const SiteType & site) const
  {
    const auto [i, j, k] = this->IndexOf(site);
    return i - 1 < m_Signs.GetWidth() - 2 && j - 1 < m_Signs.GetHeight() - 2 && k - 1 < m_Signs.GetDepth() - 2;
  }

  float
  ValueAt(const SiteType & site) const
  {
    const auto [i, j, k] = this->IndexOf(site);
    return m_ValueAt(i, j, k);
  }

  /** As FCCCrossingOwners has it. */
  bool
  InsideOwns(const SiteType & inside, const SiteType & outside) const
  {
    if (!this->IsReal(outside))
    {
      return false;
    }
    const float sum = this->ValueAt(inside) + this->ValueAt(outside);
    return m_InsideIsBelow ? sum > 0.0f : sum < 0.0f;
  }

  unsigned int
  OwnedBy(const SiteType & site) const
  {
    const bool isInside = this->IsInside(site);
    unsigned int owned = 0;
    for (unsigned int direction = 0; direction < Directions; ++direction)
    {
      const SiteType end = site + FCCSiteStar::StepOf(direction);
      if (this->IsInside(end) != isInside && this->InsideOwns(isInside ? site : end, isInside ? end : site) == isInside)
      {
        owned |= 1U << direction;
      }
    }
    return owned;
  }

  void
  Enqueue(const SiteType & site)
  {
    if (m_Queued.emplace(this->NumberOf(site), true).second)
    {
      m_Queue.push_back(site);
    }
  }

  /** From one set to its connected parts; those that are no disk, to points. */
  void
  Divide(const SiteType & site)
  {
    const unsigned int owned = this->OwnedBy(site);
    unsigned int lone = 0;
    for (unsigned int left = owned; left != 0;)
    {
      const unsigned int part = FCCSiteStar::PartOf(owned, static_cast<unsigned int>(__builtin_ctz(left)));
      lone |= FCCSiteStar::IsDisk(part) ? 0 : part;
      left &= ~part;
    }
    m_Parts[this->NumberOf(site)] = { owned, lone };
  }

  static unsigned int
  LowestOf(const Parts & parts, unsigned int direction)
  {
    return (parts.lone >> direction & 1) != 0
             ? direction
             : static_cast<unsigned int>(__builtin_ctz(FCCSiteStar::PartOf(parts.owned & ~parts.lone, direction)));
  }

  /** The vertex that the crossing between two sites belongs to, and its owner. */
  VertexType
  VertexOf(const SiteType & inside, const SiteType & outside, SiteType & owner) const
  {
    const bool insideOwns = this->InsideOwns(inside, outside);
    owner = insideOwns ? inside : outside;
    const SiteType & other = insideOwns ? outside : inside;
    const SizeValueType number = this->NumberOf(owner);
    const auto found = m_Parts.find(number);
    if (found == m_Parts.end())
    {
      return number * 16 + Whole;
    }
    const unsigned int direction = DirectionOf({ other[0] - owner[0], other[1] - owner[1], other[2] - owner[2] });
    return number * 16 + LowestOf(found->second, direction);
  }

  /** Counts the triangles around a site's vertices and divides those that break a condition. */
  void
  Check(const SiteType & site)
  {
    this->FindTriangles(site);
    const SizeValueType number = this->NumberOf(site);
    const auto parts = m_Parts.find(number);
    const bool isWhole = parts == m_Parts.end();
    if (isWhole)
    {
      if (!this->Breaks(number * 16 + Whole))
      {
        return;
      }
      this->Divide(site);
    }
    else
    {
      const std::vector<SiteType> neighbors = m_Neighbors;
      if (!this->DivideParts(site, parts->second))
      {
        return;
      }
      m_Neighbors = neighbors;
    }
    this->Enqueue(site);
    this->EnqueueNeighbors();
  }

  /** Divides the parts of a site that break a condition: where that helps, by making a point of one of their crossings,
   * else of all. Returns whether there were any. */
  bool
  DivideParts(const SiteType & site, Parts & parts)
  {
    const unsigned int broken = this->FindBroken(site, parts);
    for (unsigned int left = broken; left != 0;)
    {
      const unsigned int part =
        FCCSiteStar::PartOf(parts.owned & ~parts.lone, static_cast<unsigned int>(__builtin_ctz(left)));
      left &= ~part;
      const unsigned int lone = parts.lone;
      parts.lone = lone | part;
      for (unsigned int candidates = part; candidates != 0; candidates &= candidates - 1)
      {
        const unsigned int point = candidates & ~(candidates - 1);
        const Parts tried{ parts.owned, lone | point };
        if (!FCCSiteStar::IsDisk(part & ~point))
        {
          continue;
        }
        parts.lone = tried.lone;
        this->FindTriangles(site);
        if ((this->FindBroken(site, parts) & part) == 0)
        {
          break;
        }
        parts.lone = lone | part;
      }
    }
    return broken != 0;
  }

  /** The crossings of the parts that break a condition, by the triangles found last. */
  unsigned int
  FindBroken(const SiteType & site, const Parts & parts) const
  {
    const SizeValueType number = this->NumberOf(site);
    unsigned int broken = 0;
    for (unsigned int left = parts.owned & ~parts.lone; left != 0;)
    {
      const auto lowest = static_cast<unsigned int>(__builtin_ctz(left));
      const unsigned int part = FCCSiteStar::PartOf(parts.owned & ~parts.lone, lowest);
      const bool isPoint = (part & (part - 1)) == 0;
      broken |= !isPoint && this->Breaks(number * 16 + lowest) ? part : 0;
      left &= ~part;
    }
    return broken;
  }

  /** The sites whose vertices share triangles, as they were before, with those found last. */
  void
  EnqueueNeighbors()
  {
    for (const SiteType & neighbor : m_Neighbors)
    {
      this->Enqueue(neighbor);
    }
  }

  /** The triangles in all tetrahedra at a site, and the owners of their corners. */
  void
  FindTriangles(const SiteType & site)
  {
    m_Triangles.clear();
    m_Neighbors.clear();
    for (const auto & far : GetStar().tetrahedra)
    {
      std::array<Corner, 4> corners;
      const std::size_t count = this->FindPolygon(TetrahedronAt(site, far), corners);
      for (std::size_t n = 0; n < count; ++n)
      {
        m_Neighbors.push_back(corners[n].owner);
      }
      for (std::size_t n = 2; n < count; ++n)
      {
        if (AreDistinct(corners[0].vertex, corners[n - 1].vertex, corners[n].vertex))
        {
          m_Triangles.push_back({ corners[0].vertex, corners[n - 1].vertex, corners[n].vertex });
        }
      }
    }
  }

  static std::array<SiteType, 4>
  TetrahedronAt(const SiteType & site, const std::array<unsigned int, 3> & far)
  {
    return {
      site, site + FCCSiteStar::StepOf(far[0]), site + FCCSiteStar::StepOf(far[1]), site + FCCSiteStar::StepOf(far[2])
    };
  }

  /** Whether a vertex has fewer than three triangles, or an edge with more than two. */
  bool
  Breaks(VertexType vertex) const
  {
    constexpr std::size_t fewest = 3;
    std::size_t triangles = 0;
    std::array<std::pair<VertexType, unsigned int>, 48> ends;
    std::size_t count = 0;
    for (const auto & triangle : m_Triangles)
    {
      if (std::find(triangle.begin(), triangle.end(), vertex) == triangle.end())
      {
        continue;
      }
      ++triangles;
      for (const VertexType end : triangle)
      {
        if (end == vertex)
        {
          continue;
        }
        const auto last = ends.begin() + static_cast<std::ptrdiff_t>(count);
        const auto found = std::find_if(ends.begin(), last, [end](const auto & known) { return known.first == end; });
        if (found == last)
        {
          ends[count++] = { end, 1 };
        }
        else if (++found->second > 2)
        {
          return true;
        }
      }
    }
    return triangles < fewest;
  }

  /** A corner of the surface's polygon in a tetrahedron. */
  struct Corner
  {
    VertexType vertex;
    SiteType owner;
  };

  /** Finds the polygon, 3 or 4 corners in order, or none. One of 4 is to be cut from corner 0 to corner 2, as
   * FillLeanTriangles() does: from the crossing of the lowest two corners when its owner is inside, else across. */
  std::size_t
  FindPolygon(const std::array<SiteType, 4> & sites, std::array<Corner, 4> & corners) const
  {
    std::array<SiteType, 4> inside;
    std::array<SiteType, 4> outside;
    std::size_t insides = 0;
    std::size_t outsides = 0;
    for (const SiteType & site : sites)
    {
      (this->IsInside(site) ? inside[insides++] : outside[outsides++]) = site;
    }
    if (insides == 0 || outsides == 0)
    {
      return 0;
    }
    const auto cornerAt = [this, &inside, &outside](std::size_t in, std::size_t out) {
      Corner corner;
      corner.vertex = this->VertexOf(inside[in], outside[out], corner.owner);
      return corner;
    };
    if (insides == 2)
    {
      const auto isLower = [](const SiteType & a, const SiteType & b) {
        return std::array<IndexValueType, 3>{ a[2], a[1], a[0] } < std::array<IndexValueType, 3>{ b[2], b[1], b[0] };
      };
      const std::size_t lowIn = isLower(inside[0], inside[1]) ? 0 : 1;
      const std::size_t lowOut = isLower(outside[0], outside[1]) ? 0 : 1;
      corners = { cornerAt(lowIn, lowOut),
                  cornerAt(lowIn, 1 - lowOut),
                  cornerAt(1 - lowIn, 1 - lowOut),
                  cornerAt(1 - lowIn, lowOut) };
      if (!this->InsideOwns(inside[lowIn], outside[lowOut]))
      {
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      }
      return 4;
    }
    for (std::size_t n = 0; n < 3; ++n)
    {
      corners[n] = insides == 1 ? cornerAt(0, n) : cornerAt(n, 0);
    }
    return 3;
  }

  static bool
  AreDistinct(VertexType a, VertexType b, VertexType c)
  {
    return a != b && b != c && c != a;
  }

  const FCCSigns & m_Signs;
  const FCCSplitSites::ValueReader & m_ValueAt;
  bool m_InsideIsBelow;
  std::unordered_map<SizeValueType, Parts> m_Parts;
  std::deque<SiteType> m_Queue;
  std::unordered_map<SizeValueType, bool> m_Queued;
  std::vector<std::array<VertexType, 3>> m_Triangles;
  std::vector<SiteType> m_Neighbors;
};

} // namespace

bool
FCCSiteStar::IsDisk(unsigned int set)
{
  return GetStar().isDisk[set];
}

SizeValueType
FCCSiteStar::CountParts(unsigned int owned, unsigned int lone)
{
  auto parts = static_cast<SizeValueType>(__builtin_popcount(lone));
  for (unsigned int left = owned & ~lone; left != 0; ++parts)
  {
    left &= ~PartOf(owned & ~lone, static_cast<unsigned int>(__builtin_ctz(left)));
  }
  return parts;
}

unsigned int
FCCSiteStar::PartOf(unsigned int set, unsigned int direction)
{
  return GetStar().PartOf(set, direction);
}

FCCSplitSites::FCCSplitSites(const FCCSigns & signs)
  : m_Signs(signs)
  , m_Split(signs.GetWidth(), signs.GetHeight(), signs.GetDepth(), signs.GetParity(0, 0))
{}

void
FCCSplitSites::Suspect(const std::vector<SiteType> & indices)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_Suspects.insert(m_Suspects.end(), indices.begin(), indices.end());
}

void
FCCSplitSites::Resolve(const ValueReader & valueAt,
                       bool insideIsBelow,
                       std::vector<SizeValueType> & points,
                       std::vector<SizeValueType> & triangles)
{
  std::sort(m_Suspects.begin(), m_Suspects.end(), [](const SiteType & a, const SiteType & b) {
    return std::array<IndexValueType, 3>{ a[2], a[1], a[0] } < std::array<IndexValueType, 3>{ b[2], b[1], b[0] };
  });
  Resolver resolver(m_Signs, valueAt, insideIsBelow);
  resolver.Run(m_Suspects);
  std::vector<SiteType>().swap(m_Suspects);
  resolver.AddChange(triangles);
  for (const auto & [number, parts] : resolver.GetParts())
  {
    points[number / m_Split.GetWidth() / m_Split.GetHeight()] += FCCSiteStar::CountParts(parts.owned, parts.lone) - 1;
    const SizeValueType i = number % m_Split.GetWidth();
    const SizeValueType row = number / m_Split.GetWidth();
    m_Split.GetRow(row % m_Split.GetHeight(), row / m_Split.GetHeight())[i / FCCSigns::WordBits] |=
      WordType{ 1 } << (i % FCCSigns::WordBits);
    m_Lone.emplace_back(number, static_cast<std::uint16_t>(parts.lone));
  }
  std::sort(m_Lone.begin(), m_Lone.end());
}

unsigned int
FCCSplitSites::GetLone(SizeValueType i, SizeValueType j, SizeValueType k) const
{
  const SizeValueType number = (k * m_Split.GetHeight() + j) * m_Split.GetWidth() + i;
  return std::lower_bound(m_Lone.begin(), m_Lone.end(), std::make_pair(number, std::uint16_t{ 0 }))->second;
}

} // namespace itk
