#ifndef rhombicDrawnMaps_h
#define rhombicDrawnMaps_h

#include "itkImage.h"

#include <cstdint>

namespace rhombic
{

/** \file
 * Label maps as they are drawn by hand, slice by slice: in each slice the border is off by up to half a pixel,
 * smoothly, and 5 % of the border's pixels have the label of the other side. The same voxels at each call. */

using DrawnMap = itk::Image<std::uint16_t, 3>;

/** Eleven ellipsoids in place of abdominal organs, some of which touch: 384 x 320 x 89 voxels of 0.78 x 0.78 x 5 mm. */
DrawnMap::Pointer
DrawThickOrgans();

/** Three tissues, each inside the one before, the inner two with folds as a brain has them: 207 x 256 x 215 voxels of
 * 1 mm. */
DrawnMap::Pointer
DrawNestedTissues();

} // namespace rhombic

#endif
