#include "itkFCCSigns.h"

namespace itk
{

FCCSigns::FCCSigns(SizeValueType width, SizeValueType height, SizeValueType depth, IndexValueType parityOfFirstRow)
  : m_Width(width)
  , m_Height(height)
  , m_Depth(depth)
  , m_Stride((width + WordBits - 1) / WordBits + 1)
  , m_ParityOfFirstRow(parityOfFirstRow)
  , m_Words(m_Stride * height * depth + WordsBeyond, 0)
{}

void
FCCSigns::ShiftRow(SizeValueType j, SizeValueType k)
{
  WordType * const row = this->GetRow(j, k);
  WordType carried = 0;
  for (SizeValueType word = 0; word < this->GetNumberOfWords(); ++word)
  {
    const WordType bits = row[word];
    row[word] = bits << 1 | carried;
    carried = bits >> (WordBits - 1);
  }
}

} // namespace itk
