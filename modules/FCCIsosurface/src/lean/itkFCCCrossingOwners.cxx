#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkFCCCrossingOwners.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkFCCCrossingOwners.h"

#include <algorithm>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{
namespace
{

namespace hn = hwy::HWY_NAMESPACE;
using WordType = FCCSigns::WordType;

/** One bit for each of 64 pairs of values: is their sum below zero, or with \a isAbove, above? */
HWY_INLINE WordType
CompareSums(const float * values, const float * others, bool isAbove)
{
  const hn::ScalableTag<float> tag;
  WordType word = 0;
  for (std::size_t lane = 0; lane < FCCSigns::WordBits; lane += hn::Lanes(tag))
  {
    const auto sum = hn::Add(hn::LoadU(tag, values + lane), hn::LoadU(tag, others + lane));
    const auto mask = isAbove ? hn::Gt(sum, hn::Zero(tag)) : hn::Lt(sum, hn::Zero(tag));
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(tag, mask, bytes);
    WordType bits;
    std::memcpy(&bits, bytes, sizeof bits);
    word |= bits << lane;
  }
  return word;
}

/** The cut edges of a row: sites that differ from those of another row, moved by \a Shift. */
template <int Shift>
HWY_INLINE void
FindCuts(const WordType * signs, const WordType * others, std::size_t words, WordType * cuts)
{
  for (std::size_t word = 0; word < words; ++word)
  {
    const WordType other = Shift == 0  ? others[word]
                           : Shift > 0 ? others[word] >> 1 | others[word + 1] << (FCCSigns::WordBits - 1)
                                       : others[word] << 1 | others[word - 1] >> (FCCSigns::WordBits - 1);
    cuts[word] = signs[word] ^ other;
  }
}

/** Finds the owners of a plane's crossings, rows as FCCCrossingOwners stores them. */
void
FindOwners(const FCCSigns & signs,
           const FCCFieldPlanes & field,
           SizeValueType k,
           bool insideIsBelow,
           SizeValueType stride,
           WordType * firsts,
           WordType * seconds)
{
  const SizeValueType words = signs.GetNumberOfWords();
  const SizeValueType last = signs.GetWidth() - 1;
  const auto bitOf = [](SizeValueType i, SizeValueType word) {
    return i / FCCSigns::WordBits == word ? WordType{ 1 } << (i % FCCSigns::WordBits) : 0;
  };
  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    const bool isReal = field.IsReal(1, j) && field.IsReal(2, k);
    const WordType * const row = signs.GetRow(j, k);
    for (const auto & step : FCCLattice::OwnedEdges)
    {
      WordType * const first = firsts;
      WordType * const second = seconds;
      firsts += stride;
      seconds += stride;
      const SizeValueType otherJ = j + static_cast<SizeValueType>(step[1]);
      const SizeValueType otherK = k + static_cast<SizeValueType>(step[2]);
      if (otherJ >= signs.GetHeight() || otherK >= signs.GetDepth())
      {
        std::fill(first, first + words, 0);
        std::fill(second, second + words, 0);
        continue;
      }
      const WordType * const others = signs.GetRow(otherJ, otherK);
      const auto offset = FCCLattice::OffsetOf(step, signs.GetParity(j, k))[0];
      switch (offset)
      {
        case 0:
          FindCuts<0>(row, others, words, second);
          break;
        case 1:
          FindCuts<1>(row, others, words, second);
          break;
        default:
          FindCuts<-1>(row, others, words, second); // the word before a row is the spare one of another
      }
      if (!isReal || !field.IsReal(1, otherJ) || !field.IsReal(2, otherK))
      {
        if (!isReal)
        {
          std::copy(second, second + words, first);
          std::fill(second, second + words, 0);
        }
        else
        {
          std::fill(first, first + words, 0);
        }
        continue;
      }
      const float * const values = field.GetValues(j, k);
      const float * const otherValues = field.GetValues(otherJ, otherK) + offset;
      for (SizeValueType word = 0; word < words; ++word)
      {
        const WordType cut = second[word];
        WordType owned = 0;
        if (cut != 0)
        {
          const SizeValueType begin = word * FCCSigns::WordBits;
          owned = ~(row[word] ^ CompareSums(values + begin, otherValues + begin, insideIsBelow));
        }
        first[word] = cut & owned;
        second[word] = cut & ~owned;
      }
      // At the ends of rows, crossings belong to the sites outside the image.
      for (const SizeValueType word : { SizeValueType{ 0 }, words - 1, (last - 1) / FCCSigns::WordBits })
      {
        const WordType cut = first[word] | second[word];
        const WordType leaves = (offset == 1 ? bitOf(last - 1, word) : 0) | (offset == -1 ? bitOf(1, word) : 0);
        const WordType owned = (first[word] | bitOf(0, word) | bitOf(last, word)) & ~leaves;
        first[word] = cut & owned;
        second[word] = cut & ~owned;
      }
    }
  }
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
HWY_EXPORT(FindOwners);
}

FCCCrossingOwners::FCCCrossingOwners(const FCCSigns & signs, std::pmr::memory_resource * scratch)
  : m_Signs(&signs)
  , m_First(signs.GetHeight() * Types * this->GetStride() + FCCSigns::WordsBeyond, scratch)
  , m_Second(m_First.size(), scratch)
{}

void
FCCCrossingOwners::Find(SizeValueType k, const FCCFieldPlanes & field, bool insideIsBelow)
{
  if (k >= m_Signs->GetDepth())
  {
    std::fill(m_First.begin(), m_First.end(), 0);
    std::fill(m_Second.begin(), m_Second.end(), 0);
    return;
  }
  HWY_DYNAMIC_DISPATCH(FindOwners)
  (*m_Signs, field, k, insideIsBelow, this->GetStride(), m_First.data(), m_Second.data());
}

} // namespace itk
#endif
