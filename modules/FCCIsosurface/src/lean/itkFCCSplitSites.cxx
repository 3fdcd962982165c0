#include "itkFCCSplitSites.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <numeric>

namespace itk
{
namespace
{

using SiteType = FCCLattice::SiteType;
constexpr unsigned int Directions = FCCSiteStar::Directions;
constexpr unsigned int NoDirection = Directions;

/** A site's neighbours by direction, and the site itself: all sites of the tetrahedra around it. */
constexpr unsigned int Sites = Directions + 1;
constexpr unsigned int Center = Directions;

SiteType
StepTo(unsigned int site)
{
  return site == Center ? SiteType{ 0, 0, 0 } : FCCSiteStar::StepOf(site);
}

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
  return NoDirection;
}

/** The surroundings of a site, which are the same for all sites. */
struct Star
{
  /** An edge between two sites of the surroundings. */
  struct Edge
  {
    std::uint8_t ends[2];
    std::uint8_t directions[2]; ///< from either end to the other
  };

  /** The surface's polygon in a tetrahedron. One of 4 corners is to be cut from corner 0 to corner 2, as
   * FillLeanTriangles() does, when the first corner's owner is inside, else from corner 1 to corner 3. */
  struct Polygon
  {
    std::uint8_t corners = 0;
    std::uint8_t edges[4] = {};
  };

  struct Tetrahedron
  {
    std::uint8_t sites[4]; ///< the center first
    unsigned int far;      ///< the directions of the others
    Polygon polygons[16];  ///< by the corners inside
  };

  std::array<std::array<std::uint8_t, Sites>, Sites> direction{}; ///< from one site to another, or NoDirection
  std::array<std::array<std::uint8_t, Sites>, Sites> edge{};      ///< between two sites
  std::array<unsigned int, Directions> adjacent{};
  std::vector<Edge> edges;
  std::vector<Tetrahedron> tetrahedra;
  std::bitset<1U << Directions> isDisk;

  Star()
  {
    for (unsigned int a = 0; a < Sites; ++a)
    {
      for (unsigned int b = 0; b < Sites; ++b)
      {
        const SiteType from = StepTo(a);
        const SiteType to = StepTo(b);
        direction[a][b] = static_cast<std::uint8_t>(DirectionOf({ to[0] - from[0], to[1] - from[1], to[2] - from[2] }));
      }
    }
    for (unsigned int a = 0; a < Sites; ++a)
    {
      for (unsigned int b = 0; b < a; ++b)
      {
        if (direction[a][b] != NoDirection)
        {
          edge[a][b] = edge[b][a] = static_cast<std::uint8_t>(edges.size());
          edges.push_back(
            { { static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b) }, { direction[a][b], direction[b][a] } });
        }
      }
    }
    for (unsigned int a = 0; a < Directions; ++a)
    {
      for (unsigned int b = 0; b < a; ++b)
      {
        if (direction[a][b] == NoDirection)
        {
          continue;
        }
        adjacent[a] |= 1U << b;
        adjacent[b] |= 1U << a;
        for (unsigned int c = 0; c < b; ++c)
        {
          if (direction[a][c] != NoDirection && direction[b][c] != NoDirection)
          {
            this->AddTetrahedron({ Center, a, b, c });
          }
        }
      }
    }
    for (unsigned int set = 1; set < 1U << Directions; ++set)
    {
      // Points - edges + triangles of the surface between the crossings of the center's edges.
      auto characteristic = static_cast<int>(std::bitset<Directions>(set).count());
      for (unsigned int a = 0; a < Directions; ++a)
      {
        const unsigned int later = adjacent[a] & ~((2U << a) - 1);
        characteristic -= (set >> a & 1) != 0 ? static_cast<int>(std::bitset<Directions>(later & set).count()) : 0;
      }
      for (const Tetrahedron & tetrahedron : tetrahedra)
      {
        const auto & far = tetrahedron.sites;
        characteristic += (set >> far[1] & set >> far[2] & set >> far[3] & 1) != 0 ? 1 : 0;
      }
      isDisk[set] = characteristic == 1 && this->PartOf(set, static_cast<unsigned int>(__builtin_ctz(set))) == set;
    }
  }

  unsigned int
  PartOf(unsigned int set, unsigned int from) const
  {
    unsigned int part = 1U << from;
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

private:
  /** Whether one site comes before another by z, then y, then x, as sites are numbered. */
  static bool
  IsLower(unsigned int a, unsigned int b)
  {
    const SiteType first = StepTo(a);
    const SiteType second = StepTo(b);
    return std::array<IndexValueType, 3>{ first[2], first[1], first[0] } <
           std::array<IndexValueType, 3>{ second[2], second[1], second[0] };
  }

  void
  AddTetrahedron(const std::array<unsigned int, 4> & sites)
  {
    Tetrahedron tetrahedron;
    std::copy(sites.begin(), sites.end(), tetrahedron.sites);
    tetrahedron.far = 1U << sites[1] | 1U << sites[2] | 1U << sites[3];
    for (unsigned int pattern = 1; pattern < 15; ++pattern)
    {
      std::vector<unsigned int> inside;
      std::vector<unsigned int> outside;
      for (unsigned int corner = 0; corner < 4; ++corner)
      {
        ((pattern >> corner & 1) != 0 ? inside : outside).push_back(sites[corner]);
      }
      std::sort(inside.begin(), inside.end(), IsLower);
      std::sort(outside.begin(), outside.end(), IsLower);
      Polygon & polygon = tetrahedron.polygons[pattern];
      const auto add = [&](std::size_t in, std::size_t out) {
        polygon.edges[polygon.corners++] = edge[inside[in]][outside[out]];
      };
      if (inside.size() == 2)
      {
        add(0, 0);
        add(0, 1);
        add(1, 1);
        add(1, 0);
      }
      else
      {
        for (std::size_t n = 0; n < 3; ++n)
        {
          add(inside.size() == 1 ? 0 : n, inside.size() == 1 ? n : 0);
        }
      }
    }
    tetrahedra.push_back(tetrahedron);
  }
};

const Star &
GetStar()
{
  static const Star star;
  return star;
}

/** A vertex within the surroundings of a site: its owner and the lowest direction of its crossings, or Whole. */
using VertexType = std::uint8_t;
constexpr unsigned int Whole = 15;
static_assert(Sites * 16 <= 256, "a vertex has a number of 8 bits");

/** The sites of the surroundings of a site: where they are, counted as signs are, and whether. */
struct Neighborhood
{
  std::array<SizeValueType, 3> places[Sites];
  SizeValueType numbers[Sites];
  unsigned int there{ 0 }; ///< bits of the sites that have signs
  unsigned int real{ 0 };  ///< bits of those in the image

  Neighborhood(const FCCSigns & signs, SizeValueType number)
  {
    const SizeValueType size[3] = { signs.GetWidth(), signs.GetHeight(), signs.GetDepth() };
    const SizeValueType index[3] = { number % size[0], number / size[0] % size[1], number / size[0] / size[1] };
    const IndexValueType parity = signs.GetParity(index[1], index[2]);
    for (unsigned int site = 0; site < Sites; ++site)
    {
      const auto offset = FCCLattice::OffsetOf(StepTo(site), parity);
      bool isThere = true;
      bool isReal = true;
      auto & place = places[site];
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        place[axis] = index[axis] + static_cast<SizeValueType>(offset[axis]);
        isThere = isThere && place[axis] < size[axis];
        isReal = isReal && place[axis] - 1 < size[axis] - 2;
      }
      numbers[site] = (place[2] * size[1] + place[1]) * size[0] + place[0];
      there |= static_cast<unsigned int>(isThere) << site;
      real |= static_cast<unsigned int>(isReal) << site;
    }
  }

  /** The bits of some sites. */
  template <typename TBits>
  unsigned int
  GetBits(const TBits & bits, unsigned int wanted) const
  {
    unsigned int found = 0;
    for (; wanted != 0; wanted &= wanted - 1)
    {
      const auto site = static_cast<unsigned int>(__builtin_ctz(wanted));
      const auto [i, j, k] = places[site];
      const auto bit = bits.GetRow(j, k)[i / FCCSigns::WordBits] >> (i % FCCSigns::WordBits) & 1;
      found |= static_cast<unsigned int>(bit) << site;
    }
    return found;
  }
};

/** Bit n is set when the end inside owns the crossing of edge n of the Star. */
FCCSplitSites::OwnersType
FindOwnersAround(const FCCSigns & signs,
                 const FCCSplitSites::ValueReader & readValues,
                 bool insideIsBelow,
                 SizeValueType site)
{
  const Neighborhood sites(signs, site);
  const unsigned int inside = sites.GetBits(signs, sites.real);
  float values[Sites] = {};
  readValues(sites.places, sites.real, values);
  const Star & star = GetStar();
  FCCSplitSites::OwnersType owners = 0;
  for (std::size_t n = 0; n < star.edges.size(); ++n)
  {
    const auto [a, b] = star.edges[n].ends;
    const unsigned int outside = (inside >> a & 1) != 0 ? b : a;
    const float sum = values[a] + values[b];
    const bool insideOwns = (sites.real >> outside & 1) != 0 && (insideIsBelow ? sum > 0.0f : sum < 0.0f);
    owners |= FCCSplitSites::OwnersType{ insideOwns } << n;
  }
  return owners;
}

/** The surface around one site, as it is while the parts of other sites do not change. */
class Surroundings
{
public:
  Surroundings(const FCCSigns & signs,
               const FCCSplitRows & split,
               FCCSplitSites::OwnersType owners,
               SizeValueType number)
    : m_Sites(signs, number)
    , m_Inside(m_Sites.GetBits(signs, m_Sites.real))
    , m_Split(m_Sites.GetBits(split, m_Sites.there))
  {
    for (unsigned int left = m_Split; left != 0; left &= left - 1)
    {
      const auto site = static_cast<unsigned int>(__builtin_ctz(left));
      const auto [i, j, k] = m_Sites.places[site];
      m_Parts[site] = split.GetParts(i, j, k);
    }
    const Star & star = GetStar();
    for (std::size_t n = 0; n < star.edges.size(); ++n)
    {
      const auto [a, b] = star.edges[n].ends;
      if (this->IsInside(a) == this->IsInside(b))
      {
        continue;
      }
      const bool insideOwns = (owners >> n & 1) != 0;
      m_Owner[n] = this->IsInside(a) == insideOwns ? a : b;
      if (m_Owner[n] == Center)
      {
        m_Owned |= 1U << star.edges[n].directions[a == Center ? 0 : 1];
      }
    }
    this->FindPolygons();
  }

  const FCCSiteParts &
  GetParts() const
  {
    return m_Parts[Center];
  }

  /** Numbers of the sites whose sets have an edge of more than two triangles with a point of this site. Its sets have
   * none, when it has been divided. */
  template <typename TUse>
  void
  ForEachBrokenNeighbor(const TUse & use) const
  {
    const auto check = [this, &use](unsigned int point) {
      const VertexType vertex = VertexOf(Center, static_cast<unsigned int>(__builtin_ctz(point)));
      this->CountUses(vertex, [&](VertexType end) { use(m_Sites.numbers[end / 16]); });
    };
    for (unsigned int left = m_Parts[Center].lone; left != 0; left &= left - 1)
    {
      check(left & ~(left - 1));
    }
    m_Parts[Center].ForEachPart([&check](unsigned int part) {
      if ((part & (part - 1)) == 0)
      {
        check(part);
      }
    });
  }

  /** Divides the site until none of its sets breaks a condition. Returns whether it was changed. */
  bool
  Divide()
  {
    const bool wasSplit = this->IsSplit(Center);
    if (!wasSplit)
    {
      this->FindTriangles();
      if (m_Owned == 0 || (GetStar().isDisk[m_Owned] && !this->Breaks(VertexOf(Center, Whole))))
      {
        return false;
      }
      m_Split |= 1U << Center;
      unsigned int lone = 0;
      FCCSiteParts(m_Owned, 0).ForEachPart([&lone](unsigned int part) { lone |= GetStar().isDisk[part] ? 0 : part; });
      m_Parts[Center] = FCCSiteParts(m_Owned, lone);
    }
    bool changed = !wasSplit;
    for (;;)
    {
      this->FindTriangles();
      const unsigned int broken = this->FindBroken();
      if (broken == 0)
      {
        return changed;
      }
      this->DividePart(GetStar().PartOf(broken, static_cast<unsigned int>(__builtin_ctz(broken))));
      changed = true;
    }
  }

  /** The most triangles that the tetrahedra with crossings of the site can have, between the plane below and its own,
   * and between its own and the one above: those before clustering. */
  std::array<SizeValueType, 2>
  GetMostTriangles() const
  {
    std::array<SizeValueType, 2> most{};
    for (unsigned int p = 0; p < m_NumberOfPolygons; ++p)
    {
      const auto & sites = m_Polygons[p].tetrahedron->sites;
      const bool isBelow = std::any_of(sites, sites + 4, [](std::uint8_t site) { return StepTo(site)[2] < 0; });
      most[isBelow ? 0 : 1] += m_Polygons[p].corners - 2;
    }
    return most;
  }

private:
  static VertexType
  VertexOf(unsigned int owner, unsigned int lowest)
  {
    return static_cast<VertexType>(owner * 16 + lowest);
  }

  static bool
  AreDistinct(VertexType a, VertexType b, VertexType c)
  {
    return a != b && b != c && c != a;
  }

  bool
  IsInside(unsigned int site) const
  {
    return (m_Inside >> site & 1) != 0;
  }
  bool
  IsSplit(unsigned int site) const
  {
    return (m_Split >> site & 1) != 0;
  }

  /** The vertices of the surface's polygon in a tetrahedron. One of 4 is to be cut from the first to the third. */
  struct Polygon
  {
    const Star::Tetrahedron * tetrahedron;
    std::uint8_t corners;
    VertexType vertices[4]; ///< those of the site itself by their direction, whatever the sets it has
  };

  /** The polygons with crossings that the site owns. */
  void
  FindPolygons()
  {
    for (const Star::Tetrahedron & tetrahedron : GetStar().tetrahedra)
    {
      if ((tetrahedron.far & m_Owned) == 0)
      {
        continue;
      }
      unsigned int pattern = 0;
      for (unsigned int corner = 0; corner < 4; ++corner)
      {
        pattern |= (m_Inside >> tetrahedron.sites[corner] & 1) << corner;
      }
      const Star::Polygon & found = tetrahedron.polygons[pattern];
      Polygon & polygon = m_Polygons[m_NumberOfPolygons++];
      polygon.tetrahedron = &tetrahedron;
      polygon.corners = found.corners;
      unsigned int place = found.corners == 4 && !this->IsInside(m_Owner[found.edges[0]]) ? 1 : 0;
      for (unsigned int n = 0; n < found.corners; ++n)
      {
        const std::uint8_t edge = found.edges[place];
        place = place + 1 == found.corners ? 0 : place + 1;
        const unsigned int owner = m_Owner[edge];
        const Star::Edge & ends = GetStar().edges[edge];
        const unsigned int direction = ends.directions[ends.ends[0] == owner ? 0 : 1];
        polygon.vertices[n] = VertexOf(owner,
                                       owner == Center        ? direction
                                       : this->IsSplit(owner) ? m_Parts[owner].LowestOf(direction)
                                                              : Whole);
      }
    }
  }

  /** The vertex of a polygon with the sets that the site has now. */
  VertexType
  CurrentOf(VertexType vertex) const
  {
    if (vertex < VertexOf(Center, 0))
    {
      return vertex;
    }
    return VertexOf(Center, this->IsSplit(Center) ? m_Parts[Center].LowestOf(vertex % 16) : Whole);
  }

  /** The triangles of these polygons: all that have vertices of the site. */
  void
  FindTriangles()
  {
    m_NumberOfTriangles = 0;
    for (unsigned int p = 0; p < m_NumberOfPolygons; ++p)
    {
      const Polygon & polygon = m_Polygons[p];
      const VertexType first = this->CurrentOf(polygon.vertices[0]);
      VertexType last = this->CurrentOf(polygon.vertices[1]);
      for (unsigned int n = 2; n < polygon.corners; ++n)
      {
        const VertexType next = this->CurrentOf(polygon.vertices[n]);
        if (AreDistinct(first, last, next))
        {
          m_Triangles[m_NumberOfTriangles++] = { first, last, next };
        }
        last = next;
      }
    }
  }

  /** Whether a vertex has fewer than three triangles, or an edge with more than two. */
  bool
  Breaks(VertexType vertex) const
  {
    constexpr unsigned int fewest = 3;
    bool hasBrokenEdge = false;
    return this->CountUses(vertex, [&](VertexType) { hasBrokenEdge = true; }) < fewest || hasBrokenEdge;
  }

  /** Counts the triangles of a vertex, and calls use(vertex) for the other ends of its edges with more than two. */
  template <typename TUse>
  unsigned int
  CountUses(VertexType vertex, const TUse & use) const
  {
    unsigned int triangles = 0;
    std::uint8_t uses[256] = {};
    for (unsigned int n = 0; n < m_NumberOfTriangles; ++n)
    {
      const auto & triangle = m_Triangles[n];
      if (triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex)
      {
        ++triangles;
        for (const VertexType end : triangle)
        {
          if (end != vertex && ++uses[end] == 3)
          {
            use(end);
          }
        }
      }
    }
    return triangles;
  }

  /** The crossings of the site's parts that break a condition, by the triangles found last. */
  unsigned int
  FindBroken() const
  {
    unsigned int broken = 0;
    m_Parts[Center].ForEachPart([this, &broken](unsigned int part) {
      const bool isPoint = (part & (part - 1)) == 0;
      const auto lowest = static_cast<unsigned int>(__builtin_ctz(part));
      broken |= !isPoint && this->Breaks(VertexOf(Center, lowest)) ? part : 0;
    });
    return broken;
  }

  /** Makes a point of one crossing of a part, where that leaves a part that breaks no condition, else of all. */
  void
  DividePart(unsigned int part)
  {
    const unsigned int lone = m_Parts[Center].lone;
    for (unsigned int left = part; left != 0; left &= left - 1)
    {
      const unsigned int point = left & ~(left - 1);
      if (GetStar().isDisk[part & ~point])
      {
        m_Parts[Center] = FCCSiteParts(m_Owned, lone | point);
        this->FindTriangles();
        if ((this->FindBroken() & part) == 0)
        {
          return;
        }
      }
    }
    m_Parts[Center] = FCCSiteParts(m_Owned, lone | part);
  }

  Neighborhood m_Sites;
  unsigned int m_Inside;
  unsigned int m_Split;
  unsigned int m_Owned{ 0 };
  FCCSiteParts m_Parts[Sites];
  std::uint8_t m_Owner[64];
  unsigned int m_NumberOfPolygons{ 0 };
  Polygon m_Polygons[24];
  unsigned int m_NumberOfTriangles{ 0 };
  std::array<VertexType, 3> m_Triangles[48];
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

void
FCCSplitSites::FindOwners(const FCCSigns & signs,
                          const ValueReader & readValues,
                          bool insideIsBelow,
                          const SizeValueType * sites,
                          SizeValueType count,
                          OwnersType * owners)
{
  std::transform(sites, sites + count, owners, [&](SizeValueType site) {
    return FindOwnersAround(signs, readValues, insideIsBelow, site);
  });
}

FCCSiteParts::FCCSiteParts(unsigned int allOwned, unsigned int allLone)
  : owned(allOwned)
  , lone(allLone)
{
  for (unsigned int left = lone; left != 0; left &= left - 1)
  {
    const auto direction = static_cast<unsigned int>(__builtin_ctz(left));
    lowest |= std::uint64_t{ direction } << (4 * direction);
  }
  this->ForEachPart([this](unsigned int part) {
    const auto first = static_cast<std::uint64_t>(__builtin_ctz(part));
    for (; part != 0; part &= part - 1)
    {
      lowest |= first << (4 * __builtin_ctz(part));
    }
  });
}

namespace
{

/** How many bits are set before bit \a i. */
std::size_t
CountBefore(const FCCSigns::WordType * bits, SizeValueType i)
{
  const SizeValueType words = i / FCCSigns::WordBits;
  const FCCSigns::WordType before = (FCCSigns::WordType{ 1 } << (i % FCCSigns::WordBits)) - 1;
  return std::accumulate(bits,
                         bits + words,
                         static_cast<std::size_t>(__builtin_popcountll(bits[words] & before)),
                         [](std::size_t sum, FCCSigns::WordType word) {
                           return sum + static_cast<std::size_t>(__builtin_popcountll(word));
                         });
}

} // namespace

const std::vector<FCCSiteParts> &
FCCSplitRows::GetParts(SizeValueType j, SizeValueType k) const
{
  static const std::vector<FCCSiteParts> none;
  const auto & row = m_Rows[k * m_Height + j];
  return row ? row->parts : none;
}

const FCCSiteParts &
FCCSplitRows::GetParts(SizeValueType i, SizeValueType j, SizeValueType k) const
{
  const Row & row = *m_Rows[k * m_Height + j];
  return row.parts[CountBefore(row.bits.data(), i)];
}

bool
FCCSplitRows::Set(SizeValueType i, SizeValueType j, SizeValueType k, const FCCSiteParts & parts)
{
  auto & row = m_Rows[k * m_Height + j];
  if (!row)
  {
    row = std::make_unique<Row>();
    row->bits.resize(m_Zeros.size());
  }
  FCCSigns::WordType & word = row->bits[i / FCCSigns::WordBits];
  const FCCSigns::WordType bit = FCCSigns::WordType{ 1 } << (i % FCCSigns::WordBits);
  const auto place = row->parts.begin() + static_cast<std::ptrdiff_t>(CountBefore(row->bits.data(), i));
  if ((word & bit) != 0)
  {
    *place = parts;
    return false;
  }
  row->parts.insert(place, parts);
  word |= bit;
  return true;
}

struct FCCSplitSites::SuspectsOfPlane
{
  struct Suspect
  {
    std::uint32_t place; ///< number in the plane
    OwnersType owners;
  };

  struct Divided
  {
    std::uint32_t place;
    FCCSiteParts parts;
    std::array<SizeValueType, 2> mostTriangles;
  };

  std::array<std::vector<Suspect>, ColorsOfPlane> ofColor;
  std::vector<Divided> divided;
};

FCCSplitSites::FCCSplitSites(const FCCSigns & signs)
  : m_Signs(signs)
  , m_Split(signs)
  , m_Suspects(signs.GetDepth())
{}

bool
FCCSplitSites::HasSuspects() const
{
  return std::any_of(m_Suspects.begin(), m_Suspects.end(), [](const auto & places) { return !places.empty(); });
}

void
FCCSplitSites::TakeSuspects(SizeValueType k,
                            const OwnersReader & ownersAround,
                            const FCCSurfaceExtraction::Crew & crew,
                            SuspectsOfPlane & suspects)
{
  std::vector<std::uint32_t> places;
  places.swap(m_Suspects[k]);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());

  constexpr std::size_t batch = 256;
  std::array<SizeValueType, batch> numbers;
  std::array<OwnersType, batch> owners;
  const SizeValueType width = m_Signs.GetWidth();
  for (std::size_t begin = 0; begin < places.size(); begin += batch)
  {
    crew.checkAbort();
    const std::size_t count = std::min(batch, places.size() - begin);
    std::transform(places.data() + begin, places.data() + begin + count, numbers.begin(), [&](std::uint32_t place) {
      return k * m_Signs.GetHeight() * width + place;
    });
    ownersAround(numbers.data(), count, owners.data());
    for (std::size_t n = 0; n < count; ++n)
    {
      const std::uint32_t place = places[begin + n];
      suspects.ofColor[(place % width & 1) | (place / width & 1) << 1].push_back({ place, owners[n] });
    }
  }
}

void
FCCSplitSites::DivideSuspects(SizeValueType k,
                              unsigned int colorInPlane,
                              const FCCSurfaceExtraction::Crew & crew,
                              SuspectsOfPlane & suspects)
{
  const SizeValueType sitesOfPlane = m_Signs.GetHeight() * m_Signs.GetWidth();
  std::vector<SuspectsOfPlane::Suspect> sites;
  sites.swap(suspects.ofColor[colorInPlane]);
  std::vector<SizeValueType> broken;
  for (std::size_t n = 0; n < sites.size(); ++n)
  {
    if (n % 64 == 0)
    {
      crew.checkAbort();
    }
    Surroundings surroundings(m_Signs, m_Split, sites[n].owners, k * sitesOfPlane + sites[n].place);
    if (surroundings.Divide())
    {
      suspects.divided.push_back({ sites[n].place, surroundings.GetParts(), surroundings.GetMostTriangles() });
      surroundings.ForEachBrokenNeighbor([&](SizeValueType neighbor) { broken.push_back(neighbor); });
    }
  }
  const std::lock_guard<std::mutex> lock(m_Mutex);
  for (const SizeValueType number : broken)
  {
    m_Suspects[number / sitesOfPlane].push_back(static_cast<std::uint32_t>(number % sitesOfPlane));
  }
}

void
FCCSplitSites::SetDivided(SizeValueType k, SuspectsOfPlane & suspects, std::vector<SizeValueType> & triangles)
{
  const SizeValueType width = m_Signs.GetWidth();
  std::vector<SuspectsOfPlane::Divided> divided;
  divided.swap(suspects.divided);
  for (const auto & [place, parts, mostTriangles] : divided)
  {
    const bool isNew = m_Split.Set(place % width, place / width, k, parts);
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
FCCSplitSites::Resolve(const OwnersReader & ownersAround,
                       const FCCSurfaceExtraction::Crew & crew,
                       std::vector<SizeValueType> & points,
                       std::vector<SizeValueType> & triangles)
{
  const SizeValueType depth = m_Signs.GetDepth();
  std::vector<SuspectsOfPlane> suspects(depth);
  for (float share = 0.75f; this->HasSuspects(); share *= 0.25f) // most are found in the first round
  {
    crew.forEach(depth, 0.2f * share, [&](SizeValueType k) { this->TakeSuspects(k, ownersAround, crew, suspects[k]); });
    // Planes of one parity are no neighbours.
    for (const SizeValueType parity : { 0, 1 })
    {
      const SizeValueType count = (depth + 1 - parity) / 2;
      for (unsigned int color = 0; color < ColorsOfPlane; ++color)
      {
        crew.forEach(count, 0.09f * share, [&](SizeValueType n) {
          this->DivideSuspects(2 * n + parity, color, crew, suspects[2 * n + parity]);
        });
        crew.forEach(count, 0.01f * share, [&](SizeValueType n) {
          this->SetDivided(2 * n + parity, suspects[2 * n + parity], triangles);
        });
      }
    }
  }
  crew.forEach(depth, 0.0f, [&](SizeValueType k) {
    for (SizeValueType j = 0; j < m_Signs.GetHeight(); ++j)
    {
      for (const FCCSiteParts & parts : m_Split.GetParts(j, k))
      {
        points[k] += FCCSiteStar::CountParts(parts.owned, parts.lone) - 1;
      }
    }
  });
}

} // namespace itk
