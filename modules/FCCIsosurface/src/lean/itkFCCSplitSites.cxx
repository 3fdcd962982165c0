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
    FCCNearerEndsOfStar nearerEnds;
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

FCCSplitSites::FCCSplitSites(const FCCSigns & signs)
  : m_Signs(signs)
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
                            const NearerEndsReader & readNearerEnds,
                            const FCCSurfaceExtractor::Crew & crew,
                            SuspectsOfPlane & suspects)
{
  std::vector<std::uint32_t> numbers;
  numbers.swap(m_Suspects[k]);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());

  constexpr std::size_t batch = 256;
  std::array<SizeValueType, batch> sites;
  std::array<FCCNearerEndsOfStar, batch> nearerEnds;
  const SizeValueType width = m_Signs.GetWidth();
  for (std::size_t begin = 0; begin < numbers.size(); begin += batch)
  {
    crew.checkAbort();
    const std::size_t count = std::min(batch, numbers.size() - begin);
    std::transform(numbers.data() + begin, numbers.data() + begin + count, sites.begin(), [&](std::uint32_t number) {
      return k * m_Signs.GetHeight() * width + number;
    });
    readNearerEnds(sites.data(), count, nearerEnds.data());
    for (std::size_t n = 0; n < count; ++n)
    {
      const std::uint32_t number = numbers[begin + n];
      suspects.ofColor[(number % width & 1) | (number / width & 1) << 1].push_back({ number, nearerEnds[n] });
    }
  }
}

void
FCCSplitSites::DivideSuspects(SizeValueType k,
                              unsigned int color,
                              const FCCSurfaceExtractor::Crew & crew,
                              SuspectsOfPlane & suspects)
{
  const SizeValueType sitesOfPlane = m_Signs.GetHeight() * m_Signs.GetWidth();
  std::vector<SuspectsOfPlane::Suspect> sites;
  sites.swap(suspects.ofColor[color]);
  std::vector<SizeValueType> broken;
  for (std::size_t n = 0; n < sites.size(); ++n)
  {
    if (n % 64 == 0)
    {
      crew.checkAbort();
    }
    FCCSiteDivision division(m_Signs, m_Split, sites[n].nearerEnds, k * sitesOfPlane + sites[n].number);
    if (division.Divide())
    {
      suspects.divided.push_back({ sites[n].number, division.GetParts(), division.GetMostTriangles() });
      division.ForEachBrokenNeighbor([&](SizeValueType neighbor) { broken.push_back(neighbor); });
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
FCCSplitSites::Resolve(const NearerEndsReader & readNearerEnds,
                       const FCCSurfaceExtractor::Crew & crew,
                       std::vector<SizeValueType> & points,
                       std::vector<SizeValueType> & triangles)
{
  const SizeValueType depth = m_Signs.GetDepth();
  std::vector<SuspectsOfPlane> suspects(depth);
  for (float share = 0.75f; this->HasSuspects(); share *= 0.25f) // most are found in the first round
  {
    crew.forEach(
      depth, 0.2f * share, [&](SizeValueType k) { this->TakeSuspects(k, readNearerEnds, crew, suspects[k]); });
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
