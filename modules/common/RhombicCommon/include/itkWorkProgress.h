#ifndef itkWorkProgress_h
#define itkWorkProgress_h

#include "itkCommand.h"
#include "itkMultiThreaderBase.h"
#include "itkProcessObject.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
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

/** \class WorkProgress
 * \brief Progress and abort checks of a filter whose threads share its work.
 *
 * Observers of ProgressEvent see 0 when this is constructed, then steps of 1/128 that never fall and never pass 1, and
 * 1 on Finish(). TotalProgressReporter adds up rounded fractions instead, which may pass 1 and wrap around for a moment
 * when several threads report, and checks for an abort only when it reports, which is too seldom for long work.
 *
 * Work is counted in any unit. Threads that work in many small portions report through a Share of their own.
 *
 * Thread safety: CheckAbort() and Completed() may run on any number of threads at once, a Share on one; the rest
 * belongs to the thread that called the filter. Observers run on that thread only.
 */
class WorkProgress
{
public:
  WorkProgress(ProcessObject & filter, SizeValueType work)
    : m_Filter(filter)
    , m_Work(std::max<SizeValueType>(1, work))
  {
    m_Filter.UpdateProgress(0.0f);
  }

  /** Throws ProcessAborted if a filter's AbortGenerateData is on. */
  static void
  CheckAbort(const ProcessObject & filter)
  {
    if (filter.GetAbortGenerateData())
    {
      ProcessAborted aborted(__FILE__, __LINE__);
      aborted.SetLocation(ITK_LOCATION);
      aborted.SetDescription(std::string(filter.GetNameOfClass()) + ": AbortGenerateData was set.");
      throw aborted;
    }
  }

  /** The same for the filter whose progress this is. */
  void
  CheckAbort() const
  {
    CheckAbort(m_Filter);
  }

  /** Counts work that is done, and checks for an abort. */
  void
  Completed(SizeValueType work)
  {
    this->Add(work);
    this->CheckAbort();
  }

  /** Calls work(n) for each n below \a count on the threads of a filter, and checks for an abort before each call and
   * behind the last. A thread that has ended a call takes the next n, so that the calls may take different times. After
   * an exception no further call begins, and the first exception is thrown. Other threads may make all calls: observers
   * of ProgressEvent, which ITK calls only on the thread that called the filter, are called once more at the end. */
  template <typename TWork>
  static void
  ForEach(ProcessObject & filter, SizeValueType count, const TWork & work)
  {
    ThreadFailure failure;
    std::atomic<SizeValueType> next{ 0 };
    const auto workAtRest = [&](SizeValueType) {
      for (SizeValueType n = next++; n < count; n = next++)
      {
        failure.Capture([&] {
          CheckAbort(filter);
          work(n);
        });
      }
    };
    MultiThreaderBase * const threader = filter.GetMultiThreader();
    threader->SetNumberOfWorkUnits(filter.GetNumberOfWorkUnits());
    threader->ParallelizeArray(0, std::min<SizeValueType>(count, filter.GetNumberOfWorkUnits()), workAtRest, nullptr);
    failure.Rethrow();
    filter.IncrementProgress(0.0f);
    CheckAbort(filter);
  }

  /** The same for the filter whose progress this is. */
  template <typename TWork>
  void
  ForEach(SizeValueType count, const TWork & work)
  {
    ForEach(m_Filter, count, work);
  }

  /** The work that has been counted. */
  SizeValueType
  GetCompleted() const
  {
    return m_Done;
  }

  /** Reports that all work is done. */
  void
  Finish()
  {
    m_Filter.UpdateProgress(1.0f);
  }

  /** \class Share
   * \brief Progress of one thread: adds up small portions of work and reports them in steps.
   *
   * Thread safety: each belongs to one thread; several may run at once. */
  class Share
  {
  public:
    explicit Share(WorkProgress & whole)
      : m_Whole(whole)
    {}

    /** As WorkProgress::CheckAbort(). */
    void
    CheckAbort() const
    {
      m_Whole.CheckAbort();
    }

    /** As WorkProgress::Completed(). */
    void
    Completed(SizeValueType work)
    {
      m_Pending += work;
      if (m_Pending >= m_Whole.m_Work / (8 * Steps))
      {
        m_Whole.Add(std::exchange(m_Pending, 0));
      }
      m_Whole.CheckAbort();
    }

  private:
    WorkProgress & m_Whole;
    SizeValueType m_Pending{ 0 };
  };

private:
  static constexpr SizeValueType Steps = 128; // a power of two: their sum is exact

  void
  Add(SizeValueType work)
  {
    const SizeValueType before = m_Done.fetch_add(work);
    const SizeValueType steps = this->StepOf(before + work) - this->StepOf(before);
    if (steps > 0)
    {
      m_Filter.IncrementProgress(static_cast<float>(steps) / static_cast<float>(Steps));
    }
  }

  SizeValueType
  StepOf(SizeValueType done) const
  {
    return std::min(done, m_Work) * Steps / m_Work;
  }

  ProcessObject & m_Filter;
  SizeValueType m_Work;
  std::atomic<SizeValueType> m_Done{ 0 };
};

/** \class AbortForwarding
 * \brief As long as it exists, an abort of a filter also aborts the process objects upstream of its input.
 *
 * For filters that update their input piece by piece in GenerateData(), where ITK does not pass an abort upstream. Each
 * upstream process object checks the filter's AbortGenerateData at its own ProgressEvents. It then throws
 * ProcessAborted through the input's Update(), or ends without an exception, as StreamingImageFilter does: the caller
 * has to check AbortGenerateData after the update and discard the incomplete data. A process object that reports no
 * progress runs to its end.
 *
 * Thread safety: for the thread that updates the filter.
 */
class AbortForwarding
{
public:
  AbortForwarding(const ProcessObject & filter, const DataObject & input)
    : m_Filter(filter)
  {
    this->Observe(input);
  }

  AbortForwarding(const AbortForwarding &) = delete;
  AbortForwarding &
  operator=(const AbortForwarding &) = delete;

  ~AbortForwarding()
  {
    for (const auto & [source, observer] : m_Observers)
    {
      source->RemoveObserver(observer);
    }
  }

private:
  void
  Observe(const DataObject & data)
  {
    const ProcessObject::Pointer source = data.GetSource().GetPointer();
    if (source == nullptr || m_Observers.count(source) > 0)
    {
      return;
    }
    m_Observers[source] =
      source->AddObserver(ProgressEvent(), [this, source = source.GetPointer()](const EventObject &) {
        if (m_Filter.GetAbortGenerateData() && !source->GetAbortGenerateData())
        {
          source->AbortGenerateDataOn();
        }
      });
    for (const auto & input : source->GetInputs())
    {
      if (input != nullptr)
      {
        this->Observe(*input);
      }
    }
  }

  const ProcessObject & m_Filter;
  std::map<ProcessObject::Pointer, unsigned long> m_Observers;
};

} // namespace itk

#endif
