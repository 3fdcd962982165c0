#ifndef itkParallelBlocks_h
#define itkParallelBlocks_h

#include "itkMultiThreaderBase.h"
#include "itkThreadFailure.h"

#include <algorithm>

namespace itk
{

/** Calls work(i) for each i from 0 to count - 1, \a block of them after each other on one thread. The first exception
 * is thrown after all threads are done. */
template <typename TWork>
void
ForEachInBlocks(SizeValueType count, SizeValueType block, const TWork & work)
{
  ThreadFailure failure;
  MultiThreaderBase::New()->ParallelizeArray(
    0,
    (count + block - 1) / block,
    [&](SizeValueType b) {
      failure.Capture([&] {
        for (SizeValueType i = b * block; i < std::min(count, (b + 1) * block); ++i)
        {
          work(i);
        }
      });
    },
    nullptr);
  failure.Rethrow();
}

} // namespace itk

#endif
