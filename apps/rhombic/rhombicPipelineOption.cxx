#include "rhombicCommands.h"

#include <memory>

namespace rhombic
{

void
NoteOutputs(const std::string & word, const std::vector<MadeFile> & outputs, Console & console)
{
  for (const MadeFile & output : outputs)
  {
    if (output.isMain)
    {
      console.Note(word + ": " + output.path.string());
    }
  }
}

CommandRun
AddPipelineOption(CommandSettings & command, const CommandRun & otherwise)
{
  struct Options
  {
    std::string pipeline;
  };
  static const SettingsTable<Options> table{
    { "--pipeline",
      &Options::pipeline,
      "make what this command makes of a pipeline file (.yaml, as of rhombic batch); -o is the folder",
      OfKind(SettingKind::Run) },
  };
  const auto options = std::make_shared<Options>();
  command.Add(table, *options);
  return [options, otherwise](const CommandContext & context) {
    if (options->pipeline.empty())
    {
      return otherwise(context);
    }
    RunPipeline(options->pipeline, context);
    return std::vector<MadeFile>();
  };
}

} // namespace rhombic
