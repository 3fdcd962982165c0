#ifndef rhombicConsole_h
#define rhombicConsole_h

#include "rhombicEvents.h"

#include <string>

namespace rhombic
{

/** Amount of messages on standard error. */
enum class Verbosity
{
  Quiet,  ///< errors only
  Normal, ///< also notes, and a progress bar on a terminal
  Verbose ///< also the time before each line, and without a terminal the name of each step
};

/** \class Console
 * \brief Messages of the program on standard error: one progress bar on a terminal, plain lines elsewhere. */
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

private:
  void
  Progress(const std::string & step, double fraction);

  Verbosity m_Verbosity = Verbosity::Normal;
  bool m_IsTerminal;
  std::string m_Step;
  int m_Percent = -1;
};

} // namespace rhombic

#endif
