#include "itkFCCCutEdges.h"

namespace itk
{
namespace
{

using WordType = FCCSigns::WordType;

/** Calls use(word, bits of the cut edges) for the edges of one type that a row stores. */
template <typename TUse>
void
ForEachCutWord(const FCCSigns & signs, std::uint8_t type, SizeValueType j, SizeValueType k, const TUse & use)
{
  const FCCStepTarget end(signs, j, k, FCCLattice::OwnedEdges[type]);
  if (!end.isInBox)
  {
    return;
  }
  const WordType * const row = signs.GetRow(j, k);
  const SizeValueType count = signs.GetWidth() - (end.shift == 1 ? 1 : 0); // number of sites whose edge ends in the box
  FCCBits::ForEachShifted(
    signs.GetRow(end.j, end.k), signs.GetNumberOfWords(), end.shift, [&](SizeValueType word, WordType bits) {
      const WordType beforeFirst = end.shift < 0 && word == 0 ? 1 : 0;
      use(word, (row[word] ^ bits) & FCCBits::Below(count, word) & ~beforeFirst);
    });
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
  m_Cut.Clear();
  SizeValueType row = 0;
  for (SizeValueType j = 0; j < m_Signs->GetHeight() && k < m_Signs->GetDepth(); ++j)
  {
    FCCStoredEdges::ForEachType(m_Types, [&](std::uint8_t type) {
      WordType * const cut = m_Cut.GetRow(row++);
      ForEachCutWord(*m_Signs, type, j, k, [cut](SizeValueType word, WordType bits) { cut[word] = bits; });
    });
  }
  m_Cut.Number(firstId);
}

SizeValueType
FCCCutEdges::Count(const FCCSigns & signs, Group group, SizeValueType k, std::uint8_t types)
{
  SizeValueType count = 0;
  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    FCCStoredEdges::ForEachType(types & FCCStoredEdges::TypesOf(group), [&](std::uint8_t type) {
      ForEachCutWord(signs, type, j, k, [&count](SizeValueType, WordType bits) { count += FCCBits::Count(bits); });
    });
  }
  return count;
}

} // namespace itk
