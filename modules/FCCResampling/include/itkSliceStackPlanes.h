#ifndef itkSliceStackPlanes_h
#define itkSliceStackPlanes_h

#include "itkFCCLattice.h"
#include "itkImageRegion.h"
#include "itkSliceStack.h"

#include <array>
#include <vector>

namespace itk
{

/** \class SliceStackPlanes
 * \brief How the sites of a part of an FCC lattice are made of the samples of a SliceStack.
 *
 * The lattice's axes are the stack's frame. A plane of constant z is blended from slices, row by row; in that blend
 * rows and columns of samples lie at an origin of the plane's own. Planes, rows and positions are counted from the
 * part's first ones, samples from the stack's. Everything depends on a site's index alone, not on the part.
 *
 * Immutable after construction, so thread safe.
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

  /** The slices each plane is made of. */
  const SeparableTaps &
  GetSliceTaps() const
  {
    return m_SliceTaps;
  }

  /** The row of samples, any real number, at each row of plane \a k. */
  std::vector<double>
  GetRows(SizeValueType k) const;

  /** The column of samples, any real number, at each site of a row of plane \a k.
   *  \param row the row of samples
   *  \param parity that of the sites' row */
  std::vector<double>
  GetColumns(SizeValueType k, double row, IndexValueType parity) const;

  /** What values at \a rows, as GetRows() returns them, are made of. */
  SeparableTaps
  MakeRowTaps(const std::vector<double> & rows) const
  {
    return SeparableTaps(m_Kernel, m_Size[1], rows);
  }
  /** What values at \a columns, as GetColumns() returns them, are made of. */
  SeparableTaps
  MakeColumnTaps(const std::vector<double> & columns) const
  {
    return SeparableTaps(m_Kernel, m_Size[0], columns);
  }

  /** The samples all sites are made of; its index counts from the stack's first sample. */
  RegionType
  FindNeededSamples() const;

private:
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
