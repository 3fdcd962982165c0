#ifndef rhombicEvents_h
#define rhombicEvents_h

#include <functional>
#include <string>

namespace rhombic
{

/** \class Events
 * \brief What a pipeline tells its caller while it works. Either function may be empty.
 *
 * Thread safety: both are called on the thread that called the pipeline. Pipelines that run at the same time need
 * events of their own, or functions that any number of threads may call. */
struct Events
{
  /** A finished step or a decision taken, one line. */
  std::function<void(const std::string & line)> note;

  /** Progress of the step at work, from 0 to 1. */
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

} // namespace rhombic

#endif
