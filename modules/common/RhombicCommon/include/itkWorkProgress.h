#ifndef itkWorkProgress_h
#define itkWorkProgress_h

#include "itkProcessObject.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace itk
{

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

  /** Throws ProcessAborted if the filter's AbortGenerateData is on. */
  void
  CheckAbort() const
  {
    if (m_Filter.GetAbortGenerateData())
    {
      ProcessAborted aborted(__FILE__, __LINE__);
      aborted.SetLocation(ITK_LOCATION);
      aborted.SetDescription(std::string(m_Filter.GetNameOfClass()) + ": AbortGenerateData was set.");
      throw aborted;
    }
  }

  /** Counts work that is done, and checks for an abort. */
  void
  Completed(SizeValueType work)
  {
    this->Add(work);
    this->CheckAbort();
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

} // namespace itk

#endif
