#ifndef rhombicEvents_h
#define rhombicEvents_h

#include <functional>
#include <string>

namespace rhombic
{

/** \class Events
 * \brief What a pipeline tells its caller while it works. Both functions are called on the calling thread; either may
 * be empty. */
struct Events
{
  /** A finished step or a decision taken, one line. */
  std::function<void(const std::string & line)> note;

  /** Progress of the step at work, from 0 to 1. */
  std::function<void(const std::string & step, double fraction)> progress;

  void
  Note(const std::string & line) const
  {
    if (note)
    {
      note(line);
    }
  }

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
