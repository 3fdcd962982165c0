#ifndef itkInputSamples_h
#define itkInputSamples_h

#include "itkProcessObject.h"

#include <sstream>

namespace itk
{

/** Throws unless an image's buffer holds the samples of a region, in indices of the image, that a filter needs.
 *
 * ITK's pipeline does not guarantee it: the update of an image does nothing if the image has no source, even if its
 * data was released, or if its source failed in an earlier update; and an image that was never allocated has a buffered
 * region too. The message names a remedy. */
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

/** The same for the requested region of the input. */
template <typename TImage>
void
VerifyInputSamples(const ProcessObject & filter, const TImage & input)
{
  VerifyInputSamples(filter, input, input.GetRequestedRegion());
}

} // namespace itk

#endif
