#include "rhombicCommands.h"

#include <filesystem>

namespace rhombic
{

std::string
DescribeCommandLine(const std::vector<std::string> & arguments, const std::string & scan)
{
  std::string text = "rhombic";
  for (const std::string & argument : arguments)
  {
    const auto equals = argument.rfind("-", 0) == 0 ? argument.find('=') : std::string::npos;
    const std::string option = equals == std::string::npos ? "" : argument.substr(0, equals + 1);
    const std::string value = argument.substr(option.size());
    const bool isPath = value.find('/') != std::string::npos;
    text += " " + option + (value == scan ? "SCAN" : isPath ? std::filesystem::path(value).filename().string() : value);
  }
  return text;
}

} // namespace rhombic
