#include "rhombicCommands.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include <strings.h>
#include <unistd.h>

// What the program without drawing has in place of the commands in drawing/.

namespace rhombic
{
namespace
{

constexpr const char * drawingCommands[] = { "render", "batch", "bids", "compare", "compare-pictures", "doctor" };

/** Whether a command draws, runs a pipeline, or audits a VTP file, which VTK reads. A word may also be the value of an
 * option: the drawing program has the other commands, too. */
bool
NeedsDrawingProgram(const std::vector<std::string> & words)
{
  const auto isDrawing = [](const std::string & word) {
    return word.rfind("--pipeline", 0) == 0 ||
           std::find(std::begin(drawingCommands), std::end(drawingCommands), word) != std::end(drawingCommands);
  };
  const auto isVTP = [](const std::string & word) {
    const auto dot = word.rfind('.');
    return dot != std::string::npos && strcasecmp(word.c_str() + dot, ".vtp") == 0;
  };
  return std::any_of(words.begin(), words.end(), isDrawing) ||
         (std::find(words.begin(), words.end(), "audit") != words.end() &&
          std::any_of(words.begin(), words.end(), isVTP));
}

} // namespace

void
StartDrawingProgram(char ** arguments)
{
  std::vector<std::string> words;
  for (char ** argument = arguments; *argument; ++argument)
  {
    words.emplace_back(*argument);
  }
  if (!NeedsDrawingProgram(words))
  {
    return;
  }
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto program = (self.parent_path() / RHOMBIC_DRAWING_PROGRAM).lexically_normal();
  if (!error)
  {
    execv(program.c_str(), arguments);
    error.assign(errno, std::generic_category());
  }
  std::cerr << "rhombic: " << program.string()
            << ", the part of rhombic that draws, can't be started: " << error.message()
            << "; install rhombic again, and mount /proc.\n";
  std::_Exit(1);
}

VoxelRequest::Function
GetVTPConverter()
{
  return nullptr;
}

void
RunPipeline(const std::string &, const CommandContext &)
{
  // The drawing program has it.
}

CommandRun
AddRenderCommand(CommandSettings &)
{
  return {}; // for the list of commands only
}

CommandRun
AddCompareCommand(CommandSettings &)
{
  return {};
}

CommandRun
AddBatchCommand(CommandSettings &)
{
  return {};
}

CommandRun
AddBIDSCommand(CommandSettings &)
{
  return {};
}

CommandRun
AddComparePicturesCommand(CommandSettings &)
{
  return {};
}

CommandRun
AddDoctorCommand(CommandSettings &)
{
  return {};
}

} // namespace rhombic
