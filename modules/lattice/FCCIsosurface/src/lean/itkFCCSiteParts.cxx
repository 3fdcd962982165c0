#include "itkFCCSiteParts.h"

namespace itk
{

FCCSiteParts::FCCSiteParts(unsigned int crossings, unsigned int single)
  : m_Crossings(static_cast<std::uint16_t>(crossings))
  , m_Single(static_cast<std::uint16_t>(single))
{
  this->ForEachVertex([this](unsigned int directions) {
    for (; directions != 0; directions &= directions - 1)
    {
      m_Vertices |= std::uint64_t{ m_NumberOfVertices } << (BitsOfVertex * __builtin_ctz(directions));
    }
    ++m_NumberOfVertices;
  });
}

const std::vector<FCCSiteParts> &
FCCSplitRows::GetParts(SizeValueType j, SizeValueType k) const
{
  static const std::vector<FCCSiteParts> none;
  const auto & row = m_Rows[k * m_Height + j];
  return row ? row->parts : none;
}

const FCCSiteParts &
FCCSplitRows::GetParts(SizeValueType i, SizeValueType j, SizeValueType k) const
{
  const Row & row = *m_Rows[k * m_Height + j];
  return row.parts[CountBefore(row.bits, i)];
}

bool
FCCSplitRows::Set(SizeValueType i, SizeValueType j, SizeValueType k, const FCCSiteParts & parts)
{
  auto & row = m_Rows[k * m_Height + j];
  if (!row)
  {
    row = std::make_unique<Row>();
    row->bits.resize(m_Zeros.size());
  }
  const auto place = row->parts.begin() + static_cast<std::ptrdiff_t>(CountBefore(row->bits, i));
  if (FCCBits::Test(row->bits.data(), i))
  {
    *place = parts;
    return false;
  }
  row->parts.insert(place, parts);
  row->bits[i / FCCBits::WordBits] |= WordType{ 1 } << (i % FCCBits::WordBits);
  return true;
}

/** How many bits are set before bit \a i. */
SizeValueType
FCCSplitRows::CountBefore(const std::vector<WordType> & bits, SizeValueType i)
{
  const SizeValueType last = i / FCCBits::WordBits;
  SizeValueType count = FCCBits::CountBefore(bits[last], i);
  for (SizeValueType word = 0; word < last; ++word)
  {
    count += FCCBits::Count(bits[word]);
  }
  return count;
}

} // namespace itk
