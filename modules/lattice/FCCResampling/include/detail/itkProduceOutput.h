#ifndef itkProduceOutput_h
#define itkProduceOutput_h

#include "itkRecyclingMemory.h"
#include "itkImageRegion.h"
#include "itkInputSamples.h"
#include "itkMultiThreaderBase.h"
#include "itkWorkProgress.h"

namespace itk
{

/** The value of \a undivided for a region that may be divided along all axes. */
constexpr unsigned int AllDivided = 3;

/** GenerateData() of this module's filters, after AllocateOutputs(). Checks the input's samples, divides the requested
 * region among threads, calls work(region, progress) for each part, and passes exceptions of \a work on.
 *
 * \param undivided axis along which the region is not divided, or AllDivided */
template <typename TFilter, typename TWork>
void
ProduceOutput(TFilter & filter, unsigned int undivided, const TWork & work)
{
  VerifyInputSamples(filter, *filter.GetInput());
  auto * const output = filter.GetOutput();
  AdviseHugePages(output->GetBufferPointer(),
                  output->GetBufferedRegion().GetNumberOfPixels() * sizeof(*output->GetBufferPointer()));

  const ImageRegion<3> region = output->GetRequestedRegion();
  WorkProgress progress(filter, region.GetNumberOfPixels());
  ThreadFailure failure;
  const auto workOnPart = [&](const ImageRegion<3> & part) {
    failure.Capture([&] {
      WorkProgress::Share share(progress);
      work(part, share);
    });
  };
  MultiThreaderBase * const threader = filter.GetMultiThreader();
  threader->SetNumberOfWorkUnits(filter.GetNumberOfWorkUnits());
  if (undivided != AllDivided)
  {
    threader->ParallelizeImageRegionRestrictDirection<3>(undivided, region, workOnPart, nullptr);
  }
  else
  {
    threader->ParallelizeImageRegion<3>(region, workOnPart, nullptr);
  }
  failure.Rethrow();
  progress.Finish();
}

} // namespace itk

#endif
