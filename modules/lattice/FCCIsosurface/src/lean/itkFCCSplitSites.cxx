#include "itkFCCSplitSites.h"

#include <algorithm>
#include <array>

namespace itk
{

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
