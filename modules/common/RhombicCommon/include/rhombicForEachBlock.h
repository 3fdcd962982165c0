#ifndef rhombicForEachBlock_h
#define rhombicForEachBlock_h

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>

namespace rhombic
{

/** Receives the share of some work that is done, from 0 to 1 and never falling, on the thread that called for the work.
 * May throw to end the work. */
using ProgressFunction = std::function<void(double share)>;

/** \class StagedProgress
 * \brief Progress of work in stages, each of which consists of parts that threads share.
 *
 * The thread that constructs it reports, as often as it ends a part. What the report throws ends the loop of
 * ForEachOnThreads() in which it is called.
 *
 * Thread safety: any number of threads may call Completed(); the rest is for the thread that constructs it.
 */
class StagedProgress
{
public:
  /** \param report may be empty */
  explicit StagedProgress(ProgressFunction report)
    : m_Report(std::move(report))
  {}

  /** Begins a stage. The stage before is complete.
   *  \param end share of the whole that is done after the stage
   *  \param parts number of the stage's parts */
  void
  Begin(double end, std::size_t parts)
  {
    m_Begin = m_End;
    m_End = std::clamp(end, m_Begin, 1.0);
    m_Parts = std::max<std::size_t>(1, parts);
    m_Completed = 0;
    this->Completed(0);
  }

  /** Counts parts of the stage that are done. */
  void
  Completed(std::size_t parts)
  {
    const std::size_t completed = std::min(m_Completed += parts, m_Parts);
    if (m_Report && std::this_thread::get_id() == m_Thread)
    {
      m_Report(m_Begin + (m_End - m_Begin) * static_cast<double>(completed) / static_cast<double>(m_Parts));
    }
  }

private:
  const ProgressFunction m_Report;
  const std::thread::id m_Thread = std::this_thread::get_id();
  double m_Begin = 0.0; ///< share of the whole before the stage
  double m_End = 0.0;   ///< share of the whole after the stage
  std::size_t m_Parts = 1;
  std::atomic<std::size_t> m_Completed{ 0 };
};

/** Calls \a work(n) for each n below \a count, on this thread and on idle threads of ITK's pool: at most
 * MultiThreaderBase's global default number of threads in all. Returns after the last call. After an exception no
 * further call begins, and the first exception is thrown. Unlike MultiThreaderBase, it never waits for a pool thread
 * that has not started yet, so jobs of the pool may call it without a deadlock. Thread safety: \a work is called on
 * several threads at once, and any number of threads may call this.
 * \param report receives the share of calls that have ended, after each call on this thread, and 1 at the end; may be
 * empty */
void
ForEachOnThreads(std::size_t count,
                 const std::function<void(std::size_t)> & work,
                 const ProgressFunction & report = {});

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
