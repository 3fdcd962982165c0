#ifndef rhombicEvents_h
#define rhombicEvents_h

#include "itkProcessObject.h"

#include <functional>
#include <string>

namespace rhombic
{

/** \class Events
 * \brief Callbacks for the notes and the progress of long work. Either may be empty.
 *
 * Thread safety: both are called on the thread that called the pipeline. Pipelines that run at the same time need
 * events of their own, or functions that any number of threads may call. */
struct Events
{
  /** Called with one line about a finished step or a decision. */
  std::function<void(const std::string & line)> note;

  /** Called with the progress of the current step, from 0 to 1. */
  std::function<void(const std::string & step, double fraction)> progress;

  /** Calls note, unless it is empty. */
  void
  Note(const std::string & line) const
  {
    if (note)
    {
      note(line);
    }
  }

  /** Calls progress, unless it is empty. */
  void
  Progress(const std::string & step, double fraction) const
  {
    if (progress)
    {
      progress(step, fraction);
    }
  }
};

/** Reports a filter's progress to Events::progress as that of \a step. \a events must outlive the filter's work. Thread
 * safety: that of itk::Object::AddObserver(). */
inline void
ObserveProgress(itk::ProcessObject & filter, const std::string & step, const Events & events)
{
  filter.AddObserver(itk::ProgressEvent(), [&filter, step, &events](const itk::EventObject &) {
    events.Progress(step, static_cast<double>(filter.GetProgress()));
  });
}

} // namespace rhombic

#endif
