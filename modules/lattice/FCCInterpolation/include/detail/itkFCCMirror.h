#ifndef itkFCCMirror_h
#define itkFCCMirror_h

#include "itkFCCLattice.h"
#include "itkImageRegion.h"

namespace itk
{

/** Reflects a whole number at the ends of the range from \a first to \a last until it lies in the range. The ends are
 * not repeated: first - 1 becomes first + 1. */
inline IndexValueType
MirrorIntoRange(IndexValueType value, IndexValueType first, IndexValueType last)
{
  const IndexValueType length = last - first;
  if (length == 0)
  {
    return first;
  }
  IndexValueType offset = (value - first) % (2 * length);
  offset = offset < 0 ? offset + 2 * length : offset;
  return first + (offset <= length ? offset : 2 * length - offset);
}

/** Reflects the index of a site at the planes through a region's first and last sites along each axis until it lies in
 * the region. These reflections are symmetries of the lattice, so that the mirrored samples are one function on the
 * whole lattice. A region one plane thick in y or z repeats that plane, although every other plane has the other
 * parity. */
inline Index<3>
MirrorIntoRegion(const Index<3> & index, const ImageRegion<3> & region)
{
  const auto first = region.GetIndex();
  const auto last = region.GetUpperIndex();
  const FCCLattice::SiteType site = FCCLattice::SiteOf(index);
  const IndexValueType x = MirrorIntoRange(site[0], 2 * first[0], 2 * last[0] + 1);
  return { { (x - FCCLattice::Parity(site[1], site[2])) / 2,
             MirrorIntoRange(site[1], first[1], last[1]),
             MirrorIntoRange(site[2], first[2], last[2]) } };
}

} // namespace itk

#endif
