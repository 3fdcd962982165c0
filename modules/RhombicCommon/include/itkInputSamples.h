#ifndef itkInputSamples_h
#define itkInputSamples_h

#include "itkProcessObject.h"

#include <sstream>

namespace itk
{

/** Throws if an image's buffer does not hold the samples of a region, in indices of the image, which a filter needs.
 *
 * A filter that finds out in time says what to do instead of reading beyond the buffer. ITK's pipeline does not see to
 * it: an image without a source that was released after an update is updated again by doing nothing, and so is one
 * whose source failed in the middle of an update; and an image that was never allocated has a buffered region too.
 *
 * Thread safety: any number of threads may call it at once. */
template <typename TImage>
void
VerifyInputSamples(const ProcessObject & filter, const TImage & input, const typename TImage::RegionType & needed)
{
  const auto & buffered = input.GetBufferedRegion();
  const auto * const pixels = input.GetPixelContainer();
  const bool isAllocated = pixels != nullptr && pixels->Size() >= buffered.GetNumberOfPixels();
  if (needed.GetNumberOfPixels() == 0 || (isAllocated && buffered.IsInside(needed)))
  {
    return;
  }
  std::ostringstream text;
  text << filter.GetNameOfClass() << ": of the input, samples " << needed.GetSize() << " from index "
       << needed.GetIndex() << " are needed, but its buffer ";
  if (!isAllocated)
  {
    text << "was never allocated: call its Allocate() and fill it.";
  }
  else
  {
    text << "holds " << buffered.GetSize() << " from " << buffered.GetIndex()
         << (input.GetSource() != nullptr
               ? ", and its source does not make the others: if that failed before, call its ResetPipeline()."
               : " and it has no source: turn its ReleaseDataFlag off, or fill it anew before each update.");
  }
  throw ExceptionObject(__FILE__, __LINE__, text.str(), ITK_LOCATION);
}

/** The same for the samples that the filter has requested of the input. */
template <typename TImage>
void
VerifyInputSamples(const ProcessObject & filter, const TImage & input)
{
  VerifyInputSamples(filter, input, input.GetRequestedRegion());
}

} // namespace itk

#endif
