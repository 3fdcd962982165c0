#include "itkFCCLeanExtractor.h"

#include "itkFCCClusterPoints.h"
#include "itkFCCLeanMarching.h"

#include <algorithm>
#include <utility>

namespace itk
{

FCCLeanExtractor::FCCLeanExtractor(const FCCSigns & signs, const FCCScalarField & field)
  : m_Signs(signs)
  , m_Field(field)
  , m_Splits(signs)
  , m_Remembered(field.isInMemory ? 0 : signs.GetDepth())
  , m_FirstPoint(signs.GetDepth() + 1)
  , m_FirstTriangle(signs.GetDepth() + 1)
  , m_Filled(signs.GetDepth())
{}

namespace
{

/** Three consecutive planes. Each is found once, from the one below it. */
class PlaneSequence
{
public:
  PlaneSequence(const FCCSigns & signs,
                FCCFieldPlanes & field,
                bool insideIsBelow,
                const FCCSplitRows * splits,
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
  const FCCSplitRows * m_Splits;
  std::array<FCCClusterPlane, 3> m_Planes;
};

/** The sites of a plane that break a condition of FCCSplitSites, and the starts of edges that do, by a count of all
 * triangles at the plane's sites and edges. The counts are zero afterwards. */
std::vector<std::uint32_t>
TakeSuspects(const FCCSigns & signs, const FCCClusterPlane & plane, FCCTriangleUse & use)
{
  std::vector<std::uint32_t> suspects;
  const FCCSiteStar & star = FCCSiteStar::Get();
  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    FCCBits::ForEach(plane.GetWholeSites().GetRow(j), signs.GetNumberOfWords(), [&](SizeValueType i) {
      if (FCCTriangleUse::BreakCondition(use.Take(j, i)) || !star.IsDisk(plane.GetCrossings(j, i)))
      {
        suspects.push_back(static_cast<std::uint32_t>(j * signs.GetWidth() + i));
      }
    });
  }
  return suspects;
}

} // namespace

void
FCCLeanExtractor::Count(SizeValueType begin, SizeValueType end)
{
  FCCFieldPlanes field(m_Signs, m_Field, 3);
  PlaneSequence planes(m_Signs, field, m_Field.insideIsBelow, nullptr, m_Field.scratch);
  std::array<FCCTriangleUse, 2> uses{ FCCTriangleUse(m_Signs, m_Field.scratch),
                                      FCCTriangleUse(m_Signs, m_Field.scratch) };
  const auto useOf = [&uses](SizeValueType k) -> FCCTriangleUse & { return uses[k % uses.size()]; };

  // The triangles below the first plane use its sites and edges, too.
  const SizeValueType first = begin > 0 ? begin - 1 : 0;
  planes.Find(first);
  for (SizeValueType k = first; k < end; ++k)
  {
    planes.Find(k + 1);
    const bool isLast = k + 1 == m_Signs.GetDepth();
    const SizeValueType triangles =
      isLast ? 0 : CountTriangleUse({ m_Signs, k, planes.Get(k), planes.Get(k + 1) }, useOf(k), useOf(k + 1));
    if (k >= begin)
    {
      m_FirstTriangle[k] = triangles;
      m_FirstPoint[k] = planes.Get(k).GetWholeSites().Count();
      m_Splits.Suspect(k, TakeSuspects(m_Signs, planes.Get(k), useOf(k)));
      if (!m_Field.isInMemory)
      {
        m_Remembered[k] = this->Remember(k, planes.Get(k), field);
      }
    }
    else
    {
      useOf(k).Clear();
    }
  }
}

auto
FCCLeanExtractor::Remember(SizeValueType k, const FCCClusterPlane & plane, const FCCFieldPlanes & field) const
  -> RememberedPlane
{
  const FCCScalarField::ValueReader readValues =
    [&field](const std::array<SizeValueType, 3> * sites, unsigned int wanted, float * values) {
      for (; wanted != 0; wanted &= wanted - 1)
      {
        const auto n = static_cast<unsigned int>(__builtin_ctz(wanted));
        const auto [i, j, near] = sites[n];
        values[n] = field.GetValues(j, near)[i];
      }
    };
  const SizeValueType sitesOfPlane = m_Signs.GetHeight() * m_Signs.GetWidth();
  const SizeValueType count = plane.GetWholeSites().Count();
  RememberedPlane remembered;
  remembered.sites.reserve(count);
  remembered.nearerEnds.reserve(count);
  for (SizeValueType j = 0; j < m_Signs.GetHeight(); ++j)
  {
    FCCBits::ForEach(plane.GetWholeSites().GetRow(j), m_Signs.GetNumberOfWords(), [&](SizeValueType i) {
      const SizeValueType site = j * m_Signs.GetWidth() + i;
      remembered.sites.push_back(static_cast<std::uint32_t>(site));
      remembered.nearerEnds.push_back(
        FindNearerEndsOfStar(m_Signs, readValues, m_Field.insideIsBelow, k * sitesOfPlane + site));
    });
  }
  return remembered;
}

void
FCCLeanExtractor::ReadNearerEnds(const SizeValueType * sites,
                                 SizeValueType count,
                                 FCCNearerEndsOfStar * nearerEnds) const
{
  const SizeValueType sitesOfPlane = m_Signs.GetHeight() * m_Signs.GetWidth();
  std::transform(sites, sites + count, nearerEnds, [&](SizeValueType site) {
    if (m_Field.isInMemory)
    {
      return FindNearerEndsOfStar(m_Signs, m_Field.readValues, m_Field.insideIsBelow, site);
    }
    const RememberedPlane & plane = m_Remembered[site / sitesOfPlane];
    const auto found = std::lower_bound(plane.sites.begin(), plane.sites.end(), site % sitesOfPlane);
    return plane.nearerEnds[static_cast<std::size_t>(found - plane.sites.begin())];
  });
}

void
FCCLeanExtractor::Resolve(const Crew & crew)
{
  m_Splits.Resolve([this](const SizeValueType * sites,
                          SizeValueType count,
                          FCCNearerEndsOfStar * nearerEnds) { this->ReadNearerEnds(sites, count, nearerEnds); },
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
FCCLeanExtractor::Fill(SizeValueType begin, SizeValueType end, TriangleSurface & surface)
{
  FCCFieldPlanes field(m_Signs, m_Field, 3);
  PlaneSequence planes(m_Signs, field, m_Field.insideIsBelow, &m_Splits.GetRows(), m_Field.scratch);
  const FCCClusterPoints clusterPoints(m_Field.region, m_Field.frame, m_Field.minimumFraction);
  const bool reversed = m_Field.frame.IsLeftHanded();
  const SizeValueType around = surface.HasNormals() ? 1 : 0; // planes whose gradients are needed
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
    for (SizeValueType near = k - std::min(k, around); near < std::min(k + around + 1, m_Signs.GetDepth()); ++near)
    {
      field.LoadGradients(near);
    }
    clusterPoints.Place(m_Signs,
                        planes.Get(k),
                        k,
                        field,
                        surface.GetPoints().data() + m_FirstPoint[k],
                        surface.HasNormals() ? surface.GetNormals().data() + m_FirstPoint[k] : nullptr,
                        m_Field.closed ? nullptr : m_AreOutside.data() + m_FirstPoint[k]);
    if (k + 1 < m_Signs.GetDepth())
    {
      filled += FillLeanTriangles({ m_Signs, k, planes.Get(k), planes.Get(k + 1) }, reversed, triangles + filled);
    }
  }
  m_Filled[begin] = filled;
}

void
FCCLeanExtractor::Finish(TriangleSurface & surface)
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
