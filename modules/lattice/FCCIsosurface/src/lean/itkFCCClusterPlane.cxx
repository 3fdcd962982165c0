#include "itkFCCClusterPlane.h"

namespace itk
{

FCCClusterPlane::FCCClusterPlane(const FCCSigns & signs, std::pmr::memory_resource * scratch)
  : m_Signs(&signs)
  , m_NearerEnds(signs, scratch)
  , m_Crossings(signs.GetHeight() * Directions, signs.GetNumberOfWords(), scratch)
  , m_SplitCrossings(signs.GetHeight() * Types, signs.GetNumberOfWords(), scratch)
  , m_WholeSites(signs.GetHeight(), signs.GetNumberOfWords(), scratch)
  , m_Split(signs.GetHeight(), signs.GetNumberOfWords(), scratch)
{}

std::uint32_t
FCCClusterPlane::Find(SizeValueType k, const FCCClusterPlane & below, const FCCSplitRows * splits, std::uint32_t first)
{
  m_WholeSites.Clear();
  m_Split.Clear();
  m_SplitSites.clear();
  const SizeValueType words = m_Signs->GetNumberOfWords();
  for (SizeValueType j = 0; j < m_Signs->GetHeight(); ++j)
  {
    this->FindCrossings(j, k, below);
    WordType * const wholeSites = m_WholeSites.GetRow(j);
    if (splits != nullptr)
    {
      const WordType * const splitSites = splits->GetRow(j, k);
      std::copy(splitSites, splitSites + words, m_Split.GetRow(j));
      for (SizeValueType word = 0; word < words; ++word)
      {
        wholeSites[word] &= ~splitSites[word];
      }
      this->FindSplitCrossings(j, k, *splits);
    }
  }
  return splits == nullptr ? first : this->NumberSplitSites(k, *splits, m_WholeSites.Number(first));
}

std::uint32_t
FCCClusterPlane::NumberSplitSites(SizeValueType k, const FCCSplitRows & splits, std::uint32_t first)
{
  m_Split.Number(0);
  for (SizeValueType j = 0; j < m_Signs->GetHeight(); ++j)
  {
    const FCCSiteParts * parts = splits.GetParts(j, k).data();
    FCCBits::ForEach(m_Split.GetRow(j), m_Signs->GetNumberOfWords(), [&](SizeValueType i) {
      m_SplitSites.push_back({ static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), *parts, first });
      first += parts->GetNumberOfVertices();
      ++parts;
    });
  }
  return first;
}

/** Gathers for each direction the crossings that sites of a row are nearer to, and the sites that have any. */
void
FCCClusterPlane::FindCrossings(SizeValueType j, SizeValueType k, const FCCClusterPlane & below)
{
  const SizeValueType words = m_Signs->GetNumberOfWords();
  WordType * const sites = m_WholeSites.GetRow(j);
  for (std::uint8_t type = 0; type < Types; ++type)
  {
    const WordType * const starts = m_NearerEnds.GetStarts(j, type);
    WordType * const stored = m_Crossings.GetRow(j * Directions + type);
    for (SizeValueType word = 0; word < words; ++word)
    {
      stored[word] = starts[word];
      sites[word] |= starts[word];
    }

    const SizeValueType opposite = j * Directions + FCCCells::OppositeOf(type);
    const FCCStepTarget start(*m_Signs, j, k, FCCCells::StepOf(FCCCells::OppositeOf(type)));
    if (!start.isInBox)
    {
      m_Crossings.ClearRow(opposite);
      continue;
    }
    WordType * const crossings = m_Crossings.GetRow(opposite);
    FCCBits::ForEachShifted((start.k == k ? *this : below).m_NearerEnds.GetEnds(start.j, type),
                            words,
                            start.shift,
                            [crossings, sites](SizeValueType word, WordType bits) {
                              crossings[word] = bits;
                              sites[word] |= bits;
                            });
  }
}

void
FCCClusterPlane::FindSplitCrossings(SizeValueType j, SizeValueType k, const FCCSplitRows & splits)
{
  const SizeValueType words = m_Signs->GetNumberOfWords();
  const WordType * const splitStarts = splits.GetRow(j, k);
  for (std::uint8_t type = 0; type < Types; ++type)
  {
    const FCCStepTarget end(*m_Signs, j, k, FCCLattice::OwnedEdges[type]);
    if (!end.isInBox || !(splits.HasSplitSites(j, k) || splits.HasSplitSites(end.j, end.k)))
    {
      m_SplitCrossings.ClearRow(j * Types + type);
      continue;
    }
    const WordType * const starts = m_NearerEnds.GetStarts(j, type);
    const WordType * const ends = m_NearerEnds.GetEnds(j, type);
    WordType * const crossings = m_SplitCrossings.GetRow(j * Types + type);
    FCCBits::ForEachShifted(splits.GetRow(end.j, end.k), words, end.shift, [&](SizeValueType word, WordType splitEnds) {
      crossings[word] = (starts[word] & splitStarts[word]) | (ends[word] & splitEnds);
    });
  }
}

} // namespace itk
