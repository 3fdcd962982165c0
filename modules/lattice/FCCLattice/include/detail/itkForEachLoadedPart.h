#ifndef itkForEachLoadedPart_h
#define itkForEachLoadedPart_h

#include "itkFCCImage.h"

#include <algorithm>

namespace itk
{

/** Calls \a work with the first of some planes, counted from the image's first one, and with their end, while their
 * samples are in the image's buffer, in the order of the planes: with all planes at once, or with as many at a time as
 * the buffer held before, if the image's source makes samples when they are asked for. */
template <typename TPixel, typename TWork>
void
ForEachLoadedPart(FCCImage<TPixel> & image, const TWork & work)
{
  ImageRegion<3> region = image.GetLargestPossibleRegion();
  const SizeValueType depth = region.GetSize(2);
  const IndexValueType first = region.GetIndex(2);
  const SizeValueType atATime = std::max<SizeValueType>(1, image.GetBufferedRegion().GetSize(2));
  for (SizeValueType begin = 0; begin < depth; begin += atATime)
  {
    region.SetIndex(2, first + static_cast<IndexValueType>(begin));
    region.SetSize(2, std::min(atATime, depth - begin));
    if (!image.GetBufferedRegion().IsInside(region))
    {
      image.SetRequestedRegion(region);
      image.PropagateRequestedRegion();
      image.UpdateOutputData();
    }
    work(begin, begin + region.GetSize(2));
  }
}

} // namespace itk

#endif
