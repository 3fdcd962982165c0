#include "itkFCCLeanSurface.h"

#include "itkFCCClusterPoints.h"
#include "itkFCCLeanMarching.h"

#include <algorithm>
#include <utility>

namespace itk
{

FCCLeanSurface::FCCLeanSurface(const FCCSigns & signs, const FCCScalarField & field)
  : m_Signs(signs)
  , m_Field(field)
  , m_Splits(signs)
  , m_Remembered(field.isInMemory ? 0 : signs.GetDepth())
  , m_FirstPoint(signs.GetDepth() + 1)
  , m_FirstTriangle(signs.GetDepth() + 1)
  , m_Filled(signs.GetDepth())
{}

FCCFieldPlanes
FCCLeanSurface::MakePlanes() const
{
  const auto & size = m_Field.region.GetSize();
  return FCCFieldPlanes({ size[0], size[1], size[2] }, m_Signs.GetParity(0, 0), m_Field.readRow, 3, m_Field.scratch);
}

namespace
{

/** The planes around the one that is worked at: each is found once, from the one below it. */
class PlaneSequence
{
public:
  PlaneSequence(const FCCSigns & signs,
                FCCFieldPlanes & field,
                bool insideIsBelow,
                const FCCSplitSites * splits,
                std::pmr::memory_resource * scratch)
    : m_Signs(signs)
    , m_Field(field)
    , m_InsideIsBelow(insideIsBelow)
    , m_Splits(splits)
    , m_Planes{ FCCClusterPlane(signs, scratch), FCCClusterPlane(signs, scratch), FCCClusterPlane(signs, scratch) }
  {}

  /** Finds plane \a k, with vertices numbered from \a first on. Returns the number after the last. */
  std::uint32_t
  Find(SizeValueType k, std::uint32_t first = 0)
  {
    for (SizeValueType near = k; near < std::min(k + 2, m_Signs.GetDepth()); ++near)
    {
      m_Field.LoadValues(near);
    }
    return this->Get(k).Find(k, this->Get(k + m_Planes.size() - 1), m_Field, m_InsideIsBelow, m_Splits, first);
  }

  FCCClusterPlane &
  Get(SizeValueType k)
  {
    return m_Planes[k % m_Planes.size()];
  }

private:
  const FCCSigns & m_Signs;
  FCCFieldPlanes & m_Field;
  bool m_InsideIsBelow;
  const FCCSplitSites * m_Splits;
  std::array<FCCClusterPlane, 3> m_Planes;
};

/** The sites of a plane that break a condition of FCCSplitSites, and the first ends of edges that do, by a count of all
 * triangles at the plane's sites and edges. The counts are zero afterwards. */
std::vector<std::uint32_t>
TakeSuspects(const FCCSigns & signs, const FCCClusterPlane & plane, FCCTriangleUse & use)
{
  std::vector<std::uint32_t> suspects;
  constexpr std::uint64_t tooMany = 0xFCFCFCFCFCFCFC; // more than two; counts of edges are even
  constexpr std::uint64_t fewest = 3;
  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    const FCCSigns::WordType * const wholes = plane.GetWholes().GetRow(j);
    for (SizeValueType word = 0; word < signs.GetNumberOfWords(); ++word)
    {
      for (FCCSigns::WordType mask = wholes[word]; mask != 0; mask &= mask - 1)
      {
        const SizeValueType i = word * FCCSigns::WordBits + static_cast<SizeValueType>(__builtin_ctzll(mask));
        const std::uint64_t counts = std::exchange(use.counts[j * use.stride + i], 0);
        if ((counts & tooMany) != 0 || counts >> 56 < fewest || !FCCSiteStar::IsDisk(plane.GetOwned(j, i)))
        {
          suspects.push_back(static_cast<std::uint32_t>(j * signs.GetWidth() + i));
        }
      }
    }
  }
  return suspects;
}

} // namespace

void
FCCLeanSurface::Count(SizeValueType begin, SizeValueType end)
{
  FCCFieldPlanes field = this->MakePlanes();
  PlaneSequence planes(m_Signs, field, m_Field.insideIsBelow, nullptr, m_Field.scratch);
  const SizeValueType stride = m_Signs.GetNumberOfWords() * FCCSigns::WordBits + 1;
  const auto makeUse = [&] {
    return FCCTriangleUse{ stride, std::pmr::vector<std::uint64_t>(stride * m_Signs.GetHeight(), m_Field.scratch) };
  };
  std::array<FCCTriangleUse, 2> uses{ makeUse(), makeUse() };
  const auto useOf = [&uses](SizeValueType k) -> FCCTriangleUse & { return uses[k % uses.size()]; };

  // The triangles below the first plane use its sites and edges, too.
  const SizeValueType first = begin > 0 ? begin - 1 : 0;
  planes.Find(first);
  for (SizeValueType k = first; k < end; ++k)
  {
    planes.Find(k + 1);
    const bool isLast = k + 1 == m_Signs.GetDepth();
    const SizeValueType triangles =
      isLast ? 0 : CountTriangleUse(m_Signs, k, planes.Get(k), planes.Get(k + 1), useOf(k), useOf(k + 1));
    if (k >= begin)
    {
      m_FirstTriangle[k] = triangles;
      m_FirstPoint[k] = planes.Get(k).GetWholes().Count();
      m_Splits.Suspect(k, TakeSuspects(m_Signs, planes.Get(k), useOf(k)));
      if (!m_Field.isInMemory)
      {
        m_Remembered[k] = this->FindOwners(k, planes.Get(k), field);
      }
    }
    else
    {
      std::fill(useOf(k).counts.begin(), useOf(k).counts.end(), 0);
    }
  }
}

auto
FCCLeanSurface::FindOwners(SizeValueType k, const FCCClusterPlane & plane, const FCCFieldPlanes & field) const
  -> RememberedOwners
{
  const FCCSplitSites::ValueReader readValues =
    [&field](const std::array<SizeValueType, 3> * sites, unsigned int wanted, float * values) {
      for (; wanted != 0; wanted &= wanted - 1)
      {
        const auto n = static_cast<unsigned int>(__builtin_ctz(wanted));
        const auto [i, j, near] = sites[n];
        values[n] = field.GetValues(j, near)[i];
      }
    };
  const SizeValueType sitesOfPlane = m_Signs.GetHeight() * m_Signs.GetWidth();
  const SizeValueType count = plane.GetWholes().Count();
  std::vector<SizeValueType> sites;
  sites.reserve(count);
  RememberedOwners found{ {}, std::vector<FCCSplitSites::OwnersType>(count) };
  found.places.reserve(count);
  plane.GetWholes().ForEach([&](SizeValueType j, SizeValueType i) {
    const SizeValueType place = j * m_Signs.GetWidth() + i;
    sites.push_back(k * sitesOfPlane + place);
    found.places.push_back(static_cast<std::uint32_t>(place));
  });
  FCCSplitSites::FindOwners(m_Signs, readValues, m_Field.insideIsBelow, sites.data(), count, found.owners.data());
  return found;
}

void
FCCLeanSurface::RecallOwners(const SizeValueType * sites, SizeValueType count, FCCSplitSites::OwnersType * owners) const
{
  const SizeValueType sitesOfPlane = m_Signs.GetHeight() * m_Signs.GetWidth();
  std::transform(sites, sites + count, owners, [&](SizeValueType site) {
    const RememberedOwners & remembered = m_Remembered[site / sitesOfPlane];
    const auto & places = remembered.places;
    const auto place = std::lower_bound(places.begin(), places.end(), site % sitesOfPlane);
    return remembered.owners[static_cast<std::size_t>(place - places.begin())];
  });
}

void
FCCLeanSurface::Resolve(const Crew & crew)
{
  m_Splits.Resolve(
    [&](const SizeValueType * sites, SizeValueType count, FCCSplitSites::OwnersType * owners) {
      m_Field.isInMemory
        ? FCCSplitSites::FindOwners(m_Signs, m_Field.readValues, m_Field.insideIsBelow, sites, count, owners)
        : this->RecallOwners(sites, count, owners);
    },
    crew,
    m_FirstPoint,
    m_FirstTriangle);
  m_Remembered.clear();
  m_Remembered.shrink_to_fit();
  for (std::vector<SizeValueType> * const counts : { &m_FirstPoint, &m_FirstTriangle })
  {
    SizeValueType sum = 0;
    for (SizeValueType & count : *counts)
    {
      sum += std::exchange(count, sum);
    }
  }
  m_AreOutside.resize(m_Field.closed ? 0 : this->GetNumberOfPoints());
}

void
FCCLeanSurface::Fill(SizeValueType begin, SizeValueType end, TriangleSurface & surface)
{
  FCCFieldPlanes field = this->MakePlanes();
  PlaneSequence planes(m_Signs, field, m_Field.insideIsBelow, &m_Splits, m_Field.scratch);
  const FCCClusterPoints clusterPoints(m_Field.region, m_Field.frame, m_Field.minimumFraction);
  const bool reversed = m_Field.frame.IsLeftHanded();
  std::vector<std::uint8_t> blocks;
  const auto loadAround = [&](SizeValueType k) {
    if (!surface.HasNormals())
    {
      if (field.IsReal(2, k))
      {
        field.LoadCoefficientsAround(k);
      }
      return;
    }
    for (SizeValueType near = k > 0 ? k - 1 : 0; near < std::min(k + 2, m_Signs.GetDepth()); ++near)
    {
      if (!field.HasGradients(near))
      {
        FindBorderBlocks(m_Signs, near, FCCRowKernels::Block, field.GetNumberOfBlocks(), 0, blocks);
        field.LoadGradients(near, blocks);
      }
    }
  };

  if (begin > 0)
  {
    planes.Find(begin - 1);
  }
  TriangleSurface::TriangleType * const triangles = surface.GetTriangles().data() + m_FirstTriangle[begin];
  SizeValueType filled = 0;
  planes.Find(begin, static_cast<std::uint32_t>(m_FirstPoint[begin]));
  for (SizeValueType k = begin; k < end; ++k)
  {
    planes.Find(k + 1, static_cast<std::uint32_t>(m_FirstPoint[k + 1]));
    loadAround(k);
    clusterPoints.Place(m_Signs,
                        planes.Get(k),
                        k,
                        field,
                        surface.GetPoints().data() + m_FirstPoint[k],
                        surface.HasNormals() ? surface.GetNormals().data() + m_FirstPoint[k] : nullptr,
                        m_Field.closed ? nullptr : m_AreOutside.data() + m_FirstPoint[k]);
    if (k + 1 < m_Signs.GetDepth())
    {
      filled += FillLeanTriangles(m_Signs, k, planes.Get(k), planes.Get(k + 1), reversed, triangles + filled);
    }
  }
  m_Filled[begin] = filled;
}

void
FCCLeanSurface::Finish(TriangleSurface & surface)
{
  auto & triangles = surface.GetTriangles();
  auto end = triangles.begin();
  for (SizeValueType k = 0; k < m_Signs.GetDepth(); ++k)
  {
    const auto first = triangles.begin() + static_cast<std::ptrdiff_t>(m_FirstTriangle[k]);
    const auto last = first + static_cast<std::ptrdiff_t>(m_Filled[k]);
    end = first == end ? last : std::copy(first, last, end);
  }
  if (!m_Field.closed)
  {
    end = std::remove_if(triangles.begin(), end, [this](const TriangleSurface::TriangleType & triangle) {
      return (m_AreOutside[triangle[0]] | m_AreOutside[triangle[1]] | m_AreOutside[triangle[2]]) != 0;
    });
  }
  triangles.erase(end, triangles.end());
}

} // namespace itk
