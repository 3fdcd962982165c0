#include "rhombicPictureComparison.h"

#include "detail/rhombicPictureCodec.h"
#include "rhombicFailure.h"

#include <string>

namespace rhombic
{
namespace
{

std::string
SizeOf(const Picture & picture)
{
  return std::to_string(picture.width) + " x " + std::to_string(picture.height);
}

} // namespace

PictureDifference
ComparePictures(const Picture & a, const Picture & b, double threshold)
{
  if (a.width != b.width || a.height != b.height || a.channels != b.channels || a.pixels.empty())
  {
    throw Failure(FailureKind::Usage,
                  "Cannot compare a picture of " + SizeOf(a) + " pixels with one of " + SizeOf(b) +
                    "; draw both at the same size.");
  }
  return GetPictureCodec().Compare(a, b, threshold);
}

} // namespace rhombic
