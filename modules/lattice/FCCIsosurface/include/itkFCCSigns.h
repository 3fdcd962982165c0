#ifndef itkFCCSigns_h
#define itkFCCSigns_h

#include "itkFCCLattice.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class FCCSigns
 * \brief One bit for each site of a box of the lattice: whether it is inside the surface.
 *
 * Rows are stored as 64-bit words, bit i of a row being site i, followed by a spare zero word; bits past the last site
 * are zero. Rows are counted from (0, 0) whatever the image's start index, so the parity of that row is stored, too.
 * Different rows can be written at once.
 *
 * \ingroup FCCIsosurface
 */
class FCCSigns
{
public:
  using WordType = std::uint64_t;
  static constexpr SizeValueType WordBits = 64;

  /** Words that may be read beyond the last row, so that rows can be read by whole vectors. */
  static constexpr SizeValueType WordsBeyond = 8;

  FCCSigns(SizeValueType width, SizeValueType height, SizeValueType depth, IndexValueType parityOfFirstRow);

  SizeValueType
  GetWidth() const
  {
    return m_Width;
  }
  SizeValueType
  GetHeight() const
  {
    return m_Height;
  }
  SizeValueType
  GetDepth() const
  {
    return m_Depth;
  }
  /** Words of a row that hold sites, without the spare one. */
  SizeValueType
  GetNumberOfWords() const
  {
    return m_Stride - 1;
  }

  /** 0 for a row whose sites have an even x, else 1: FCCLattice::Parity(). */
  IndexValueType
  GetParity(SizeValueType j, SizeValueType k) const
  {
    return (m_ParityOfFirstRow + static_cast<IndexValueType>(j + k)) & 1;
  }

  /** The words of a row. */
  WordType *
  GetRow(SizeValueType j, SizeValueType k)
  {
    return m_Words.data() + (k * m_Height + j) * m_Stride;
  }
  /** The words of a row. */
  const WordType *
  GetRow(SizeValueType j, SizeValueType k) const
  {
    return m_Words.data() + (k * m_Height + j) * m_Stride;
  }

  /** Moves the bits of a row one site up; there must be room. */
  void
  ShiftRow(SizeValueType j, SizeValueType k);

private:
  SizeValueType m_Width;
  SizeValueType m_Height;
  SizeValueType m_Depth;
  SizeValueType m_Stride;
  IndexValueType m_ParityOfFirstRow;
  std::vector<WordType> m_Words;
};

} // namespace itk

#endif
