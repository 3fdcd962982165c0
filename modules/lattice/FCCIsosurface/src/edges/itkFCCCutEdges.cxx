#include "itkFCCCutEdges.h"

namespace itk
{
namespace
{

using WordType = FCCSigns::WordType;

/** Writes the bits of the cut edges of one type that a row stores. */
void
FindCutEdges(const FCCSigns & signs, std::uint8_t type, SizeValueType j, SizeValueType k, WordType * cut)
{
  const SizeValueType words = signs.GetNumberOfWords();
  const FCCStepTarget end(signs, j, k, FCCLattice::OwnedEdges[type]);
  if (!end.isInBox || words == 0)
  {
    std::fill_n(cut, words, 0);
    return;
  }
  const WordType * const row = signs.GetRow(j, k);
  FCCBits::ForEachShifted(signs.GetRow(end.j, end.k), words, end.shift, [row, cut](SizeValueType word, WordType bits) {
    cut[word] = row[word] ^ bits;
  });
  // The first or the last site has no edge that ends outside the box.
  cut[0] &= ~WordType{ end.shift < 0 ? 1u : 0u };
  cut[words - 1] &= FCCBits::Below(signs.GetWidth() - (end.shift > 0 ? 1 : 0), words - 1);
}

} // namespace

FCCCutEdges::FCCCutEdges(const FCCSigns & signs, Group group, std::uint8_t types, std::pmr::memory_resource * scratch)
  : m_Signs(&signs)
  , m_Types(types & FCCStoredEdges::TypesOf(group))
  , m_NumberOfTypes(static_cast<SizeValueType>(__builtin_popcount(m_Types)))
  , m_Cut(signs.GetHeight() * m_NumberOfTypes, signs.GetNumberOfWords(), scratch)
{}

void
FCCCutEdges::Find(SizeValueType k, std::uint32_t firstId)
{
  m_FirstId = firstId;
  if (k >= m_Signs->GetDepth())
  {
    m_Cut.Clear();
  }
  SizeValueType row = 0;
  for (SizeValueType j = 0; j < m_Signs->GetHeight() && k < m_Signs->GetDepth(); ++j)
  {
    FCCStoredEdges::ForEachType(m_Types,
                                [&](std::uint8_t type) { FindCutEdges(*m_Signs, type, j, k, m_Cut.GetRow(row++)); });
  }
  m_Cut.Number(firstId);
}

SizeValueType
FCCCutEdges::Count(const FCCSigns & signs, Group group, SizeValueType k, std::uint8_t types)
{
  std::vector<WordType> cut(signs.GetNumberOfWords());
  SizeValueType count = 0;
  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    FCCStoredEdges::ForEachType(types & FCCStoredEdges::TypesOf(group), [&](std::uint8_t type) {
      FindCutEdges(signs, type, j, k, cut.data());
      for (const WordType bits : cut)
      {
        count += FCCBits::Count(bits);
      }
    });
  }
  return count;
}

} // namespace itk
