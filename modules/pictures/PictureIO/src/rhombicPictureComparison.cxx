#include "rhombicPictureComparison.h"

#include "rhombicFailure.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

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

/** An image that shares the picture's pixels. OpenImageIO has no image of constant memory, but comparing only reads. */
OIIO::ImageBuf
ViewOf(const Picture & picture)
{
  const OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, OIIO::TypeDesc::UINT8);
  return OIIO::ImageBuf(spec, const_cast<std::uint8_t *>(picture.pixels.data()));
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
  constexpr int oneThread = 1; // the order of summation changes the last digits
  const auto limit = static_cast<float>(threshold);
  const auto result = OIIO::ImageBufAlgo::compare(ViewOf(a), ViewOf(b), limit, limit, OIIO::ROI(), oneThread);
  PictureDifference difference;
  difference.meanError = result.meanerror;
  difference.rmsError = result.rms_error;
  difference.maxError = result.maxerror;
  difference.differingPixels = result.nfail;
  difference.worstX = result.maxx;
  difference.worstY = result.maxy;
  return difference;
}

} // namespace rhombic
