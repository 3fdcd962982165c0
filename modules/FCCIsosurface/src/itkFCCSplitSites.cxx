#include "itkFCCSplitSites.h"

#include <algorithm>
#include <array>
#include <bitset>

namespace itk
{
namespace
{

using SiteType = FCCLattice::SiteType;
constexpr unsigned int Directions = FCCClusterPlane::Directions;

SiteType
StepOf(unsigned int direction)
{
  const SiteType & step = FCCLattice::OwnedEdges[direction % FCCClusterPlane::Types];
  const IndexValueType sign = direction < FCCClusterPlane::Types ? 1 : -1;
  return { sign * step[0], sign * step[1], sign * step[2] };
}

bool
IsEdge(const SiteType & step)
{
  for (unsigned int direction = 0; direction < Directions; ++direction)
  {
    if (StepOf(direction) == step)
    {
      return true;
    }
  }
  return false;
}

bool
AreAdjacent(const SiteType & a, const SiteType & b)
{
  return IsEdge({ b[0] - a[0], b[1] - a[1], b[2] - a[2] });
}

/** For each set of a site's directions: do the crossings of those edges form a disk? The crossings of two adjacent
 * edges are joined by an edge of the surface, those of three by a triangle. A connected set is a disk when points -
 * edges + triangles = 1. */
class DiskTable
{
public:
  DiskTable()
  {
    std::vector<unsigned int> edges;
    std::vector<unsigned int> triangles;
    std::array<unsigned int, Directions> adjacent{};
    for (unsigned int a = 0; a < Directions; ++a)
    {
      for (unsigned int b = 0; b < a; ++b)
      {
        if (!AreAdjacent(StepOf(a), StepOf(b)))
        {
          continue;
        }
        edges.push_back(1U << a | 1U << b);
        adjacent[a] |= 1U << b;
        adjacent[b] |= 1U << a;
        for (unsigned int c = 0; c < b; ++c)
        {
          if (AreAdjacent(StepOf(a), StepOf(c)) && AreAdjacent(StepOf(b), StepOf(c)))
          {
            triangles.push_back(1U << a | 1U << b | 1U << c);
          }
        }
      }
    }
    const auto countWithin = [](const std::vector<unsigned int> & parts, unsigned int set) {
      return std::count_if(parts.begin(), parts.end(), [set](unsigned int part) { return (part & set) == part; });
    };
    for (unsigned int set = 1; set < 1U << Directions; ++set)
    {
      unsigned int reached = set & ~(set - 1);
      for (unsigned int before = 0; before != reached;)
      {
        before = reached;
        for (unsigned int direction = 0; direction < Directions; ++direction)
        {
          reached |= (reached >> direction & 1) != 0 ? adjacent[direction] & set : 0;
        }
      }
      const auto points = static_cast<std::ptrdiff_t>(std::bitset<Directions>(set).count());
      m_IsDisk[set] = reached == set && points - countWithin(edges, set) + countWithin(triangles, set) == 1;
    }
  }

  bool
  IsDisk(unsigned int set) const
  {
    return m_IsDisk[set];
  }

private:
  std::bitset<1U << Directions> m_IsDisk;
};

/** The sites adjacent to both ends of an edge, in the order in which its tetrahedra follow each other around it, as
 * steps from its first end. */
struct EdgeRing
{
  std::vector<SiteType> sites;

  explicit EdgeRing(const SiteType & step)
  {
    std::vector<SiteType> common;
    for (unsigned int direction = 0; direction < Directions; ++direction)
    {
      if (AreAdjacent(StepOf(direction), step))
      {
        common.push_back(StepOf(direction));
      }
    }
    sites.push_back(common.front());
    while (sites.size() < common.size())
    {
      const auto next = std::find_if(common.begin(), common.end(), [this](const SiteType & site) {
        return AreAdjacent(site, sites.back()) && std::find(sites.begin(), sites.end(), site) == sites.end();
      });
      sites.push_back(*next);
    }
  }
};

const DiskTable &
GetDiskTable()
{
  static const DiskTable table;
  return table;
}

const std::vector<EdgeRing> &
GetEdgeRings()
{
  static const std::vector<EdgeRing> rings = [] {
    std::vector<EdgeRing> made;
    for (unsigned int direction = 0; direction < Directions; ++direction)
    {
      made.emplace_back(StepOf(direction));
    }
    return made;
  }();
  return rings;
}

/** Looks at the surface around single crossings, site by site. Sites are given in lattice coordinates whose rows have
 * the parity of the signs'. */
class Surroundings
{
public:
  Surroundings(const FCCSigns & signs, const FCCSplitSites::ValueReader & valueAt, bool insideIsBelow)
    : m_Signs(signs)
    , m_ValueAt(valueAt)
    , m_InsideIsBelow(insideIsBelow)
  {}

  SiteType
  SiteOf(SizeValueType i, SizeValueType j, SizeValueType k) const
  {
    return { 2 * static_cast<IndexValueType>(i) + m_Signs.GetParity(j, k),
             static_cast<IndexValueType>(j),
             static_cast<IndexValueType>(k) };
  }

  std::array<SizeValueType, 3>
  IndexOf(const SiteType & site) const
  {
    const auto j = static_cast<SizeValueType>(site[1]);
    const auto k = static_cast<SizeValueType>(site[2]);
    return { static_cast<SizeValueType>((site[0] - m_Signs.GetParity(j, k)) / 2), j, k };
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

  /** The end that owns the crossing between two sites, of which one is inside. */
  SiteType
  OwnerOf(const SiteType & a, const SiteType & b) const
  {
    const bool aIsInside = this->IsInside(a);
    const SiteType & inside = aIsInside ? a : b;
    const SiteType & outside = aIsInside ? b : a;
    if (!this->IsReal(outside))
    {
      return outside;
    }
    const float sum = this->ValueAt(a) + this->ValueAt(b);
    return (m_InsideIsBelow ? sum > 0.0f : sum < 0.0f) ? inside : outside;
  }

  /** The owners of the crossings around that of an edge, in order. */
  std::vector<SiteType>
  OwnersAround(const SiteType & site, unsigned int direction) const
  {
    const auto add = [](const SiteType & a, const SiteType & b) {
      return SiteType{ a[0] + b[0], a[1] + b[1], a[2] + b[2] };
    };
    const SiteType end = add(site, StepOf(direction));
    const auto & ring = GetEdgeRings()[direction].sites;
    std::vector<SiteType> owners;
    for (std::size_t n = 0; n < ring.size(); ++n)
    {
      const SiteType here = add(site, ring[n]);
      const SiteType next = add(site, ring[(n + 1) % ring.size()]);
      owners.push_back(this->IsInside(here) == this->IsInside(site) ? this->OwnerOf(end, here)
                                                                    : this->OwnerOf(site, here));
      if (this->IsInside(here) != this->IsInside(next) && this->IsCutAcross(site, end, here, next))
      {
        owners.push_back(this->OwnerOf(here, next));
      }
    }
    return owners;
  }

private:
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

  /** Whether the quadrilateral between two sites inside and two outside is cut from the crossing of a and b to that of
   * c and d. FillLeanTriangles() says how it is cut. */
  bool
  IsCutAcross(const SiteType & a, const SiteType & b, const SiteType & c, const SiteType & d) const
  {
    const auto isLower = [](const SiteType & x, const SiteType & y) {
      return std::array<IndexValueType, 3>{ x[2], x[1], x[0] } < std::array<IndexValueType, 3>{ y[2], y[1], y[0] };
    };
    SiteType lowestInside;
    SiteType lowestOutside;
    bool hasInside = false;
    bool hasOutside = false;
    for (const SiteType & site : { a, b, c, d })
    {
      if (this->IsInside(site))
      {
        lowestInside = !hasInside || isLower(site, lowestInside) ? site : lowestInside;
        hasInside = true;
      }
      else
      {
        lowestOutside = !hasOutside || isLower(site, lowestOutside) ? site : lowestOutside;
        hasOutside = true;
      }
    }
    const bool cutAtDecider = this->OwnerOf(lowestInside, lowestOutside) == lowestInside;
    // The decider is one of the two crossings in question when its ends are both of a and b, or neither is.
    const bool hasFirst = lowestInside == a || lowestInside == b;
    const bool hasSecond = lowestOutside == a || lowestOutside == b;
    return cutAtDecider == (hasFirst == hasSecond);
  }

  const FCCSigns & m_Signs;
  const FCCSplitSites::ValueReader & m_ValueAt;
  bool m_InsideIsBelow;
};

} // namespace

FCCSplitSites::FCCSplitSites(const FCCSigns & signs)
  : m_Signs(signs)
  , m_Split(signs.GetWidth(), signs.GetHeight(), signs.GetDepth(), signs.GetParity(0, 0))
{}

void
FCCSplitSites::FindSeeds(SizeValueType k,
                         const FCCClusterPlane & plane,
                         const FCCTriangleUse & use,
                         const FCCTriangleUse * useBelow)
{
  constexpr std::uint64_t tooMany = 0xFCFCFCFCFCFCFC; // counts of edges are even
  constexpr std::uint64_t fewest = 3;
  const DiskTable & disks = GetDiskTable();
  for (SizeValueType j = 0; j < m_Signs.GetHeight(); ++j)
  {
    WordType * const split = m_Split.GetRow(j, k);
    const WordType * const clusters = plane.GetClusters().GetRow(j);
    for (SizeValueType word = 0; word < m_Signs.GetNumberOfWords(); ++word)
    {
      for (WordType mask = clusters[word]; mask != 0; mask &= mask - 1)
      {
        const auto bit = static_cast<SizeValueType>(__builtin_ctzll(mask));
        const SizeValueType i = word * FCCSigns::WordBits + bit;
        const std::uint64_t counts = use.counts[j * use.stride + i];
        bool isSplit = (counts & tooMany) != 0 || counts >> 56 < fewest || !disks.IsDisk(plane.GetOwned(j, i));
        // Edges that the neighbours store.
        for (unsigned int type = 0; type < FCCClusterPlane::Types && !isSplit; ++type)
        {
          const auto & step = FCCLattice::OwnedEdges[type];
          const FCCTriangleUse * const from = step[2] == 1 ? useBelow : &use;
          const SizeValueType fromJ = j - static_cast<SizeValueType>(step[1]);
          if (from == nullptr || fromJ >= m_Signs.GetHeight())
          {
            continue;
          }
          const auto offset =
            FCCLattice::OffsetOf(step, m_Signs.GetParity(fromJ, k - static_cast<SizeValueType>(step[2])))[0];
          const SizeValueType fromI = i - static_cast<SizeValueType>(offset);
          isSplit =
            fromI < m_Signs.GetWidth() && (from->counts[fromJ * from->stride + fromI] >> (8 * type) & 0xFC) != 0;
        }
        split[word] |= static_cast<WordType>(isSplit) << bit;
      }
    }
  }
}

void
FCCSplitSites::Close(const ValueReader & valueAt, bool insideIsBelow)
{
  const Surroundings surroundings(m_Signs, valueAt, insideIsBelow);
  std::vector<SiteType> toVisit;
  for (SizeValueType k = 0; k < m_Split.GetDepth(); ++k)
  {
    for (SizeValueType j = 0; j < m_Split.GetHeight(); ++j)
    {
      for (SizeValueType word = 0; word < m_Split.GetNumberOfWords(); ++word)
      {
        for (WordType mask = m_Split.GetRow(j, k)[word]; mask != 0; mask &= mask - 1)
        {
          const auto bit = static_cast<SizeValueType>(__builtin_ctzll(mask));
          toVisit.push_back(surroundings.SiteOf(word * FCCSigns::WordBits + bit, j, k));
        }
      }
    }
  }
  const auto splitBit = [&](const SiteType & site) -> std::pair<WordType *, WordType> {
    const auto [i, j, k] = surroundings.IndexOf(site);
    return { m_Split.GetRow(j, k) + i / FCCSigns::WordBits, WordType{ 1 } << (i % FCCSigns::WordBits) };
  };
  while (!toVisit.empty())
  {
    const SiteType site = toVisit.back();
    toVisit.pop_back();
    for (unsigned int direction = 0; direction < Directions; ++direction)
    {
      const SiteType step = StepOf(direction);
      const SiteType end{ site[0] + step[0], site[1] + step[1], site[2] + step[2] };
      if (surroundings.IsInside(site) == surroundings.IsInside(end) || surroundings.OwnerOf(site, end) != site)
      {
        continue;
      }
      const std::vector<SiteType> owners = surroundings.OwnersAround(site, direction);
      for (std::size_t n = 0; n < owners.size(); ++n)
      {
        // A run of one owner begins here; a second one elsewhere would make an edge of four triangles.
        const SiteType & owner = owners[n];
        SizeValueType runs = 0;
        for (std::size_t m = 0; m < owners.size(); ++m)
        {
          runs += owners[m] == owner && owners[(m + owners.size() - 1) % owners.size()] != owner ? 1 : 0;
        }
        const auto [word, bit] = splitBit(owner);
        if (runs > 1 && (*word & bit) == 0)
        {
          *word |= bit;
          toVisit.push_back(owner);
        }
      }
    }
  }
}

} // namespace itk
