#ifndef rhombicSliceOrigins_h
#define rhombicSliceOrigins_h

#include "rhombicScan.h"

#include <vector>

namespace rhombic
{

/** The position of the first voxel of each slice in LPS mm, for evenly spaced slices, too (see Scan::sliceOrigins).
 * Thread safe. */
std::vector<itk::Point<double, 3>>
SliceOriginsOf(const Scan & scan);

} // namespace rhombic

#endif
