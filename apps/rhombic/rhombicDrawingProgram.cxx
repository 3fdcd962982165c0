#include "rhombicCommands.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <system_error>

#include <unistd.h>

// What the program without drawing has in place of the commands in drawing/.

namespace rhombic
{
namespace
{

constexpr const char * drawingCommands[] = { "render", "compare-pictures", "doctor" };

bool
NamesDrawingCommand(const char * argument)
{
  return std::any_of(std::begin(drawingCommands), std::end(drawingCommands), [argument](const char * command) {
    return std::strcmp(argument, command) == 0;
  });
}

} // namespace

void
StartDrawingProgram(char ** arguments)
{
  for (char ** argument = arguments; *argument; ++argument)
  {
    if (NamesDrawingCommand(*argument)) // perhaps as an option's value: the drawing program has the other commands, too
    {
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
  }
}

CommandRun
AddRenderCommand(CLI::App &)
{
  return {}; // for the list of commands only
}

CommandRun
AddComparePicturesCommand(CLI::App &)
{
  return {};
}

CommandRun
AddDoctorCommand(CLI::App &)
{
  return {};
}

} // namespace rhombic
