#include "itkFCCSigns.h"

#include "itkFCCBitRows.h"

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
  FCCBits::ForEachShifted(
    row, this->GetNumberOfWords(), -1, [row](SizeValueType word, WordType bits) { row[word] = bits; });
}

} // namespace itk
