#include "rhombicCommands.h"

#include "itkVersion.h"

#include <OpenImageIO/oiioversion.h>
#include <vtkVersionMacros.h>

#include <filesystem>

namespace rhombic
{

namespace
{

std::string
Describe(const std::string & value, const std::map<std::string, std::string> & names)
{
  for (const auto & [name, secret] : names)
  {
    if (!secret.empty() && value == secret)
    {
      return name;
    }
  }
  return value.find('/') == std::string::npos ? value : std::filesystem::path(value).filename().string();
}

} // namespace

std::vector<std::string>
DescribeArguments(const std::vector<std::string> & arguments, const std::map<std::string, std::string> & names)
{
  std::vector<std::string> described;
  for (const std::string & argument : arguments)
  {
    const auto equals = argument.rfind("-", 0) == 0 ? argument.find('=') : std::string::npos;
    const std::string option = equals == std::string::npos ? "" : argument.substr(0, equals + 1);
    described.push_back(option + Describe(argument.substr(option.size()), names));
  }
  return described;
}

std::string
VersionText()
{
  return "rhombic      " RHOMBIC_VERSION "\nITK          " + std::string(itk::Version::GetITKVersion()) +
         "\nVTK          " VTK_VERSION "\nOpenImageIO  " + std::to_string(OIIO_VERSION_MAJOR) + "." +
         std::to_string(OIIO_VERSION_MINOR) + "." + std::to_string(OIIO_VERSION_PATCH) + "\n";
}

} // namespace rhombic
