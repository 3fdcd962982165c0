#ifndef itkFCCLabelPlane_h
#define itkFCCLabelPlane_h

#include "detail/itkFCCBitRows.h"
#include "itkFCCLabelCells.h"

#include <vector>

namespace itk
{

/** \class FCCLabelBox
 * \brief The box of sites whose labels are compared: the image and a layer of outside around it.
 *
 * Reads labels a plane at a time, in rows with a spare site at either end, so that the label at one step is always in
 * memory. */
class FCCLabelBox
{
public:
  using LabelType = std::uint16_t;
  using SizeType = std::array<SizeValueType, 3>;

  /** \param labels of the image, rows along x
   * \param parity of the image's first row */
  FCCLabelBox(const LabelType * labels, const SizeType & size, IndexValueType parity)
    : m_Labels(labels)
    , m_ImageSize(size)
    , m_Parity(parity)
  {}

  SizeValueType
  GetWidth() const
  {
    return m_ImageSize[0] + 2;
  }
  SizeValueType
  GetHeight() const
  {
    return m_ImageSize[1] + 2;
  }
  SizeValueType
  GetDepth() const
  {
    return m_ImageSize[2] + 2;
  }
  /** Whether the simplices of a type that a row stores are in the box's rows. */
  bool
  HasSimplices(SizeValueType j, SizeValueType k, unsigned int type) const;

  SizeValueType
  GetNumberOfWords() const
  {
    return FCCBits::WordsOf(this->GetWidth());
  }

  /** Parity of a row of the box. The box's first row is one step in y and one in z from the image's first row, and has
   * the same parity. */
  IndexValueType
  GetParity(SizeValueType j, SizeValueType k) const
  {
    return (m_Parity + static_cast<IndexValueType>(j + k)) & 1;
  }

  /** The row of the image that a row of the box is; false for the layer around it. */
  bool
  FindImageRow(SizeValueType j, SizeValueType k, SizeValueType & row) const
  {
    row = (k - 1) * m_ImageSize[1] + j - 1;
    return j >= 1 && k >= 1 && j <= m_ImageSize[1] && k <= m_ImageSize[2];
  }

  /** Labels of a plane; labels past the box are 0. */
  class Plane
  {
  public:
    Plane(const FCCLabelBox & box, SizeValueType k);

    /** The labels of a row, which may be read from -1 to one past the end of its last word. */
    const LabelType *
    GetRow(SizeValueType j) const
    {
      return m_Labels.data() + j * m_Stride + 1;
    }

  private:
    SizeValueType m_Stride;
    std::vector<LabelType> m_Labels;
  };

private:
  const LabelType * m_Labels;
  SizeType m_ImageSize;
  IndexValueType m_Parity;
};

/** \class FCCLabelPlane
 * \brief The simplices that one plane of sites stores and that hold a point of the walls, and the numbers of the
 * points.
 *
 * Points are numbered row by row, within a row type by type, within a type along x. */
class FCCLabelPlane
{
public:
  using Row = FCCNumberedBits::Row;
  using WordType = FCCBits::WordType;

  explicit FCCLabelPlane(const FCCLabelBox & box);

  /** Finds the cut edges that plane \a k stores. */
  void
  FindEdges(SizeValueType k, const FCCLabelBox::Plane & labels, const FCCLabelBox::Plane & next);

  /** Finds the faces and tetrahedra, of which all edges are cut, from the edges of this plane and the next. */
  void
  FindFacesAndTetrahedra(const FCCLabelPlane & next);

  SizeValueType
  Count() const
  {
    return m_Bits.Count();
  }

  /** Numbers the points from \a first on. */
  void
  Number(std::uint32_t first)
  {
    m_Bits.Number(first);
  }

  SizeValueType
  GetPlane() const
  {
    return m_K;
  }

  Row
  GetRow(SizeValueType j, unsigned int type) const
  {
    return m_Bits.GetNumberedRow(j * FCCCells::Types + type);
  }

private:
  const FCCLabelBox & m_Box;
  SizeValueType m_K{ 0 };
  FCCNumberedBits m_Bits;
};

/** \class FCCLabelPart
 * \brief The points of a part of the simplices of one type that a row of sites stores. */
struct FCCLabelPart
{
  FCCLabelPlane::Row row;
  IndexValueType shift; ///< from the simplex's lowest site to the part's, in indices

  /** The row is the j-th of a plane.
   * \param next the next plane
   * \param type of the simplices
   * \param set sites of the part, bit n for the n-th of the simplex */
  FCCLabelPart(const FCCLabelBox & box,
               const FCCLabelPlane & plane,
               const FCCLabelPlane & next,
               SizeValueType j,
               unsigned int type,
               unsigned int set);

  std::uint32_t
  GetNumber(SizeValueType i) const
  {
    return row.GetNumber(i + static_cast<SizeValueType>(shift));
  }

  /** The simplices of one word whose part has a point. */
  FCCLabelPlane::WordType
  GetBits(SizeValueType word) const
  {
    return FCCBits::Shifted(row.bits, word, shift);
  }
};

} // namespace itk

#endif
