#ifndef rhombicCommands_h
#define rhombicCommands_h

#include "rhombicConsole.h"
#include "rhombicSettings.h"
#include "rhombicSidecar.h"
#include "rhombicVoxelDecoder.h"

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
  VoxelDecoder * decoder;     ///< unpacks the voxels of all input files
  CommandSettings * settings; ///< of the command

  /** Whether the command only checks what it can without reading or writing anything, and returns the files that it
   * would write, without kinds and measures; console and decoder are not used. For render, mesh and resample. */
  bool onlyChecks = false;
};

/** Does the command's work once its settings are set. Returns the files of render, mesh and resample. Throws Failure.
 */
using CommandRun = std::function<std::vector<MadeFile>(const CommandContext &)>;

/** Each adds its settings and returns what to run. */
CommandRun
AddInfoCommand(CommandSettings & command);
CommandRun
AddRenderCommand(CommandSettings & command);
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
CommandRun
AddPhantomCommand(CommandSettings & command);
CommandRun
AddCompareCommand(CommandSettings & command);
CommandRun
AddComparePicturesCommand(CommandSettings & command);
CommandRun
AddDoctorCommand(CommandSettings & command);

/** Notes the files that a user looks for, each behind a word, as "mesh: bone.stl". */
void
NoteOutputs(const std::string & word, const std::vector<MadeFile> & outputs, Console & console);

/** Adds --pipeline to the settings of render or mesh; \a otherwise runs without it. */
CommandRun
AddPipelineOption(CommandSettings & command, const CommandRun & otherwise);

/** Makes those outputs of a pipeline file that a command makes, with the same bytes as rhombic batch. All are checked
 * before the first is made; one that fails then keeps no other from being made. In the program that draws only. Throws
 * Failure, of the kind of the first failure. */
void
RunPipeline(const std::string & file, const CommandContext & context);

/** Replaces this process by the program that draws, if this one can't and \a arguments (as of main()) name a command
 * that does, a pipeline, or the audit of a VTP file. Otherwise it returns. */
void
StartDrawingProgram(char ** arguments);

/** What converts VTP files for ReadSurfaces(), by VTK; null in the program that can't draw. */
VoxelRequest::Function
GetVTPConverter();

} // namespace rhombic

#endif
