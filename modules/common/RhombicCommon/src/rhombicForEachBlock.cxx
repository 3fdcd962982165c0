#include "rhombicForEachBlock.h"

#include "itkMultiThreaderBase.h"
#include "itkWorkProgress.h"
#include "itkThreadPool.h"

#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>

namespace rhombic
{
namespace
{

/** Work that threads share piece by piece. Pool threads may start after all is done; each of them keeps it alive. */
class SharedWork
{
public:
  SharedWork(std::size_t count, const std::function<void(std::size_t)> & work)
    : m_Count(count)
    , m_Work(work)
  {}

  /** Works on pieces while there are any, and reports the share of pieces that have ended. */
  void
  Help(const ProgressFunction & report = {})
  {
    for (std::size_t n = m_Next++; n < m_Count; n = m_Next++)
    {
      m_Failure.Capture([&] {
        m_Work(n);
        const std::size_t done = ++m_Done;
        if (report)
        {
          report(static_cast<double>(done) / static_cast<double>(m_Count));
        }
      });
      const std::lock_guard<std::mutex> lock(m_Mutex);
      if (++m_Ended == m_Count)
      {
        m_AllEnded.notify_one();
      }
    }
  }

  /** Waits for the pieces of the other threads. */
  void
  Join()
  {
    std::unique_lock<std::mutex> lock(m_Mutex);
    m_AllEnded.wait(lock, [this] { return m_Ended == m_Count; });
    m_Failure.Rethrow();
  }

private:
  std::size_t m_Count;
  const std::function<void(std::size_t)> & m_Work; ///< valid until all pieces have ended
  std::atomic<std::size_t> m_Next{ 0 };
  std::atomic<std::size_t> m_Done{ 0 }; ///< pieces that ended without an exception
  std::size_t m_Ended{ 0 };
  std::mutex m_Mutex;
  std::condition_variable m_AllEnded;
  itk::ThreadFailure m_Failure;
};

} // namespace

void
ForEachOnThreads(std::size_t count, const std::function<void(std::size_t)> & work, const ProgressFunction & report)
{
  const auto shared = std::make_shared<SharedWork>(count, work);
  const std::size_t threads = std::min<std::size_t>(count, itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads());
  try
  {
    for (std::size_t helper = 1; helper < threads; ++helper)
    {
      itk::ThreadPool::GetInstance()->AddWork([shared] { shared->Help(); });
    }
  }
  catch (const std::exception &) // no memory or no more threads: fewer threads do the work
  {}
  shared->Help(report);
  shared->Join();
  if (report)
  {
    report(1.0);
  }
}

} // namespace rhombic
