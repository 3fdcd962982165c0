#include "itkFCCNearerEnds.h"

namespace itk
{
namespace
{

/** Calls use(n) for every eighth bit n from which on any of eight is set. */
template <typename TUse>
void
ForEachByte(FCCBits::WordType word, const TUse & use)
{
  while (word != 0)
  {
    const auto n = static_cast<unsigned int>(__builtin_ctzll(word)) / 8 * 8;
    word &= ~(FCCBits::WordType{ 0xFF } << n);
    use(n);
  }
}

} // namespace

FCCNearerEnds::FCCNearerEnds(const FCCSigns & signs, std::pmr::memory_resource * scratch)
  : m_Signs(&signs)
  , m_Starts(signs.GetHeight() * Types, signs.GetNumberOfWords(), scratch)
  , m_Ends(signs.GetHeight() * Types, signs.GetNumberOfWords(), scratch)
{}

void
FCCNearerEnds::Find(SizeValueType k, const FCCFieldPlanes & field, bool insideIsBelow)
{
  for (SizeValueType j = 0; j < m_Signs->GetHeight(); ++j)
  {
    for (std::uint8_t type = 0; type < Types; ++type)
    {
      this->FindRow(j, k, type, field, insideIsBelow);
    }
  }
}

void
FCCNearerEnds::FindRow(SizeValueType j,
                       SizeValueType k,
                       std::uint8_t type,
                       const FCCFieldPlanes & field,
                       bool insideIsBelow)
{
  const FCCStepTarget end(*m_Signs, j, k, FCCLattice::OwnedEdges[type]);
  const bool startIsReal = field.IsReal(1, j) && field.IsReal(2, k);
  const bool endIsReal = field.IsReal(1, end.j) && field.IsReal(2, end.k);
  if (!startIsReal || !endIsReal)
  {
    m_Starts.ClearRow(j * Types + type);
    m_Ends.ClearRow(j * Types + type);
  }
  if (!end.isInBox)
  {
    return;
  }
  const SizeValueType words = m_Signs->GetNumberOfWords();
  const WordType * const row = m_Signs->GetRow(j, k);
  const WordType * const endRow = m_Signs->GetRow(end.j, end.k);
  WordType * const starts = m_Starts.GetRow(j * Types + type);
  WordType * const ends = m_Ends.GetRow(j * Types + type);
  if (!startIsReal || !endIsReal)
  {
    WordType * const outside = startIsReal ? ends : starts;
    FCCBits::ForEachShifted(
      endRow, words, end.shift, [&](SizeValueType word, WordType bits) { outside[word] = row[word] ^ bits; });
    return;
  }

  const float * const startValues = field.GetValues(j, k);
  const float * const endValues = field.GetValues(j, k, FCCLattice::OwnedEdges[type]);
  FCCBits::ForEachShifted(endRow, words, end.shift, [&](SizeValueType word, WordType bits) {
    const WordType cut = row[word] ^ bits;
    WordType nearerToInside = 0;
    FCCBits::ForEach(cut, 0, [&](SizeValueType n) {
      const SizeValueType i = word * FCCBits::WordBits + n;
      nearerToInside |= WordType{ IsNearerToInside(startValues[i] + endValues[i], insideIsBelow) } << n;
    });
    ends[word] = cut & (row[word] ^ nearerToInside);
    starts[word] = cut & ~ends[word];
  });
  // The first and last sites of a row are outside the image.
  const auto move = [](SizeValueType i, WordType * from, WordType * to) {
    const SizeValueType word = i / FCCBits::WordBits;
    const WordType moved = from[word] & WordType{ 1 } << (i % FCCBits::WordBits);
    from[word] ^= moved;
    to[word] |= moved;
  };
  const SizeValueType last = m_Signs->GetWidth() - 1;
  move(0, ends, starts);
  move(last, ends, starts);
  if (end.shift != 0)
  {
    move(end.shift > 0 ? last - 1 : 1, starts, ends);
  }
}

auto
FCCNearerEnds::Pack() const -> Packed
{
  const SizeValueType words = m_Signs->GetNumberOfWords();
  Packed packed(m_Signs->GetHeight() * Types * words * sizeof(WordType));
  auto next = packed.begin();
  for (SizeValueType row = 0; row < m_Signs->GetHeight() * Types; ++row)
  {
    for (SizeValueType word = 0; word < words; ++word)
    {
      const WordType starts = m_Starts.GetRow(row)[word];
      ForEachByte(starts | m_Ends.GetRow(row)[word],
                  [&](unsigned int n) { *next++ = static_cast<std::uint8_t>(starts >> n); });
    }
  }
  return Packed(packed.begin(), next);
}

void
FCCNearerEnds::Unpack(SizeValueType k, const Packed & packed)
{
  const SizeValueType words = m_Signs->GetNumberOfWords();
  const std::uint8_t * next = packed.data();
  for (SizeValueType j = 0; j < m_Signs->GetHeight(); ++j)
  {
    for (std::uint8_t type = 0; type < Types; ++type)
    {
      const FCCStepTarget end(*m_Signs, j, k, FCCLattice::OwnedEdges[type]);
      WordType * const starts = m_Starts.GetRow(j * Types + type);
      WordType * const ends = m_Ends.GetRow(j * Types + type);
      if (!end.isInBox)
      {
        std::fill_n(starts, words, 0);
        std::fill_n(ends, words, 0);
        continue;
      }
      const WordType * const row = m_Signs->GetRow(j, k);
      const WordType * const endRow = m_Signs->GetRow(end.j, end.k);
      FCCBits::ForEachShifted(endRow, words, end.shift, [&](SizeValueType word, WordType bits) {
        const WordType cut = row[word] ^ bits;
        WordType isStart = 0;
        ForEachByte(cut, [&](unsigned int n) { isStart |= WordType{ *next++ } << n; });
        starts[word] = isStart;
        ends[word] = cut ^ isStart;
      });
    }
  }
}

} // namespace itk
