#include "rhombicFailure.h"
#include "rhombicFuzzFile.h"
#include "rhombicPipelineFile.h"

#include <algorithm>
#include <set>

using rhombicfuzz::Require;

/** Pipeline files, for commands that have a setting of each kind and refuse nothing. */
extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  rhombic::CommandSyntax syntax;
  syntax.settingsOf = [](const std::string &) {
    return std::vector<rhombic::CommandSyntax::Setting>{
      { "preset", false, false }, { "label-table", true, false }, { "report", false, true }, { "view", false, false }
    };
  };
  syntax.check = [](const std::string &, const rhombic::Report &) { return std::vector<std::filesystem::path>(); };
  syntax.parse = [](const std::string &, const std::vector<std::string> &) { return rhombic::Report(); };
  const rhombicfuzz::FuzzFile file(data, size);
  try
  {
    const rhombic::Pipeline pipeline = rhombic::ReadPipeline(file.Path(), syntax);
    Require(!pipeline.steps.empty(), "a pipeline has outputs");
    std::set<std::string> names;
    for (const rhombic::PipelineStep & step : pipeline.steps)
    {
      const std::filesystem::path output = step.output;
      Require(names.insert(step.output).second, "outputs have different names");
      Require(!step.output.empty() && output.is_relative(), "outputs are named");
      Require(std::find(output.begin(), output.end(), "..") == output.end(), "outputs stay in the folder of the case");
      Require(step.line > 0 && !step.command.empty(), "outputs have a line and a command");
    }
  }
  catch (const rhombic::Failure & failure)
  {
    const rhombic::FailureKind kind = failure.GetKind();
    Require(kind == rhombic::FailureKind::Usage || kind == rhombic::FailureKind::Unreadable ||
              kind == rhombic::FailureKind::NotFound,
            "a bad pipeline file is a mistake of its writer");
  }
  return 0;
}
