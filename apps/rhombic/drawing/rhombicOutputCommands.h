#ifndef rhombicOutputCommands_h
#define rhombicOutputCommands_h

#include "rhombicCommands.h"
#include "rhombicPipelineFile.h"

#include <map>
#include <string>
#include <vector>

namespace rhombic
{

/** \class OutputCommands
 * \brief The commands that make the outputs of pipelines, as the program itself has them. */
class OutputCommands
{
public:
  OutputCommands();

  /** Returns what to run; it needs this object. Throws Failure(Usage). */
  const CommandRun &
  Parse(const std::vector<std::string> & arguments);

  /** The options of these commands. */
  static CommandSyntax
  GetSyntax();

private:
  CLI::App m_Program{ "", "rhombic" };
  std::map<std::string, CommandRun> m_Runs; ///< hold what the parsers write to
};

} // namespace rhombic

#endif
