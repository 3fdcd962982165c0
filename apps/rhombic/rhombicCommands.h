#ifndef rhombicCommands_h
#define rhombicCommands_h

#include "rhombicConsole.h"
#include "rhombicSettings.h"
#include "rhombicSidecar.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rhombic
{

/** What the program passes to a command. */
struct CommandContext
{
  Console * console;
  CommandSettings * settings; ///< of the command

  /** Whether the command only checks what it can without reading or writing anything, and returns the files that it
   * would write, without kinds and measures; the console is not used. For render, mesh and resample. */
  bool onlyChecks = false;
};

/** Does the command's work once its settings are set. Returns the files of render, mesh and resample. Throws Failure.
 */
using CommandRun = std::function<std::vector<MadeFile>(const CommandContext &)>;

/** What runs a command that returns no files. */
inline CommandRun
WithoutOutputs(const std::function<void(const CommandContext &)> & run)
{
  return [run](const CommandContext & context) {
    run(context);
    return std::vector<MadeFile>();
  };
}

/** Each adds its settings and returns what to run. */
CommandRun
AddInfoCommand(CommandSettings & command);
CommandRun
AddBatchCommand(CommandSettings & command);
CommandRun
AddBIDSCommand(CommandSettings & command);
CommandRun
AddMeshCommand(CommandSettings & command);
CommandRun
AddAuditCommand(CommandSettings & command);
CommandRun
AddResampleCommand(CommandSettings & command);

/** The same for the commands in the folder on-demand. They are in a library that AddOnDemandCommand() loads, as their
 * own libraries (VTK, Pango, GDCM) take five times as long to load as the rest of the program. */
CommandRun
AddOnDemandCommand(CommandSettings & command);
CommandRun
AddRenderCommand(CommandSettings & command);
CommandRun
AddComparePicturesCommand(CommandSettings & command);
CommandRun
AddCompareLabelsCommand(CommandSettings & command);
CommandRun
AddCompareCommand(CommandSettings & command);
CommandRun
AddPhantomCommand(CommandSettings & command);
CommandRun
AddDoctorCommand(CommandSettings & command);

/** Notes the files that a user looks for, each behind a word, as "mesh: bone.stl". */
void
NoteOutputs(const std::string & word, const std::vector<MadeFile> & outputs, Console & console);

/** Adds --pipeline to the settings of render or mesh; \a otherwise runs without it. */
CommandRun
AddPipelineOption(CommandSettings & command, const CommandRun & otherwise);

} // namespace rhombic

#endif
