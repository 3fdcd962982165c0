#ifndef itkForEachBlock_h
#define itkForEachBlock_h

#include <algorithm>
#include <cstddef>
#include <functional>

namespace itk
{

/** Calls \a work(n) for each n below \a count, on this thread and those of ITK's thread pool that are free, up to
 * MultiThreaderBase's global default number in all. It waits for nobody who has not begun: so it may be called by jobs
 * of the pool too, where MultiThreaderBase would wait for ever. The first exception is thrown after all have ended.
 * Thread safety: \a work is called on several threads at once, and any number of them may call this. */
void
ForEachOnThreads(std::size_t count, const std::function<void(std::size_t)> & work);

/** Calls \a work(begin, end) for [0, size) cut into blocks of \a blockSize, as ForEachOnThreads() does. */
template <typename TWork>
void
ForEachBlock(std::size_t size, std::size_t blockSize, const TWork & work)
{
  ForEachOnThreads((size + blockSize - 1) / blockSize, [&](std::size_t block) {
    const std::size_t begin = block * blockSize;
    work(begin, std::min(size, begin + blockSize));
  });
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
