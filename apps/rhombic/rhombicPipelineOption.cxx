#include "rhombicCommands.h"

#include <memory>

namespace rhombic
{

CommandRun
AddPipelineOption(CLI::App & parser, const CommandRun & otherwise)
{
  const auto pipeline = std::make_shared<std::string>();
  parser.add_option("--pipeline",
                    *pipeline,
                    "make what this command makes of a pipeline file (.yaml, as of rhombic batch); -o is the folder");
  return [&parser, pipeline, otherwise](const CommandContext & context) {
    if (pipeline->empty())
    {
      otherwise(context);
    }
    else
    {
      RunPipeline(*pipeline, parser, context);
    }
  };
}

} // namespace rhombic
