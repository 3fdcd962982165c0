#ifndef itkFCCImage_h
#define itkFCCImage_h

#include "itkContinuousIndex.h"
#include "itkFCCExtent.h"
#include "itkNumericTraits.h"
#include "itkSpecialCoordinatesImage.h"

#include <algorithm>

namespace itk
{

/** \class FCCImage
 * \brief A three-dimensional image sampled on the face-centered cubic lattice.
 *
 * Index (i, j, k) is the lattice site (2 i + p, j, k) with p = (j + k) mod 2 (see FCCLattice), in dense storage: memory
 * is the number of samples. The site with lattice coordinates (x, y, z) lies at
 *
 *   point = Origin + Direction * (Spacing[0] x, Spacing[1] y, Spacing[2] z)     [LPS mm]
 *
 * so **Spacing is the unit of the lattice coordinates**, half the edge of the cubic FCC cell along each axis: nearest
 * neighbours are sqrt(2) Spacing apart, samples of one row 2 Spacing[0], and there are 1 / (2 s0 s1 s2) samples per
 * mm^3. Origin is the position of the lattice point (0, 0, 0), which is index (0, 0, 0) whether or not it is in the
 * image. Spacing may differ between the axes, and Direction may be any invertible matrix.
 *
 * The *extent* of an image is the box from half a lattice unit before its first sites to half a unit after its last
 * ones along each axis (see FCCExtent); points in it count as inside.
 *
 * A continuous index is (x / 2, y, z): linear in the point. It equals the index in rows of parity 0; the samples of a
 * row of parity 1 lie at i + 1/2. Interpolators written for Cartesian images are therefore wrong on an FCCImage; use
 * the interpolators of FCCInterpolation.
 *
 * **With ITK's filters.** modules/lattice/FCCLattice/README.md has a table of the filters that work, the filters that
 * have a replacement here, and the filters that are meaningless on a lattice. Pixel-wise filters, iterators, statistics
 * and streaming work. itk::ResampleImageFilter works with FCCImages as its input, its output, or both, if an FCC input
 * gets an interpolator of FCCInterpolation instead of the default interpolator: for a SpecialCoordinatesImage that
 * filter calls the transforms below for every sample instead of assuming that rows are straight. There is deliberately
 * no neighbourhood accessor, so that filters of Cartesian neighbourhoods don't compile; use
 * FCCConstNeighborhoodIterator.
 *
 * The transforms below hide those of ImageBase, which are not virtual: templates of the image's type, as ITK's filters
 * are, use them, but a pointer to ImageBase gives wrong positions. SetSpacing() and SetOrigin() work, unlike those of
 * the superclass, which do nothing.
 *
 * \ingroup FCCLattice
 */
template <typename TPixel>
class ITK_TEMPLATE_EXPORT FCCImage : public SpecialCoordinatesImage<TPixel, 3>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FCCImage);

  using Self = FCCImage;
  using Superclass = SpecialCoordinatesImage<TPixel, 3>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using ConstWeakPointer = WeakPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(FCCImage, SpecialCoordinatesImage);

  using typename Superclass::IndexType;
  using typename Superclass::IndexValueType;
  using typename Superclass::OffsetType;
  using typename Superclass::PixelType;
  using typename Superclass::PointType;
  using typename Superclass::RegionType;
  using typename Superclass::SpacingType;
  using SiteType = FCCLattice::SiteType;

  /** An FCC image of another pixel type. */
  template <typename UPixelType, unsigned int VDimension = 3>
  struct Rebind
  {
    static_assert(VDimension == 3, "The face-centered cubic lattice is three-dimensional");
    using Type = FCCImage<UPixelType>;
  };

  void
  SetSpacing(const SpacingType & spacing) override
  {
    ImageBase<3>::SetSpacing(spacing);
  }
  void
  SetSpacing(const double spacing[3]) override
  {
    ImageBase<3>::SetSpacing(spacing);
  }
  void
  SetSpacing(const float spacing[3]) override
  {
    ImageBase<3>::SetSpacing(spacing);
  }
  void
  SetOrigin(const PointType origin) override
  {
    ImageBase<3>::SetOrigin(origin);
  }
  void
  SetOrigin(const double origin[3]) override
  {
    ImageBase<3>::SetOrigin(origin);
  }
  void
  SetOrigin(const float origin[3]) override
  {
    ImageBase<3>::SetOrigin(origin);
  }

  /** The number of components of the pixel type, as in itk::Image; SpecialCoordinatesImage always returns 1. */
  unsigned int
  GetNumberOfComponentsPerPixel() const override
  {
    return NumericTraits<TPixel>::GetLength({});
  }

  /** Sets all samples, after Allocate(). The superclass's function does not end for 2^32 samples or more. */
  void
  FillBuffer(const TPixel & value)
  {
    std::fill_n(this->GetBufferPointer(), this->GetBufferedRegion().GetNumberOfPixels(), value);
  }

  /** Lattice coordinates of a point, any real numbers. */
  template <typename TCoordRep>
  std::array<double, 3>
  TransformPhysicalPointToLattice(const Point<TCoordRep, 3> & point) const
  {
    std::array<double, 3> coordinates{};
    for (unsigned int row = 0; row < 3; ++row)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        coordinates[row] += this->m_PhysicalPointToIndex[row][axis] * (point[axis] - this->m_Origin[axis]);
      }
    }
    return coordinates;
  }

  /** The point with the given lattice coordinates. */
  template <typename TCoordRep>
  Point<TCoordRep, 3>
  TransformLatticeToPhysicalPoint(const std::array<double, 3> & coordinates) const
  {
    Point<TCoordRep, 3> point;
    for (unsigned int row = 0; row < 3; ++row)
    {
      double sum = this->m_Origin[row];
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        sum += this->m_IndexToPhysicalPoint[row][axis] * coordinates[axis];
      }
      point[row] = static_cast<TCoordRep>(sum);
    }
    return point;
  }

  /** Whether lattice coordinates lie in the extent of a region of this image. */
  static bool
  IsInsideExtent(const std::array<double, 3> & coordinates, const RegionType & region)
  {
    return FCCExtent(region).IsInside(coordinates);
  }

  /** Index of the sample whose Voronoi cell holds the point; returns whether it is in the largest possible region. */
  template <typename TCoordRep>
  bool
  TransformPhysicalPointToIndex(const Point<TCoordRep, 3> & point, IndexType & index) const
  {
    index = FCCLattice::IndexOf(FCCLattice::NearestSite(this->TransformPhysicalPointToLattice(point)));
    return this->GetLargestPossibleRegion().IsInside(index);
  }

  /** The same, inside or not. */
  template <typename TCoordRep>
  IndexType
  TransformPhysicalPointToIndex(const Point<TCoordRep, 3> & point) const
  {
    IndexType index;
    this->TransformPhysicalPointToIndex(point, index);
    return index;
  }

  /** Continuous index of a point; returns whether it is in the extent of the largest possible region. */
  template <typename TCoordRep, typename TIndexRep>
  bool
  TransformPhysicalPointToContinuousIndex(const Point<TCoordRep, 3> & point,
                                          ContinuousIndex<TIndexRep, 3> & index) const
  {
    const auto coordinates = this->TransformPhysicalPointToLattice(point);
    index[0] = static_cast<TIndexRep>(coordinates[0] / 2.0);
    index[1] = static_cast<TIndexRep>(coordinates[1]);
    index[2] = static_cast<TIndexRep>(coordinates[2]);
    return IsInsideExtent(coordinates, this->GetLargestPossibleRegion());
  }

  /** The same, inside or not. */
  template <typename TIndexRep, typename TCoordRep>
  ContinuousIndex<TIndexRep, 3>
  TransformPhysicalPointToContinuousIndex(const Point<TCoordRep, 3> & point) const
  {
    ContinuousIndex<TIndexRep, 3> index;
    this->TransformPhysicalPointToContinuousIndex(point, index);
    return index;
  }

  /** The point, in LPS mm, at a continuous index inside or outside of the image. */
  template <typename TCoordRep, typename TIndexRep>
  void
  TransformContinuousIndexToPhysicalPoint(const ContinuousIndex<TIndexRep, 3> & index,
                                          Point<TCoordRep, 3> & point) const
  {
    point = this->template TransformLatticeToPhysicalPoint<TCoordRep>(
      { 2.0 * static_cast<double>(index[0]), static_cast<double>(index[1]), static_cast<double>(index[2]) });
  }

  /** The same, returned. */
  template <typename TCoordRep, typename TIndexRep>
  Point<TCoordRep, 3>
  TransformContinuousIndexToPhysicalPoint(const ContinuousIndex<TIndexRep, 3> & index) const
  {
    Point<TCoordRep, 3> point;
    this->TransformContinuousIndexToPhysicalPoint(index, point);
    return point;
  }

  /** The point, in LPS mm, of a sample inside or outside of the image. */
  template <typename TCoordRep>
  void
  TransformIndexToPhysicalPoint(const IndexType & index, Point<TCoordRep, 3> & point) const
  {
    const SiteType site = FCCLattice::SiteOf(index);
    point = this->template TransformLatticeToPhysicalPoint<TCoordRep>(
      { static_cast<double>(site[0]), static_cast<double>(site[1]), static_cast<double>(site[2]) });
  }

  /** The same, returned. */
  template <typename TCoordRep>
  Point<TCoordRep, 3>
  TransformIndexToPhysicalPoint(const IndexType & index) const
  {
    Point<TCoordRep, 3> point;
    this->TransformIndexToPhysicalPoint(index, point);
    return point;
  }

  /** Shares another FCCImage's pixels and takes over its geometry and regions. */
  void
  Graft(const Self * image)
  {
    if (image != nullptr)
    {
      Superclass::Graft(image);
      this->SetPixelContainer(const_cast<typename Superclass::PixelContainer *>(image->GetPixelContainer()));
    }
  }

protected:
  FCCImage() = default;
  ~FCCImage() override = default;

  void
  Graft(const DataObject * data) override
  {
    if (data == nullptr)
    {
      return;
    }
    const auto * const image = dynamic_cast<const Self *>(data);
    if (image == nullptr)
    {
      itkExceptionMacro("Only an FCCImage of the same pixel type can be grafted; got " << data->GetNameOfClass());
    }
    this->Graft(image);
  }
};

} // namespace itk

#endif
