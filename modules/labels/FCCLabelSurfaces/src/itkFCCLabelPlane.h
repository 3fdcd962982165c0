#ifndef itkFCCLabelPlane_h
#define itkFCCLabelPlane_h

#include "detail/itkFCCBitRows.h"
#include "detail/itkPositionArithmetic.h"
#include "itkFCCImage.h"
#include "itkFCCLabelCells.h"
#include "itkFCCLabelWeights.h"

#include <array>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class FCCLabelBox
 * \brief The box of sites whose labels are compared: the image and a layer of outside around the image.
 *
 * Indices are counted from the box's first site. */
class FCCLabelBox
{
public:
  using LabelType = FCCLabelWeights::LabelType;
  using ImageType = FCCImage<LabelType>;

  /** \param weights may be null */
  FCCLabelBox(const ImageType & image, const FCCLabelWeights * weights)
    : m_Image(image)
    , m_Weights(weights)
    , m_Region(image.GetLargestPossibleRegion())
  {}

  SizeValueType
  GetWidth() const
  {
    return m_Region.GetSize(0) + 2;
  }
  SizeValueType
  GetHeight() const
  {
    return m_Region.GetSize(1) + 2;
  }
  SizeValueType
  GetDepth() const
  {
    return m_Region.GetSize(2) + 2;
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
    return FCCLattice::Parity(m_Region.GetIndex(1) + static_cast<IndexValueType>(j),
                              m_Region.GetIndex(2) + static_cast<IndexValueType>(k));
  }

  /** The index of the site at a step from the site at an index. */
  Index<3>
  Step(const Index<3> & from, const FCCLattice::SiteType & step) const
  {
    return from + FCCLattice::OffsetOf(
                    step, this->GetParity(static_cast<SizeValueType>(from[1]), static_cast<SizeValueType>(from[2])));
  }

  /** The label of a site; 0 outside of the image. */
  LabelType
  GetLabel(const Index<3> & site) const;

  /** The weights of some labels at a site of a label, stored or not (see FCCLabelWeights). */
  template <std::size_t VSize>
  void
  GetWeights(const Index<3> & site,
             LabelType own,
             const std::array<LabelType, VSize> & labels,
             std::array<double, VSize> & weights) const
  {
    for (std::size_t n = 0; n < VSize; ++n)
    {
      weights[n] = labels[n] == own ? FCCLabelWeights::Limit : -FCCLabelWeights::Limit;
    }
    if (SizeValueType row = 0; m_Weights != nullptr && this->FindImageRow(site, row))
    {
      m_Weights->ForEachAt(row, static_cast<std::uint32_t>(site[0] - 1), [&](LabelType label, float weight) {
        for (std::size_t n = 0; n < VSize; ++n)
        {
          weights[n] = labels[n] == label ? weight : weights[n];
        }
      });
    }
  }

  /** The point in the world at some lattice steps from the site at an index. */
  TriangleSurface::PointType
  GetPoint(const Index<3> & index, const PositionType & steps) const;

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
  /** The row of the image that a row of the box is; false for the layer around it. */
  bool
  FindImageRow(SizeValueType j, SizeValueType k, SizeValueType & row) const
  {
    row = (k - 1) * m_Region.GetSize(1) + j - 1;
    return j >= 1 && k >= 1 && j <= m_Region.GetSize(1) && k <= m_Region.GetSize(2);
  }

  /** The row of the image that a site is in; false for the layer around it. */
  bool
  FindImageRow(const Index<3> & site, SizeValueType & row) const
  {
    return site[0] >= 1 && static_cast<SizeValueType>(site[0]) <= m_Region.GetSize(0) &&
           this->FindImageRow(static_cast<SizeValueType>(site[1]), static_cast<SizeValueType>(site[2]), row);
  }

  const ImageType & m_Image;
  const FCCLabelWeights * m_Weights;
  ImageRegion<3> m_Region;
};

/** \class FCCLabelPart
 * \brief The points of a part of the simplices of one type that a row of sites stores. */
struct FCCLabelPart
{
  FCCNumberedBits::Row row;
  IndexValueType shift; ///< from the simplex's lowest site to the part's, in indices

  std::uint32_t
  GetNumber(SizeValueType i) const
  {
    return row.GetNumber(i + static_cast<SizeValueType>(shift));
  }

  /** The simplices of one word whose part has a point. */
  FCCBits::WordType
  GetBits(SizeValueType word) const
  {
    return FCCBits::Shifted(row.bits, word, shift);
  }
};

/** \class FCCLabelPlane
 * \brief The simplices that one plane of sites stores and that hold a point of the walls, and the numbers of the
 * points.
 *
 * Points are numbered row by row, within a row type by type, within a type along x. */
class FCCLabelPlane
{
public:
  explicit FCCLabelPlane(const FCCLabelBox & box);

  /** Finds the cut edges that plane \a k stores. */
  void
  FindEdges(SizeValueType k, const FCCLabelBox::Plane & labels, const FCCLabelBox::Plane & next);

  /** Finds the faces and tetrahedra, of which all edges are cut, from the edges of this plane and the next. */
  void
  FindFacesAndTetrahedra(const FCCLabelPlane & next);

  /** Numbers the points from \a first on. */
  void
  Number(std::uint32_t first)
  {
    m_Bits.Number(first);
  }

  const FCCLabelBox &
  GetBox() const
  {
    return m_Box;
  }

  SizeValueType
  GetPlane() const
  {
    return m_K;
  }

  FCCNumberedBits::Row
  GetRow(SizeValueType j, unsigned int type) const
  {
    return m_Bits.GetNumberedRow(j * FCCCells::Types + type);
  }

  /** Whether the j-th row may store simplices that hold a point.
   * \param next the next plane */
  bool
  MayHavePoints(const FCCLabelPlane & next, SizeValueType j) const;

  /** A part of the simplices of some type that the j-th row stores.
   * \param next the next plane
   * \param set sites of the part, bit n for the n-th of the simplex */
  FCCLabelPart
  GetPart(const FCCLabelPlane & next, SizeValueType j, unsigned int type, unsigned int set) const;

private:
  const FCCLabelBox & m_Box;
  SizeValueType m_K{ 0 };
  FCCNumberedBits m_Bits;
  std::vector<std::uint8_t> m_HasCutEdges; ///< by row
};

} // namespace itk

#endif
