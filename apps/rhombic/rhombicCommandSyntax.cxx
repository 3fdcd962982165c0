#include "rhombicCommandSyntax.h"

#include "rhombicCommandLine.h"

#include <algorithm>

namespace rhombic
{
namespace
{

/** Settings of which pipelines or batches give the values themselves, or that change no output. */
bool
IsOfPipeline(const std::string & name, SettingKind kind)
{
  return kind == SettingKind::Run || name == "output" || name == "sheet";
}

} // namespace

CommandSyntax
GetCommandSyntax()
{
  CommandSyntax syntax;
  syntax.settingsOf = [](const std::string & command) {
    CommandLine commandLine;
    std::vector<CommandSyntax::Setting> settings;
    for (const auto & [name, kind] : commandLine.Get(command).settings.GetNames())
    {
      if (!IsOfPipeline(name, kind))
      {
        settings.push_back({ name, kind == SettingKind::InputFile, kind == SettingKind::Output });
      }
    }
    return settings;
  };
  syntax.check = [](const std::string & command, const Report & settings) {
    CommandLine commandLine;
    std::vector<std::filesystem::path> files;
    Command & checked = commandLine.Set(command, settings);
    for (const MadeFile & output : checked.run({ nullptr, nullptr, &checked.settings, true }))
    {
      files.push_back(output.path);
    }
    return files;
  };
  syntax.parse = [](const std::string & command, const std::vector<std::string> & options) {
    std::vector<std::string> words{ command };
    words.insert(words.end(), options.begin(), options.end());
    CommandLine commandLine;
    return commandLine.Parse(words).settings.Get();
  };
  return syntax;
}

} // namespace rhombic
