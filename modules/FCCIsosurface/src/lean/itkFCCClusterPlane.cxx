#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkFCCClusterPlane.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkFCCClusterPlane.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{
namespace
{

SizeValueType
CountBits(const FCCSigns::WordType * bits, SizeValueType words)
{
  SizeValueType count = 0;
  for (SizeValueType word = 0; word < words; ++word)
  {
    count += static_cast<SizeValueType>(__builtin_popcountll(bits[word]));
  }
  return count;
}

std::uint32_t
NumberBits(const FCCSigns::WordType * bits, SizeValueType words, std::uint32_t first, std::uint32_t * before)
{
  for (SizeValueType word = 0; word < words; ++word)
  {
    before[word] = first;
    first += static_cast<std::uint32_t>(__builtin_popcountll(bits[word]));
  }
  return first;
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace itk
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace itk
{
namespace
{

HWY_EXPORT(CountBits);
HWY_EXPORT(NumberBits);

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
  return HWY_DYNAMIC_DISPATCH(NumberBits)(m_Bits.data(), m_Bits.size(), first, m_Before.data());
}

SizeValueType
FCCNumberedBits::Count() const
{
  return HWY_DYNAMIC_DISPATCH(CountBits)(m_Bits.data(), m_Bits.size());
}

void
FCCNumberedBits::Clear()
{
  std::fill(m_Bits.begin(), m_Bits.end(), 0);
}

FCCClusterPlane::FCCClusterPlane(const FCCSigns & signs, std::pmr::memory_resource * scratch)
  : m_Signs(&signs)
  , m_Owners(signs, scratch)
  , m_Owned(signs.GetHeight() * Directions * m_Owners.GetStride(), scratch)
  , m_SplitCrossings(signs.GetHeight() * Types * m_Owners.GetStride() + FCCSigns::WordsBeyond, scratch)
  , m_Wholes(signs.GetHeight(), signs.GetNumberOfWords(), scratch)
  , m_Split(signs.GetHeight(), signs.GetNumberOfWords(), scratch)
{}

std::uint32_t
FCCClusterPlane::Find(SizeValueType k,
                      const FCCClusterPlane & below,
                      const FCCFieldPlanes & field,
                      bool insideIsBelow,
                      const FCCSplitSites * splits,
                      std::uint32_t first)
{
  m_Owners.Find(k, field, insideIsBelow);
  m_Wholes.Clear();
  m_Split.Clear();
  if (k < m_Signs->GetDepth())
  {
    for (SizeValueType j = 0; j < m_Signs->GetHeight(); ++j)
    {
      this->FindOwned(j, k, below);
      WordType * const wholes = m_Wholes.GetRow(j);
      for (unsigned int direction = 0; direction < Directions; ++direction)
      {
        const WordType * const owned = this->GetOwnedRow(j, direction);
        for (SizeValueType word = 0; word < m_Signs->GetNumberOfWords(); ++word)
        {
          wholes[word] |= owned[word];
        }
      }
      if (splits != nullptr)
      {
        WordType * const split = m_Split.GetRow(j);
        const WordType * const splitSites = splits->GetRow(j, k);
        for (SizeValueType word = 0; word < m_Signs->GetNumberOfWords(); ++word)
        {
          split[word] = wholes[word] & splitSites[word];
          wholes[word] &= ~splitSites[word];
        }
        this->FindSplitCrossings(j, k, *splits);
      }
    }
  }
  return splits == nullptr ? first : this->NumberParts(k, *splits, m_Wholes.Number(first));
}

std::uint32_t
FCCClusterPlane::NumberParts(SizeValueType k, const FCCSplitSites & splits, std::uint32_t first)
{
  m_Split.Number(0);
  m_Parts.clear();
  for (SizeValueType j = 0; j < m_Signs->GetHeight(); ++j)
  {
    for (SizeValueType word = 0; word < m_Signs->GetNumberOfWords(); ++word)
    {
      for (WordType mask = m_Split.GetRow(j)[word]; mask != 0; mask &= mask - 1)
      {
        const SizeValueType i = word * FCCSigns::WordBits + static_cast<SizeValueType>(__builtin_ctzll(mask));
        Parts parts{ i, j, this->GetOwned(j, i), splits.GetLone(i, j, k), 0, first, 0 };
        for (unsigned int left = parts.owned; left != 0; ++first)
        {
          const auto lowest = static_cast<unsigned int>(__builtin_ctz(left));
          const bool isLone = (parts.lone >> lowest & 1) != 0;
          const unsigned int part = isLone ? 1U << lowest : FCCSiteStar::PartOf(parts.owned & ~parts.lone, lowest);
          for (unsigned int members = part; members != 0; members &= members - 1)
          {
            parts.place |= std::uint64_t{ first - parts.first } << (4 * __builtin_ctz(members));
          }
          parts.lowest |= 1U << lowest;
          left &= ~part;
        }
        m_Parts.push_back(parts);
      }
    }
  }
  return first;
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

void
FCCClusterPlane::FindSplitCrossings(SizeValueType j, SizeValueType k, const FCCSplitSites & splits)
{
  const SizeValueType words = m_Signs->GetNumberOfWords();
  const WordType * const here = splits.GetRow(j, k);
  for (std::uint8_t type = 0; type < Types; ++type)
  {
    const auto & step = FCCLattice::OwnedEdges[type];
    const SizeValueType otherJ = j + static_cast<SizeValueType>(step[1]);
    const SizeValueType otherK = k + static_cast<SizeValueType>(step[2]);
    WordType * const crossings = m_SplitCrossings.data() + (j * Types + type) * m_Owners.GetStride();
    if (otherJ >= m_Signs->GetHeight() || otherK >= m_Signs->GetDepth())
    {
      std::fill(crossings, crossings + words, 0);
      continue;
    }
    const WordType * const there = splits.GetRow(otherJ, otherK);
    WordType any = 0;
    for (SizeValueType word = 0; word < words; ++word)
    {
      any |= here[word] | there[word];
    }
    if (any == 0)
    {
      std::fill(crossings, crossings + words, 0);
      continue;
    }
    const auto offset = FCCLattice::OffsetOf(step, m_Signs->GetParity(j, k))[0];
    MoveBits(there, words, -offset, crossings);
    const WordType * const first = m_Owners.GetFirst(j, type);
    const WordType * const second = m_Owners.GetSecond(j, type);
    for (SizeValueType word = 0; word < words; ++word)
    {
      crossings[word] = (first[word] & here[word]) | (second[word] & crossings[word]);
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
#endif
