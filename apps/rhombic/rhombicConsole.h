#ifndef rhombicConsole_h
#define rhombicConsole_h

#include "rhombicEvents.h"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace rhombic
{

/** Amount of messages on standard error. */
enum class Verbosity
{
  Quiet,  ///< errors only
  Normal, ///< also notes, and a progress bar on a terminal
  Verbose ///< also the time before each line, without a terminal the name of each step, and the times of all steps
};

/** \class Console
 * \brief Messages of the program on standard error: one progress bar on a terminal, plain lines elsewhere, of steps
 * that take long one each minute. Both tell how much comes from the disk and the time left, once a step lasts a while.
 */
class Console
{
public:
  Console();

  void
  SetVerbosity(Verbosity verbosity);

  /** Events that write to this console, which must outlive them. */
  Events
  MakeEvents();

  void
  Note(const std::string & line);

  void
  Error(const std::string & sentence);

  /** Ends the progress bar, if there is one. */
  void
  Finish();

  /** With Verbosity::Verbose: writes the time of each kind of step, which is the first word of the step ("untangling"),
   * and its share. A step lasts until progress of another one is reported; what was before the first step is "start".
   */
  void
  NoteStepTimes();

private:
  void
  Progress(const std::string & step, double fraction);
  void
  AddTimeToStep();
  std::string
  DescribePace(double fraction) const;

  using Clock = std::chrono::steady_clock;

  Verbosity m_Verbosity = Verbosity::Normal;
  bool m_IsTerminal;
  std::string m_Step = "start";
  int m_Percent = -1;
  Clock::time_point m_StepStart = Clock::now();
  Clock::time_point m_LastLine = Clock::now(); ///< without a terminal
  double m_BytesAtStart = 0.0;                 ///< that came from the disk before the step
  std::vector<std::pair<std::string, double>> m_StepSeconds;
};

} // namespace rhombic

#endif
