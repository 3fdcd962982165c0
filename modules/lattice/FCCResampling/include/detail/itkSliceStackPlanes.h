#ifndef itkSliceStackPlanes_h
#define itkSliceStackPlanes_h

#include "detail/itkRowArithmetic.h"
#include "itkFCCLattice.h"
#include "itkImageRegion.h"
#include "itkSliceStack.h"

#include <array>
#include <vector>

namespace itk
{

/** \class SliceStackPlanes
 * \brief Where the sites of a region of an FCC lattice lie between the samples of a SliceStack.
 *
 * The lattice's axes are the stack's frame. A plane of constant z is blended from slices, row by row; in that blend
 * rows and columns of samples start at the plane's own origin. Planes and rows of sites are counted from the region's
 * first ones, samples from the stack's first one. Positions depend on a site's index alone, not on the region.
 *
 * \ingroup FCCResampling
 */
class SliceStackPlanes
{
public:
  using VectorType = SliceStack::VectorType;
  using RegionType = ImageRegion<3>;

  /** \param stack must outlive this
   *  \param origin of the lattice, in the stack's frame (mm)
   *  \param spacing of the lattice, in mm
   *  \param size of the stack, in samples
   *  \param region of the lattice, not empty */
  SliceStackPlanes(const SliceStack & stack,
                   SeparableKernel kernel,
                   const Size<3> & size,
                   const VectorType & origin,
                   const VectorType & spacing,
                   const RegionType & region);

  /** The slices each plane is blended from. */
  const SeparableTaps &
  GetSliceTaps() const
  {
    return m_SliceTaps;
  }

  /** The position in rows of samples, a real number, of each row of sites of plane \a k. */
  std::vector<double>
  GetRows(SizeValueType k) const;

  /** Whether a position in rows of samples lies in the stack's voxels. */
  bool
  HasRow(double row) const;

  /** The taps of all \a rows, as GetRows() returns them. */
  SeparableTaps
  MakeRowTaps(const std::vector<double> & rows) const
  {
    return SeparableTaps(m_Kernel, m_Size[1], rows);
  }

  /** Whether each row of sites has taps of its own, because the in-plane axes are not perpendicular. Otherwise all rows
   * of a plane with the same parity share them. */
  bool
  AreRowsShifted() const
  {
    return m_Stack.AreRowsShifted();
  }

  /** The sites of a row: those from \a begin to before \a end lie in the stack's voxels. */
  struct SiteRow
  {
    SizeValueType begin;
    SizeValueType end;
    RowArithmetic::RowTaps taps; ///< taps of all sites
  };

  /** \param k plane
   *  \param row position in rows of samples
   *  \param parity of the row of sites
   *  \param xFirst sample that is the first one of the rows to interpolate */
  SiteRow
  MakeSiteRow(SizeValueType k, double row, IndexValueType parity, SizeValueType xFirst) const;

  /** The samples that all sites are made of; its index counts from the stack's first sample. */
  RegionType
  FindNeededSamples() const;

private:
  /** The position along the row of samples, a real number, of each site of a row of plane \a k. */
  std::vector<double>
  GetColumns(SizeValueType k, double row, IndexValueType parity) const;

  SeparableTaps
  MakeColumnTaps(const std::vector<double> & columns) const
  {
    return SeparableTaps(m_Kernel, m_Size[0], columns);
  }

  const SliceStack & m_Stack;
  SeparableKernel m_Kernel;
  Size<3> m_Size;
  VectorType m_Origin;
  VectorType m_Spacing;
  RegionType m_Region;
  std::vector<double> m_Heights;
  SeparableTaps m_SliceTaps;
  std::vector<std::array<double, 2>> m_PlaneOrigins;
};

} // namespace itk

#endif
