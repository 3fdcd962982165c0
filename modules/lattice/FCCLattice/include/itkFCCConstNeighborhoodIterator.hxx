#ifndef itkFCCConstNeighborhoodIterator_hxx
#define itkFCCConstNeighborhoodIterator_hxx

#include "itkMacro.h"

#include <algorithm>

namespace itk
{

template <typename TImage>
FCCConstNeighborhoodIterator<TImage>::FCCConstNeighborhoodIterator(const ImageType * image, const RegionType & region)
  : m_Image(image)
  , m_Region(region)
{
  if (image == nullptr)
  {
    itkGenericExceptionMacro("A neighbourhood iterator needs an image, not a null pointer; give one that is allocated");
  }
  m_BufferedRegion = image->GetBufferedRegion();
  const bool isEmpty = region.GetNumberOfPixels() == 0;
  if (!isEmpty && !m_BufferedRegion.IsInside(region))
  {
    itkGenericExceptionMacro("The region to walk over, of size "
                             << region.GetSize() << " at " << region.GetIndex()
                             << ", is not inside the image's buffered region, of size " << m_BufferedRegion.GetSize()
                             << " at " << m_BufferedRegion.GetIndex() << "; crop it, or update the image for it first");
  }
  const auto * const pixels = image->GetPixelContainer();
  if (!isEmpty && (pixels == nullptr || pixels->Size() < m_BufferedRegion.GetNumberOfPixels()))
  {
    itkGenericExceptionMacro("The image's samples, of size "
                             << m_BufferedRegion.GetSize() << " at " << m_BufferedRegion.GetIndex()
                             << ", were never allocated; call its Allocate() and fill it first");
  }
  m_NumberOfRows = isEmpty ? 0 : region.GetSize(1) * region.GetSize(2);
  this->GoToBegin();
}

template <typename TImage>
void
FCCConstNeighborhoodIterator<TImage>::GoToBegin()
{
  m_Row = 0;
  this->BeginRow();
}

template <typename TImage>
void
FCCConstNeighborhoodIterator<TImage>::BeginRow()
{
  if (this->IsAtEnd())
  {
    return;
  }
  const auto rowsOfPlane = m_Region.GetSize(1);
  m_RowIndex = m_Region.GetIndex();
  m_RowIndex[1] += static_cast<IndexValueType>(m_Row % rowsOfPlane);
  m_RowIndex[2] += static_cast<IndexValueType>(m_Row / rowsOfPlane);
  m_Parity = FCCLattice::Parity(m_RowIndex[1], m_RowIndex[2]);
  m_X = m_RowIndex[0];
  m_Pixel = m_Image->GetBufferPointer() + m_Image->ComputeOffset(m_RowIndex);
  this->BeginSpan();
}

template <typename TImage>
void
FCCConstNeighborhoodIterator<TImage>::BeginSpan()
{
  const IndexValueType endOfRow = m_Region.GetIndex(0) + static_cast<IndexValueType>(m_Region.GetSize(0));
  if (m_X == endOfRow)
  {
    ++m_Row;
    this->BeginRow();
    return;
  }
  m_InBounds = true;
  const OffsetValueType * const table = m_Image->GetOffsetTable();
  for (unsigned int n = 0; n < Size(); ++n)
  {
    const OffsetType offset = FCCLattice::OffsetOf(FCCLattice::NearestNeighbors[n], m_Parity);
    const bool isInside = m_BufferedRegion.IsInside(this->GetIndex() + offset);
    m_Steps[n] = isInside ? offset[0] + offset[1] * table[1] + offset[2] * table[2] : 0;
    m_InBounds = m_InBounds && isInside;
  }
  // The first and the last sample of a buffered row have other steps than those between them.
  const IndexValueType last = m_BufferedRegion.GetUpperIndex()[0];
  m_EndOfSpan = m_X == m_BufferedRegion.GetIndex(0) || m_X == last ? m_X + 1 : std::min(endOfRow, last);
}

} // namespace itk

#endif
