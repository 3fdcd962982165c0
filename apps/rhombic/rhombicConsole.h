#ifndef rhombicConsole_h
#define rhombicConsole_h

#include "rhombicEvents.h"

#include <string>

namespace rhombic
{

/** How much the program says on standard error. */
enum class Verbosity
{
  Quiet,  ///< errors only
  Normal, ///< what was found and decided, and a progress bar on a terminal
  Verbose ///< the same with the time before each line, and each step's name where there is no terminal
};

/** \class Console
 * \brief Everything the program says besides its results: one progress bar on a terminal, plain lines elsewhere. */
class Console
{
public:
  Console();

  void
  SetVerbosity(Verbosity verbosity);

  /** The functions through which a pipeline speaks to this console, which must outlive them. */
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
