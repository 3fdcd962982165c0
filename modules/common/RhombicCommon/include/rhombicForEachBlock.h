#ifndef rhombicForEachBlock_h
#define rhombicForEachBlock_h

#include <algorithm>
#include <cstddef>
#include <functional>

namespace rhombic
{

/** Calls \a work(n) for each n below \a count, on this thread and on idle threads of ITK's pool: at most
 * MultiThreaderBase's global default number of threads in all. Returns after the last call. After an exception no
 * further call begins, and the first exception is thrown. Unlike MultiThreaderBase, it never waits for a pool thread
 * that has not started yet, so jobs of the pool may call it without a deadlock. Thread safety: \a work is called on
 * several threads at once, and any number of threads may call this. */
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

} // namespace rhombic

#endif
