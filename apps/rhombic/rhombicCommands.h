#ifndef rhombicCommands_h
#define rhombicCommands_h

#include "rhombicConsole.h"
#include "rhombicVoxelDecoder.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace rhombic
{

/** Console, decoder and arguments that the program passes to a command. */
struct CommandContext
{
  Console * console;
  VoxelDecoder * decoder;             ///< unpacks the voxels of all input files
  std::vector<std::string> arguments; ///< after the program's name

  /** Null: the command runs. Otherwise it checks what it can without reading or writing anything, and adds the files
   * that it would write, as far as their names are known; console and decoder are not used. For render, mesh and
   * resample. */
  std::vector<std::filesystem::path> * planned = nullptr;
};

/** The arguments of a command line for metadata. Names of folders, scans and series may identify the patient, so only
 * the last parts of paths are kept, and arguments that are values of \a names are replaced by their keys, as SCAN. */
std::vector<std::string>
DescribeArguments(const std::vector<std::string> & arguments, const std::map<std::string, std::string> & names);

/** Does the command's work once its options are parsed. Throws Failure. */
using CommandRun = std::function<void(const CommandContext &)>;

/** Each adds its options to the parser and returns what to run. */
CommandRun
AddInfoCommand(CLI::App & parser);
CommandRun
AddRenderCommand(CLI::App & parser);
CommandRun
AddBatchCommand(CLI::App & parser);
CommandRun
AddBIDSCommand(CLI::App & parser);
CommandRun
AddMeshCommand(CLI::App & parser);
CommandRun
AddAuditCommand(CLI::App & parser);
CommandRun
AddResampleCommand(CLI::App & parser);
CommandRun
AddPhantomCommand(CLI::App & parser);
CommandRun
AddCompareCommand(CLI::App & parser);
CommandRun
AddComparePicturesCommand(CLI::App & parser);
CommandRun
AddDoctorCommand(CLI::App & parser);

/** Adds --pipeline to the parser of render or mesh, which must outlive what is returned; \a otherwise runs without it.
 */
CommandRun
AddPipelineOption(CLI::App & parser, const CommandRun & otherwise);

/** Makes those outputs of a pipeline file that a command makes, with the same bytes as rhombic batch. All are checked
 * before the first is made; one that fails then keeps no other from being made. In the program that draws only. Throws
 * Failure, of the kind of the first failure. \param command the parser of render or mesh, after parsing */
void
RunPipeline(const std::string & file, const CLI::App & command, const CommandContext & context);

/** Replaces this process by the program that draws, if this one can't and \a arguments (as of main()) name a command
 * that does, a pipeline, or the audit of a VTP file. Otherwise it returns. */
void
StartDrawingProgram(char ** arguments);

/** What converts VTP files for ReadSurfaces(), by VTK; null in the program that can't draw. */
VoxelRequest::Function
GetVTPConverter();

/** Versions of the program and its libraries, a line each. */
std::string
VersionText();

} // namespace rhombic

#endif
