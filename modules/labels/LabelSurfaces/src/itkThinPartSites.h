#ifndef itkThinPartSites_h
#define itkThinPartSites_h

#include "itkFCCLattice.h"
#include "itkImage.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace itk
{

/** The sites whose Voronoi cells hold a part of the middle of thin parts, sorted. The middle is made of the convex
 * hulls of the inside voxels' centres in each cube of eight neighbouring centres that has a thin voxel. Voronoi cells
 * are convex and fill space, so the sites of a middle that is connected are connected, and those of a plane have no
 * holes.
 *
 * \param mask voxels other than 0 are inside
 * \param region the voxels of the mask that count
 * \param thin offsets of the thin voxels in the mask's buffer, ascending
 * \param placeVoxel gives the position of a voxel's centre in lattice coordinates */
std::vector<FCCLattice::SiteType>
FindThinPartSites(const Image<std::uint8_t, 3> & mask,
                  const ImageRegion<3> & region,
                  const std::vector<SizeValueType> & thin,
                  const std::function<std::array<double, 3>(const Index<3> &)> & placeVoxel);

} // namespace itk

#endif
