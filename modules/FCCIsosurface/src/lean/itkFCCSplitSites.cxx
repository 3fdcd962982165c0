#include "itkFCCSplitSites.h"

#include <algorithm>
#include <array>

namespace itk
{

struct FCCSplitSites::SuspectsOfPlane
{
  struct Suspect
  {
    std::uint32_t number; ///< in the plane
    FCCStarReader::Star star;
  };

  struct Divided
  {
    std::uint32_t number;
    FCCSiteParts parts;
    std::array<SizeValueType, 2> mostTriangles;
  };

  std::array<std::vector<Suspect>, ColorsOfPlane> ofColor;
  std::vector<Divided> divided;
};

FCCSplitSites::FCCSplitSites(const FCCSigns & signs, std::pmr::memory_resource * scratch)
  : m_Signs(signs)
  , m_Scratch(scratch)
  , m_Split(signs)
  , m_Suspects(signs.GetDepth())
{}

bool
FCCSplitSites::HasSuspects() const
{
  return std::any_of(m_Suspects.begin(), m_Suspects.end(), [](const auto & sites) { return !sites.empty(); });
}

void
FCCSplitSites::TakeSuspects(SizeValueType k,
                            const std::array<const FCCNearerEnds *, 3> & nearerEnds,
                            SuspectsOfPlane & suspects)
{
  std::vector<std::uint32_t> numbers;
  numbers.swap(m_Suspects[k]);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  const auto width = static_cast<std::uint32_t>(m_Signs.GetWidth());
  for (auto number = numbers.begin(); number != numbers.end();)
  {
    const std::uint32_t j = *number / width;
    const FCCStarReader stars(m_Signs, nearerEnds, j, k);
    for (; number != numbers.end() && *number < (j + 1) * width; ++number)
    {
      const std::uint32_t i = *number - j * width;
      suspects.ofColor[(i & 1) | (j & 1) << 1].push_back({ *number, stars.Read(i) });
    }
  }
}

/** Takes the suspects of a few planes, whose nearer ends are unpacked one after the other. */
void
FCCSplitSites::TakeSuspectsOfSlab(SizeValueType begin,
                                  SizeValueType end,
                                  const std::vector<FCCNearerEnds::Packed> & nearerEnds,
                                  const FCCSurfaceExtractor::Crew & crew,
                                  std::vector<SuspectsOfPlane> & suspects)
{
  std::array<FCCNearerEnds, 3> planes{ FCCNearerEnds(m_Signs, m_Scratch),
                                       FCCNearerEnds(m_Signs, m_Scratch),
                                       FCCNearerEnds(m_Signs, m_Scratch) };
  SizeValueType unpacked = 0; // planes below this one
  for (SizeValueType k = begin; k < end; ++k)
  {
    if (m_Suspects[k].empty())
    {
      continue;
    }
    crew.checkAbort();
    for (unpacked = std::max(unpacked, k - std::min<SizeValueType>(k, 1));
         unpacked < std::min(k + 2, m_Signs.GetDepth());
         ++unpacked)
    {
      planes[unpacked % 3].Unpack(unpacked, nearerEnds[unpacked]);
    }
    this->TakeSuspects(k, { &planes[(k + 2) % 3], &planes[k % 3], &planes[(k + 1) % 3] }, suspects[k]);
  }
}

void
FCCSplitSites::DivideSuspects(SizeValueType k,
                              unsigned int color,
                              const FCCSurfaceExtractor::Crew & crew,
                              SuspectsOfPlane & suspects)
{
  const auto width = static_cast<std::uint32_t>(m_Signs.GetWidth());
  std::vector<SuspectsOfPlane::Suspect> sites;
  sites.swap(suspects.ofColor[color]);
  std::vector<std::array<SizeValueType, 3>> broken;
  for (std::size_t n = 0; n < sites.size(); ++n)
  {
    if (n % 64 == 0)
    {
      crew.checkAbort();
    }
    FCCSiteDivision division(m_Signs, m_Split, sites[n].star, { sites[n].number % width, sites[n].number / width, k });
    if (division.Divide())
    {
      suspects.divided.push_back({ sites[n].number, division.GetParts(), division.GetMostTriangles() });
      division.ForEachBrokenNeighbor([&](const auto & neighbor) { broken.push_back(neighbor); });
    }
  }
  const std::lock_guard<std::mutex> lock(m_Mutex);
  for (const auto [i, j, plane] : broken)
  {
    m_Suspects[plane].push_back(static_cast<std::uint32_t>(j * width + i));
  }
}

void
FCCSplitSites::SetDivided(SizeValueType k, SuspectsOfPlane & suspects, std::vector<SizeValueType> & triangles)
{
  const SizeValueType width = m_Signs.GetWidth();
  std::vector<SuspectsOfPlane::Divided> divided;
  divided.swap(suspects.divided);
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
                       const FCCSurfaceExtractor::Crew & crew,
                       std::vector<SizeValueType> & points,
                       std::vector<SizeValueType> & triangles)
{
  const SizeValueType depth = m_Signs.GetDepth();
  const SizeValueType slabs = (depth + PlanesOfSlab - 1) / PlanesOfSlab;
  std::vector<SuspectsOfPlane> suspects(depth);
  for (float share = 0.75f; this->HasSuspects(); share *= 0.25f) // most are found in the first round
  {
    crew.forEach(slabs, 0.2f * share, [&](SizeValueType slab) {
      const SizeValueType begin = slab * PlanesOfSlab;
      this->TakeSuspectsOfSlab(begin, std::min(begin + PlanesOfSlab, depth), nearerEnds, crew, suspects);
    });
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
        points[k] += parts.GetNumberOfVertices() - 1;
      }
    }
  });
}

} // namespace itk
