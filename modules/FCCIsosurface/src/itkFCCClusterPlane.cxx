#include "itkFCCClusterPlane.h"

#include <algorithm>

namespace itk
{
namespace
{

using WordType = FCCSigns::WordType;

/** Writes or adds the bits of a row moved by -1, 0 or 1 sites. Rows end in a spare word. */
void
MoveBits(const WordType * row, SizeValueType words, IndexValueType by, WordType * moved)
{
  switch (by)
  {
    case 0:
      std::copy(row, row + words, moved);
      break;
    case 1:
      moved[0] = row[0] << 1;
      for (SizeValueType word = 1; word < words; ++word)
      {
        moved[word] = row[word] << 1 | row[word - 1] >> (FCCSigns::WordBits - 1);
      }
      break;
    default:
      for (SizeValueType word = 0; word < words; ++word)
      {
        moved[word] = row[word] >> 1 | row[word + 1] << (FCCSigns::WordBits - 1);
      }
  }
}

} // namespace

std::uint32_t
FCCNumberedBits::Number(std::uint32_t first)
{
  for (SizeValueType word = 0; word < m_Bits.size(); ++word)
  {
    m_Before[word] = first;
    first += static_cast<std::uint32_t>(__builtin_popcountll(m_Bits[word]));
  }
  return first;
}

void
FCCNumberedBits::Clear()
{
  std::fill(m_Bits.begin(), m_Bits.end(), 0);
}

FCCClusterPlane::FCCClusterPlane(const FCCSigns & signs)
  : m_Signs(&signs)
  , m_Owners(signs)
  , m_Owned(signs.GetHeight() * Directions * m_Owners.GetStride())
  , m_Clusters(signs.GetHeight(), signs.GetNumberOfWords())
  , m_Singles(signs.GetHeight() * Types, signs.GetNumberOfWords())
{}

std::uint32_t
FCCClusterPlane::Find(SizeValueType k,
                      const FCCClusterPlane & below,
                      const FCCFieldPlanes & field,
                      bool insideIsBelow,
                      const FCCSigns * split,
                      std::uint32_t first)
{
  m_Owners.Find(k, field, insideIsBelow);
  m_Clusters.Clear();
  if (k < m_Signs->GetDepth())
  {
    for (SizeValueType j = 0; j < m_Signs->GetHeight(); ++j)
    {
      this->FindOwned(j, k, below);
      WordType * const clusters = m_Clusters.GetRow(j);
      for (unsigned int direction = 0; direction < Directions; ++direction)
      {
        const WordType * const owned = this->GetOwnedRow(j, direction);
        for (SizeValueType word = 0; word < m_Signs->GetNumberOfWords(); ++word)
        {
          clusters[word] |= owned[word];
        }
      }
    }
  }
  if (split == nullptr)
  {
    return first;
  }
  m_Singles.Clear();
  if (k < m_Signs->GetDepth())
  {
    for (SizeValueType j = 0; j < m_Signs->GetHeight(); ++j)
    {
      WordType * const clusters = m_Clusters.GetRow(j);
      const WordType * const splitRow = split->GetRow(j, k);
      for (SizeValueType word = 0; word < m_Signs->GetNumberOfWords(); ++word)
      {
        clusters[word] &= ~splitRow[word];
      }
      this->FindSingles(j, k, *split);
    }
  }
  return m_Singles.Number(m_Clusters.Number(first));
}

void
FCCClusterPlane::FindOwned(SizeValueType j, SizeValueType k, const FCCClusterPlane & below)
{
  const SizeValueType words = m_Signs->GetNumberOfWords();
  for (std::uint8_t type = 0; type < Types; ++type)
  {
    const WordType * const first = m_Owners.GetFirst(j, type);
    std::copy(first, first + words, m_Owned.data() + (j * Directions + type) * m_Owners.GetStride());

    WordType * const owned = m_Owned.data() + (j * Directions + Types + type) * m_Owners.GetStride();
    const auto & step = FCCLattice::OwnedEdges[type];
    const SizeValueType fromJ = j - static_cast<SizeValueType>(step[1]);
    if (fromJ >= m_Signs->GetHeight() || (step[2] == 1 && k == 0))
    {
      std::fill(owned, owned + words, 0);
      continue;
    }
    const FCCCrossingOwners & owners = step[2] == 1 ? below.m_Owners : m_Owners;
    const auto offset =
      FCCLattice::OffsetOf(step, m_Signs->GetParity(fromJ, k - static_cast<SizeValueType>(step[2])))[0];
    MoveBits(owners.GetSecond(fromJ, type), words, offset, owned);
  }
}

/** Crossings of the edges that a row stores whose owners are split. */
void
FCCClusterPlane::FindSingles(SizeValueType j, SizeValueType k, const FCCSigns & split)
{
  const SizeValueType words = m_Signs->GetNumberOfWords();
  const WordType * const here = split.GetRow(j, k);
  for (std::uint8_t type = 0; type < Types; ++type)
  {
    const auto & step = FCCLattice::OwnedEdges[type];
    const SizeValueType otherJ = j + static_cast<SizeValueType>(step[1]);
    const SizeValueType otherK = k + static_cast<SizeValueType>(step[2]);
    if (otherJ >= m_Signs->GetHeight() || otherK >= m_Signs->GetDepth())
    {
      continue;
    }
    WordType * const singles = m_Singles.GetRow(j * Types + type);
    const auto offset = FCCLattice::OffsetOf(step, m_Signs->GetParity(j, k))[0];
    MoveBits(split.GetRow(otherJ, otherK), words, -offset, singles);
    const WordType * const first = m_Owners.GetFirst(j, type);
    const WordType * const second = m_Owners.GetSecond(j, type);
    for (SizeValueType word = 0; word < words; ++word)
    {
      singles[word] = (first[word] & here[word]) | (second[word] & singles[word]);
    }
  }
}

unsigned int
FCCClusterPlane::GetOwned(SizeValueType j, SizeValueType i) const
{
  const SizeValueType word = i / FCCSigns::WordBits;
  const SizeValueType bit = i % FCCSigns::WordBits;
  const WordType * row = this->GetOwnedRow(j, 0) + word;
  unsigned int owned = 0;
  for (unsigned int direction = 0; direction < Directions; ++direction)
  {
    owned |= static_cast<unsigned int>(row[direction * m_Owners.GetStride()] >> bit & 1) << direction;
  }
  return owned;
}

} // namespace itk
