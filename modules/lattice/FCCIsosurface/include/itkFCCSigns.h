#ifndef itkFCCSigns_h
#define itkFCCSigns_h

#include "detail/itkFCCBitRows.h"
#include "itkFCCLattice.h"

namespace itk
{

/** \class FCCSigns
 * \brief One bit for each site of a box of the lattice: whether it is inside the surface.
 *
 * Rows are stored as FCCBitRows has them. Rows are counted from (0, 0) whatever the image's start index, so the parity
 * of that row is stored, too. Different rows can be written at once.
 *
 * \ingroup FCCIsosurface
 */
class FCCSigns
{
public:
  using WordType = FCCBits::WordType;

  FCCSigns(SizeValueType width, SizeValueType height, SizeValueType depth, IndexValueType parityOfFirstRow)
    : m_Width(width)
    , m_Height(height)
    , m_Depth(depth)
    , m_ParityOfFirstRow(parityOfFirstRow)
    , m_Rows(height * depth, FCCBits::WordsOf(width), std::pmr::get_default_resource())
  {}

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
    return m_Rows.GetStride() - 1;
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
    return m_Rows.GetRow(k * m_Height + j);
  }
  const WordType *
  GetRow(SizeValueType j, SizeValueType k) const
  {
    return m_Rows.GetRow(k * m_Height + j);
  }

private:
  SizeValueType m_Width;
  SizeValueType m_Height;
  SizeValueType m_Depth;
  IndexValueType m_ParityOfFirstRow;
  FCCBitRows m_Rows;
};

/** \class FCCStepTarget
 * \brief The sites at one step from those of a row of the signs: their row, and how far their indices are from those of
 * the row.
 *
 * \ingroup FCCIsosurface
 */
struct FCCStepTarget
{
  SizeValueType j;
  SizeValueType k;
  IndexValueType shift;
  bool isInBox; ///< whether the row is one of the signs

  FCCStepTarget(const FCCSigns & signs, SizeValueType fromJ, SizeValueType fromK, const FCCLattice::SiteType & step)
    : j(fromJ + static_cast<SizeValueType>(step[1])) // below 0 wraps around
    , k(fromK + static_cast<SizeValueType>(step[2]))
    , shift(FCCLattice::OffsetOf(step, signs.GetParity(fromJ, fromK))[0])
    , isInBox(j < signs.GetHeight() && k < signs.GetDepth())
  {}
};

} // namespace itk

#endif
