#ifndef itkCartesianToFCCRows_h
#define itkCartesianToFCCRows_h

#include "detail/itkRowPasses.h"
#include "itkImageBase.h"
#include "itkSliceStack.h"

#include <optional>
#include <vector>

namespace itk
{

/** \class CartesianToFCCRows
 * \brief The kernel of CartesianToFCCImageFilter: values of a Cartesian volume at the sites of a lattice, for any pixel
 * type and any part of the volume in memory.
 *
 * Thread safety: all methods may run on any number of threads at once. */
class CartesianToFCCRows
{
public:
  using RegionType = ImageRegion<3>;
  using SliceOriginsType = std::vector<Point<double, 3>>;

  /** \param volume gives geometry and size; must outlive this, as the lattice must
   *  \param lattice has the volume's axes, or those of its SliceStack if it is slanted
   *  \param sliceOrigins as CartesianToFCCImageFilter::SetSliceOrigins() */
  CartesianToFCCRows(const ImageBase<3> & volume,
                     const ImageBase<3> & lattice,
                     SeparableKernel kernel,
                     const SliceOriginsType & sliceOrigins);

  /** The samples of the volume on which the values at some sites depend.
   * \param sites region of the lattice, not empty */
  RegionType
  FindNeededSamples(const RegionType & sites) const;

  /** Computes the values at some sites. Sites beside a slanted volume get none: see StoreRow.
   * \param sites region of the lattice, not empty
   * \param load is asked for samples by their indices in the volume */
  void
  Resample(const RegionType & sites, const LoadRow & load, const StoreRow & store) const;

private:
  /** Taps for the sites of the region along one axis; along x, for the rows of one parity. */
  SeparableTaps
  MakeTaps(unsigned int axis, const RegionType & sites, IndexValueType parity = 0) const;

  const ImageBase<3> & m_Volume;
  const ImageBase<3> & m_Lattice;
  SeparableKernel m_Kernel;
  std::optional<SliceStack> m_Stack; ///< of a slanted volume
};

} // namespace itk

#endif
