#ifndef rhombicPictureComparison_h
#define rhombicPictureComparison_h

#include "rhombicPicture.h"

#include <cstddef>

namespace rhombic
{

/** Differences between two pictures. Errors are differences of sRGB components from 0 to 1. */
struct PictureDifference
{
  double meanError = 0.0;
  double rmsError = 0.0;
  double maxError = 0.0;
  std::size_t differingPixels = 0; ///< number of pixels with a component that differs by more than the threshold
  int worstX = 0;                  ///< column of the largest error, from the left
  int worstY = 0;                  ///< row of the largest error, from the top
};

/** Compares two pictures pixel by pixel; \a threshold is a difference of components from 0 to 1.
 *
 * Throws Failure(Usage) when the sizes differ or a picture has no pixels. */
PictureDifference
ComparePictures(const Picture & a, const Picture & b, double threshold);

} // namespace rhombic

#endif
