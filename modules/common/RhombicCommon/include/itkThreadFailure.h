#ifndef itkThreadFailure_h
#define itkThreadFailure_h

#include <atomic>
#include <exception>
#include <mutex>
#include <utility>

namespace itk
{

/** \class ThreadFailure
 * \brief Carries the first exception of a filter's threads to the thread that called it.
 *
 * The thread pool of ITK 5.2 drops exceptions of all its threads but the calling one, and the filter's Update() would
 * return as if nothing had failed. Each thread works inside Capture(); after all have joined, the caller calls
 * Rethrow().
 *
 * Thread safety: Capture() may run on any number of threads at once.
 */
class ThreadFailure
{
public:
  /** Calls work() and keeps its exception, unless there is one already. */
  template <typename TWork>
  void
  Capture(const TWork & work)
  {
    if (m_HasFailed)
    {
      return;
    }
    try
    {
      work();
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(m_Mutex);
      if (!m_First)
      {
        m_First = std::current_exception();
        m_HasFailed = true;
      }
    }
  }

  /** Throws the first captured exception, if there is one, and forgets it. */
  void
  Rethrow()
  {
    if (const std::exception_ptr first = std::exchange(m_First, nullptr))
    {
      m_HasFailed = false;
      std::rethrow_exception(first);
    }
  }

private:
  std::mutex m_Mutex;
  std::exception_ptr m_First;
  std::atomic<bool> m_HasFailed{ false };
};

} // namespace itk

#endif
