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

/** Bits of the sites of a row that have a neighbour on the other side of the surface. */
void
FindBorderSites(const FCCSigns & signs, SizeValueType j, SizeValueType k, std::vector<WordType> & border)
{
  const WordType * const row = signs.GetRow(j, k);
  std::fill(border.begin(), border.end(), 0);
  for (const auto & edge : FCCLattice::OwnedEdges)
  {
    for (const IndexValueType sign : { 1, -1 })
    {
      const FCCStepTarget end(signs, j, k, { sign * edge[0], sign * edge[1], sign * edge[2] });
      if (end.isInBox)
      {
        FCCBits::ForEachShifted(signs.GetRow(end.j, end.k),
                                border.size(),
                                end.shift,
                                [&](SizeValueType word, WordType bits) { border[word] |= row[word] ^ bits; });
      }
    }
  }
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

void
FindBorderBlocks(const FCCSigns & signs,
                 SizeValueType k,
                 SizeValueType block,
                 SizeValueType blocksOfRow,
                 SizeValueType offset,
                 std::vector<std::uint8_t> & blocks)
{
  blocks.assign((signs.GetHeight() + 2 * offset) * blocksOfRow, 0);
  std::vector<WordType> border(signs.GetNumberOfWords());
  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    FindBorderSites(signs, j, k, border);
    std::uint8_t * const row = blocks.data() + (j + offset) * blocksOfRow;
    for (SizeValueType i = 0; i < signs.GetWidth(); i += block)
    {
      const WordType blockBits = border[i / FCCBits::WordBits] >> (i % FCCBits::WordBits);
      if ((blockBits & ((WordType{ 1 } << block) - 1)) != 0)
      {
        row[i / block] = 1;
        if (offset > 0 && i / block + 1 < blocksOfRow)
        {
          row[i / block + 1] = 1;
        }
      }
    }
  }
}

} // namespace itk
