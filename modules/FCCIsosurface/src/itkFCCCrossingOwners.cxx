#include "itkFCCCrossingOwners.h"

#include <algorithm>

namespace itk
{

FCCCrossingOwners::FCCCrossingOwners(const FCCSigns & signs)
  : m_Signs(&signs)
  , m_First(signs.GetHeight() * Types * this->GetStride())
  , m_Second(m_First.size())
{}

void
FCCCrossingOwners::Find(SizeValueType k, const FCCFieldPlanes & field, bool insideIsBelow)
{
  std::fill(m_First.begin(), m_First.end(), 0);
  std::fill(m_Second.begin(), m_Second.end(), 0);
  if (k >= m_Signs->GetDepth())
  {
    return;
  }
  const SizeValueType words = m_Signs->GetNumberOfWords();
  for (SizeValueType j = 0; j < m_Signs->GetHeight(); ++j)
  {
    for (std::uint8_t type = 0; type < Types; ++type)
    {
      WordType * const first = m_First.data() + this->OffsetOf(j, type);
      WordType * const second = m_Second.data() + this->OffsetOf(j, type);
      if (!FindCutEdges(*m_Signs, type, j, k, second))
      {
        continue;
      }
      const auto & step = FCCLattice::OwnedEdges[type];
      const SizeValueType otherJ = j + static_cast<SizeValueType>(step[1]);
      const SizeValueType otherK = k + static_cast<SizeValueType>(step[2]);
      const bool isReal = field.IsReal(1, j) && field.IsReal(2, k);
      const bool isOtherReal = field.IsReal(1, otherJ) && field.IsReal(2, otherK);
      if (!isReal || !isOtherReal)
      {
        std::swap_ranges(first, first + (isReal ? 0 : words), second);
        continue;
      }
      const auto offset = FCCLattice::OffsetOf(step, field.GetParity(j, k))[0];
      const float * const values = field.GetValues(j, k);
      const float * const others = field.GetValues(otherJ, otherK) + offset;
      const WordType * const signs = m_Signs->GetRow(j, k);
      for (SizeValueType word = 0; word < words; ++word)
      {
        if (second[word] != 0)
        {
          const SizeValueType begin = word * FCCSigns::WordBits;
          const WordType insideIsNearer = FCCRowKernels::CompareSums(values + begin, others + begin, insideIsBelow);
          first[word] = second[word] & ~(signs[word] ^ insideIsNearer);
        }
      }
      // Edges along x that leave the image.
      const SizeValueType last = m_Signs->GetWidth() - 1;
      const WordType lastBit = WordType{ 1 } << (last % FCCSigns::WordBits);
      const WordType beforeLastBit = WordType{ 1 } << ((last - 1) % FCCSigns::WordBits);
      first[0] |= second[0] & 1;
      first[last / FCCSigns::WordBits] |= second[last / FCCSigns::WordBits] & lastBit;
      if (offset == 1)
      {
        first[(last - 1) / FCCSigns::WordBits] &= ~beforeLastBit;
      }
      if (offset == -1)
      {
        first[0] &= ~WordType{ 2 };
      }
      for (SizeValueType word = 0; word < words; ++word)
      {
        second[word] &= ~first[word];
      }
    }
  }
}

} // namespace itk
