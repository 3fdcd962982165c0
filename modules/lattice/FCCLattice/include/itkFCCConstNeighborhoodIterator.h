#ifndef itkFCCConstNeighborhoodIterator_h
#define itkFCCConstNeighborhoodIterator_h

#include "itkFCCImage.h"
#include "itkMacro.h"

#include <algorithm>

namespace itk
{

/** \class FCCConstNeighborhoodIterator
 * \brief Walks over the samples of a region of an FCC image, row by row, each with its 12 nearest neighbours.
 *
 * Neighbours have the order of FCCLattice::NearestNeighbors: neighbour \a n of a sample is the site at
 * NearestNeighbors[n] from it.
 *
 * **At the border:** a neighbour outside the image's buffered region has the value of the sample itself, so differences
 * across the border, and the flux through it, are 0. IsNeighborInside() tells which neighbours are outside. The region
 * may be any part of the buffered region; neighbours outside the region but inside the buffered region have their own
 * values.
 *
 * Access to a neighbour is one addition and one load, at the border too: the steps in memory are computed where they
 * change, three times a row, and are 0 for neighbours outside.
 *
 *     for (FCCConstNeighborhoodIterator<ImageType> it(image, region); !it.IsAtEnd(); ++it)
 *     {
 *       float sum = 0.0f;
 *       for (unsigned int n = 0; n < it.Size(); ++n)
 *       {
 *         sum += it.GetNeighbor(n);
 *       }
 *       ...
 *     }
 *
 * The constructor throws when the image is a null pointer or was never allocated, or the region is not inside its
 * buffered region. The image must not be deleted, released or allocated anew while the iterator is used.
 *
 * \ingroup FCCLattice
 */
template <typename TImage>
class FCCConstNeighborhoodIterator
{
public:
  using Self = FCCConstNeighborhoodIterator;
  using ImageType = TImage;
  using PixelType = typename TImage::PixelType;
  using IndexType = typename TImage::IndexType;
  using RegionType = typename TImage::RegionType;
  using OffsetType = typename TImage::OffsetType;

  static_assert(std::is_base_of<FCCImage<PixelType>, TImage>::value, "The image must be an FCCImage");

  /** Starts at the first sample of the region. */
  FCCConstNeighborhoodIterator(const ImageType * image, const RegionType & region)
    : m_Image(image)
    , m_Region(region)
  {
    if (image == nullptr)
    {
      itkGenericExceptionMacro(
        "A neighbourhood iterator needs an image, not a null pointer; give one that is allocated");
    }
    m_BufferedRegion = image->GetBufferedRegion();
    const bool isEmpty = region.GetNumberOfPixels() == 0;
    if (!isEmpty && !m_BufferedRegion.IsInside(region))
    {
      itkGenericExceptionMacro("The region to walk over, of size "
                               << region.GetSize() << " at " << region.GetIndex()
                               << ", is not inside the image's buffered region, of size " << m_BufferedRegion.GetSize()
                               << " at " << m_BufferedRegion.GetIndex()
                               << "; crop it, or update the image for it first");
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

  /** The number of neighbours of a sample: 12. */
  static constexpr unsigned int
  Size()
  {
    return static_cast<unsigned int>(FCCLattice::NearestNeighbors.size());
  }

  /** Goes to the first sample of the region. */
  void
  GoToBegin()
  {
    m_Row = 0;
    this->BeginRow();
  }

  /** Whether the iterator is past the last sample, where there is no pixel to read. */
  bool
  IsAtEnd() const
  {
    return m_Row == m_NumberOfRows;
  }

  /** Goes to the next sample along x, or to the first of the next row. Must not be called at the end. */
  Self &
  operator++()
  {
    ++m_Pixel;
    if (++m_X == m_EndOfSpan)
    {
      this->BeginSpan();
    }
    return *this;
  }

  IndexType
  GetIndex() const
  {
    return { { m_X, m_RowIndex[1], m_RowIndex[2] } };
  }

  const RegionType &
  GetRegion() const
  {
    return m_Region;
  }

  const PixelType &
  GetCenterPixel() const
  {
    return *m_Pixel;
  }

  /** The value of neighbour \a n (below 12), or of the sample itself if the neighbour is outside the buffered region.
   */
  const PixelType &
  GetNeighbor(unsigned int n) const
  {
    return m_Pixel[m_Steps[n]];
  }

  /** Whether neighbour \a n is in the buffered region. */
  bool
  IsNeighborInside(unsigned int n) const
  {
    return m_Steps[n] != 0; // another sample has another address
  }

  /** Whether all neighbours are in the buffered region. */
  bool
  InBounds() const
  {
    return m_InBounds;
  }

  /** The index of neighbour \a n, inside the buffered region or not. */
  IndexType
  GetNeighborIndex(unsigned int n) const
  {
    return this->GetIndex() + FCCLattice::OffsetOf(FCCLattice::NearestNeighbors[n], m_Parity);
  }

protected:
  const PixelType *
  GetPixelPointer() const
  {
    return m_Pixel;
  }

private:
  /** Goes to the first sample of row number m_Row of the region, if there is such a row. */
  void
  BeginRow()
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

  /** Computes the steps from the sample at m_X and the end of the span in which they are the same. At the end of a row,
   * begins the next row. */
  void
  BeginSpan()
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
    // The first and the last sample of a buffered row have other steps than the samples between them.
    const IndexValueType last = m_BufferedRegion.GetUpperIndex()[0];
    m_EndOfSpan = m_X == m_BufferedRegion.GetIndex(0) || m_X == last ? m_X + 1 : std::min(endOfRow, last);
  }

  const ImageType * m_Image;
  RegionType m_Region;
  RegionType m_BufferedRegion;
  SizeValueType m_NumberOfRows;
  SizeValueType m_Row{ 0 };
  IndexType m_RowIndex{};
  IndexValueType m_Parity{ 0 };
  IndexValueType m_X{ 0 };
  IndexValueType m_EndOfSpan{ 0 };
  bool m_InBounds{ false };
  const PixelType * m_Pixel{ nullptr };
  std::array<OffsetValueType, FCCLattice::NearestNeighbors.size()> m_Steps{};
};

} // namespace itk

#endif
