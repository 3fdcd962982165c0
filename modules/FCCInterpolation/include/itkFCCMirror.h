#ifndef itkFCCMirror_h
#define itkFCCMirror_h

#include "itkFCCLattice.h"
#include "itkImageRegion.h"

namespace itk
{

/** A whole number mirrored at both ends of a range, which belong to it, as often as needed, into it. The ends are not
 * repeated. Thread safe. */
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

/** The sample of a region that stands for a site outside it: its mirror image in the planes through the region's first
 * and last sites along each axis. These reflections are symmetries of the lattice, so the mirrored samples are one
 * function on all of it. A region one plane thick in y or z repeats that plane, whose parity can't be right
 * everywhere. Thread safe. */
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
