#ifndef itkForEachBlock_h
#define itkForEachBlock_h

#include "itkMultiThreaderBase.h"
#include "itkThreadFailure.h"

#include <algorithm>

namespace itk
{

/** Calls \a work(begin, end) for [0, size) cut into blocks of \a blockSize, on the threads of a new MultiThreaderBase.
 * An exception of one block is thrown after all have ended. Thread safety: \a work is called on several threads at
 * once.
 */
template <typename TWork>
void
ForEachBlock(std::size_t size, std::size_t blockSize, const TWork & work)
{
  ThreadFailure failure;
  MultiThreaderBase::New()->ParallelizeArray(
    0,
    (size + blockSize - 1) / blockSize,
    [&](SizeValueType block) {
      failure.Capture([&] {
        const std::size_t begin = block * blockSize;
        work(begin, std::min(size, begin + blockSize));
      });
    },
    nullptr);
  failure.Rethrow();
}

/** The same, calling work(i) for each i. */
template <typename TWork>
void
ForEachInBlocks(std::size_t size, std::size_t blockSize, const TWork & work)
{
  ForEachBlock(size, blockSize, [&work](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
    {
      work(i);
    }
  });
}

} // namespace itk

#endif
