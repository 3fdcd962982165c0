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
  const std::size_t lanes = hn::Lanes(tag);
  WordType word = 0;
  for (std::size_t lane = 0; lane < FCCSigns::WordBits; lane += lanes)
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

/** The owners of the crossings of one type of edges in a row. \a shift leads from a site to the edge's other end in its
 * row. Without \a values the edges lead into or out of the image: \a firstOwns says whose they are. */
void
FindOwnersOfRow(const WordType * signs,
                const WordType * otherSigns,
                std::ptrdiff_t shift,
                std::size_t words,
                const float * values,
                const float * others,
                bool insideIsBelow,
                bool firstOwns,
                WordType * first,
                WordType * second)
{
  for (std::size_t word = 0; word < words; ++word)
  {
    const WordType other =
      shift == 0  ? otherSigns[word]
      : shift > 0 ? otherSigns[word] >> 1 | otherSigns[word + 1] << (FCCSigns::WordBits - 1)
                  : otherSigns[word] << 1 | (word > 0 ? otherSigns[word - 1] >> (FCCSigns::WordBits - 1) : 0);
    const WordType cut = signs[word] ^ other;
    WordType owned = firstOwns ? cut : 0;
    if (values != nullptr && cut != 0)
    {
      const std::size_t begin = word * FCCSigns::WordBits;
      owned = cut & ~(signs[word] ^ CompareSums(values + begin, others + begin, insideIsBelow));
    }
    first[word] = owned;
    second[word] = cut & ~owned;
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
HWY_EXPORT(FindOwnersOfRow);
}

FCCCrossingOwners::FCCCrossingOwners(const FCCSigns & signs)
  : m_Signs(&signs)
  , m_First(signs.GetHeight() * Types * this->GetStride())
  , m_Second(m_First.size())
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
  const SizeValueType words = m_Signs->GetNumberOfWords();
  for (SizeValueType j = 0; j < m_Signs->GetHeight(); ++j)
  {
    for (std::uint8_t type = 0; type < Types; ++type)
    {
      WordType * const first = m_First.data() + this->OffsetOf(j, type);
      WordType * const second = m_Second.data() + this->OffsetOf(j, type);
      const auto & step = FCCLattice::OwnedEdges[type];
      const SizeValueType otherJ = j + static_cast<SizeValueType>(step[1]);
      const SizeValueType otherK = k + static_cast<SizeValueType>(step[2]);
      if (otherJ >= m_Signs->GetHeight() || otherK >= m_Signs->GetDepth())
      {
        std::fill(first, first + words, 0);
        std::fill(second, second + words, 0);
        continue;
      }
      const auto offset = FCCLattice::OffsetOf(step, field.GetParity(j, k))[0];
      const bool isReal = field.IsReal(1, j) && field.IsReal(2, k);
      const bool isOtherReal = field.IsReal(1, otherJ) && field.IsReal(2, otherK);
      const bool areReal = isReal && isOtherReal;
      HWY_DYNAMIC_DISPATCH(FindOwnersOfRow)
      (m_Signs->GetRow(j, k),
       m_Signs->GetRow(otherJ, otherK),
       offset,
       words,
       areReal ? field.GetValues(j, k) : nullptr,
       areReal ? field.GetValues(otherJ, otherK) + offset : nullptr,
       insideIsBelow,
       !isReal,
       first,
       second);
      if (areReal)
      {
        const SizeValueType last = m_Signs->GetWidth() - 1;
        this->Give(0, true, first, second);
        this->Give(last, true, first, second);
        if (offset == 1)
        {
          this->Give(last - 1, false, first, second);
        }
        if (offset == -1)
        {
          this->Give(1, false, first, second);
        }
      }
    }
  }
}

/** Gives the crossing of a site's edge, if there is one, to one end: that outside the image. */
void
FCCCrossingOwners::Give(SizeValueType i, bool toFirst, WordType * first, WordType * second) const
{
  const SizeValueType word = i / FCCSigns::WordBits;
  const WordType crossing = (first[word] | second[word]) & WordType{ 1 } << (i % FCCSigns::WordBits);
  first[word] = toFirst ? first[word] | crossing : first[word] & ~crossing;
  second[word] = toFirst ? second[word] & ~crossing : second[word] | crossing;
}

} // namespace itk
#endif
