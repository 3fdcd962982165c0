#include "rhombicCommands.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <iterator>

#include <unistd.h>

// What the program without drawing has in place of the commands in drawing/.

namespace rhombic
{
namespace
{

constexpr const char * drawingCommands[] = { "render", "doctor" };

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
      const auto folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
      const auto program = (folder / RHOMBIC_DRAWING_PROGRAM).lexically_normal();
      execv(program.c_str(), arguments);
      std::cerr << "rhombic: " << program.string()
                << ", the part of rhombic that draws, can't be started: " << std::strerror(errno)
                << "; install rhombic again.\n";
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
AddDoctorCommand(CLI::App &)
{
  return {};
}

} // namespace rhombic
