#ifndef rhombicSlicePicture_h
#define rhombicSlicePicture_h

#include "rhombicGreyWindow.h"
#include "rhombicPicture.h"
#include "rhombicProjection.h"
#include "rhombicScan.h"

#include <array>
#include <cstdint>

namespace rhombic
{

/** Red, green, blue and alpha of pixels outside the scan. */
using SliceBackground = std::array<std::uint8_t, 4>;

/** The greys of a scan in the plane of a projection: the values at the pixels' centres, in a window.
 *
 * Values between samples are interpolated linearly, in slices and between them. Tilted, sheared and unevenly spaced
 * slices (Scan::sliceOrigins) are used at their true positions. The outer half of the outermost voxels has the value at
 * their centres. Pixels outside all voxels, and values that are not a number, get the background.
 *
 * The picture has alpha if the background is not opaque. It has the same bytes for any number of threads. */
Picture
DrawSlice(const Scan & scan,
          const Projection & plane,
          const GreyWindow & window,
          const SliceBackground & background = { 0, 0, 0, 255 });

} // namespace rhombic

#endif
