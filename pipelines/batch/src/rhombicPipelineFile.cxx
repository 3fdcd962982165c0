#include "rhombicPipelineFile.h"

#include "rhombicBatchResults.h"
#include "rhombicFailure.h"
#include "rhombicMeshScan.h"
#include "rhombicFiles.h"
#include "rhombicWording.h"
#include "rhombicYAMLKeys.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr char defaultPipeline[] = "outputs:\n  - page: page.png\n    preset: auto\n";

/** A kind of output, and the command that makes it. */
struct OutputKind
{
  const char * key;
  const char * command;
};

constexpr OutputKind Agreement{ "agreement", "compare-labels" };
constexpr OutputKind OutputKinds[] = { { "page", "render" },
                                       { "picture", "render" },
                                       { "mesh", "mesh" },
                                       { "volume", "resample" },
                                       Agreement };

std::string
LineOf(const YAML::Node & node)
{
  return "in line " + std::to_string(node.Mark().line + 1);
}

/** The parts of a file's name before the first and behind the last placeholder; both are the whole name without a
 * placeholder. */
struct NameEnds
{
  explicit NameEnds(const std::string & name)
    : hasPlaceholder(name.find(NamePlaceholder) != std::string::npos)
    , begin(name.substr(0, name.find(NamePlaceholder)))
    , end(hasPlaceholder ? name.substr(name.rfind(NamePlaceholder) + std::size(NamePlaceholder) - 1) : name)
  {}

  bool hasPlaceholder;
  std::string begin;
  std::string end;
};

/** Whether names of surfaces may make two files the same. */
bool
MayBeSame(const std::string & first, const std::string & second)
{
  const NameEnds a(first);
  const NameEnds b(second);
  if (!a.hasPlaceholder && !b.hasPlaceholder)
  {
    return first == second;
  }
  const auto beginsAs = [](const NameEnds & name, const NameEnds & pattern) {
    return pattern.hasPlaceholder && name.begin.rfind(pattern.begin, 0) == 0;
  };
  const auto endsAs = [](const NameEnds & name, const NameEnds & pattern) {
    const auto common = std::min(name.end.size(), pattern.end.size());
    return pattern.hasPlaceholder && name.end.substr(name.end.size() - common) == pattern.end;
  };
  return (beginsAs(a, b) || beginsAs(b, a)) && (endsAs(a, b) || endsAs(b, a));
}

/** Reads a pipeline file. */
class PipelineParser
{
public:
  PipelineParser(const fs::path & path, const CommandSyntax & syntax)
    : m_Folder(path.empty() ? fs::path() : fs::absolute(path).parent_path())
    , m_Syntax(syntax)
  {}

  Pipeline
  Parse(const std::string & text)
  {
    const YAML::Node root = LoadYAML(text);
    RefuseOtherKeys(root, { "description", "options", "outputs" });
    Pipeline pipeline;
    if (root["options"])
    {
      std::vector<std::string> known;
      for (const OutputKind & kind : OutputKinds)
      {
        this->AddNames(kind, known);
      }
      RefuseOtherKeys(root["options"], known);
    }
    for (const auto & output : root["outputs"])
    {
      pipeline.steps.push_back(this->ParseOutput(output, root["options"]));
      const std::string & name = pipeline.steps.back().output;
      const auto isSame = [&name](const PipelineStep & step) { return step.output == name; };
      if (std::count_if(pipeline.steps.begin(), pipeline.steps.end(), isSame) > 1)
      {
        throw YAMLMistake("has a second output " + name + " " + LineOf(output));
      }
    }
    if (pipeline.steps.empty())
    {
      throw YAMLMistake("has no outputs");
    }
    pipeline.hash = HashText(m_Identity);
    return pipeline;
  }

private:
  /** Adds the names of the settings that outputs of a kind may have. */
  void
  AddNames(const OutputKind & kind, std::vector<std::string> & names) const
  {
    for (const CommandSyntax::Setting & setting : m_Syntax.settingsOf(kind.command))
    {
      names.push_back(setting.name);
    }
  }

  PipelineStep
  ParseOutput(const YAML::Node & node, const YAML::Node & common)
  {
    std::vector<std::string> keys;
    const OutputKind * kind = nullptr;
    for (const OutputKind & known : OutputKinds)
    {
      keys.emplace_back(known.key);
      kind = kind == nullptr && node.IsMap() && node[known.key] ? &known : kind;
    }
    if (kind == nullptr)
    {
      throw YAMLMistake("has an output without " + Enumerate(keys) + " " + LineOf(node));
    }
    PipelineStep step;
    step.line = static_cast<std::size_t>(node.Mark().line) + 1;
    step.kind = kind->key;
    step.command = kind->command;
    step.output = node[kind->key].as<std::string>();
    if (step.output.empty() || step.output[0] == '.' || step.output.find('/') != std::string::npos)
    {
      throw YAMLMistake("has '" + step.output + "' where the name of a file is expected, " + LineOf(node));
    }
    const std::vector<CommandSyntax::Setting> settings = m_Syntax.settingsOf(step.command);
    std::vector<std::string> known{ kind->key };
    this->AddNames(*kind, known);
    RefuseOtherKeys(node, known);

    step.settings = step.kind == "page" ? Report{ { "sheet", true } } : Report::object();
    for (const CommandSyntax::Setting & setting : settings)
    {
      const YAML::Node own = node[setting.name]; // replaces the common value
      const YAML::Node value = own || !common ? own : common[setting.name];
      if (setting.name == "labels")
      {
        step.takesLabels = !value || this->ParseTakesLabels(value);
      }
      else if (value)
      {
        this->AddSetting(setting, value, step);
      }
    }
    this->Check(step);
    m_Identity +=
      step.output + '\n' + step.command + '\n' + step.settings.dump() + '\n' + std::to_string(step.takesLabels) + '\n';
    return step;
  }

  bool
  ParseTakesLabels(const YAML::Node & value) const
  {
    const auto text = value.as<std::string>();
    if (text != "true" && text != "false")
    {
      throw YAMLMistake("has '" + text + "' where true or false is expected, " + LineOf(value));
    }
    return text == "true";
  }

  void
  AddSetting(const CommandSyntax::Setting & setting, const YAML::Node & value, PipelineStep & step)
  {
    Report texts = Report::array();
    for (const auto & text : value.IsSequence() ? value.as<std::vector<std::string>>()
                                                : std::vector<std::string>{ value.as<std::string>() })
    {
      if (text == "true")
      {
        texts.push_back(true);
      }
      else if (text != "false")
      {
        texts.push_back(setting.isInputFile ? this->FindFile(text) : text);
      }
    }
    if (texts.empty())
    {
      return;
    }
    step.settings[setting.name] = texts.size() == 1 ? Report(texts[0]) : texts;
    if (setting.isOutput)
    {
      if (!step.settings[setting.name].is_string())
      {
        throw YAMLMistake("has a list or true where the name of one file is expected, " + LineOf(value));
      }
      step.files.push_back(setting.name);
    }
  }

  /** The absolute path of a file that lies beside the pipeline file; other values as they are. */
  std::string
  FindFile(const std::string & value)
  {
    const fs::path path = m_Folder / value;
    std::error_code error;
    if (value.empty() || !fs::is_regular_file(path, error))
    {
      return value;
    }
    std::ostringstream content;
    content << std::ifstream(path, std::ios::binary).rdbuf();
    m_Identity += content.str();
    return path.lexically_normal().string();
  }

  /** Lets the command judge. */
  void
  Check(const PipelineStep & step)
  {
    BatchCase anyCase;
    anyCase.scan = "SCAN";
    anyCase.reference = "REFERENCE";
    try
    {
      for (const fs::path & file : m_Syntax.check(step.command, GetSettings(step, anyCase, Report::object(), "")))
      {
        this->AddFile(file.string(), step);
      }
    }
    catch (const Failure & failure)
    {
      throw YAMLMistake("has a mistake in the output in line " + std::to_string(step.line) + ": " +
                        DescribeError(failure));
    }
  }

  /** Refuses files that two outputs, or an output and the batch, would write. */
  void
  AddFile(const std::string & file, const PipelineStep & step)
  {
    for (const auto & [other, line] : m_Files)
    {
      if (MayBeSame(file, other))
      {
        throw Failure(FailureKind::Usage,
                      "it would write " + file + ", as the output in line " + std::to_string(line) + " does" +
                        (file == other ? "" : " with " + other + " and some name of a surface") +
                        "; give one of them another name.");
      }
    }
    m_Files.emplace(file, step.line);
    if (file == ThumbnailFile || file == CaseFile)
    {
      throw Failure(FailureKind::Usage, "a batch writes a file " + file + " itself; give the output another name.");
    }
  }

  fs::path m_Folder;
  const CommandSyntax & m_Syntax;
  std::string m_Identity;                     ///< all that determines the outputs
  std::map<std::string, std::size_t> m_Files; ///< of all outputs, and the lines of these
};

/** Both values, or lists of values, in one list. */
Report
Joined(const Report & first, const Report & second)
{
  Report all = Report::array();
  for (const Report * const part : { &first, &second })
  {
    for (const Report & value : part->is_array() ? *part : Report::array({ *part }))
    {
      all.push_back(value);
    }
  }
  return all;
}

} // namespace

Pipeline
ReadPipeline(const fs::path & path, const CommandSyntax & syntax)
{
  const std::string text = path.empty() ? defaultPipeline : ReadTextFile(path, "pipeline file");
  const auto failure = [&path](const std::string & why) {
    return Failure(FailureKind::Usage,
                   "The pipeline " + path.string() + " " + why +
                     "; see the guide's chapter on many scans for an example.");
  };
  try
  {
    return PipelineParser(path, syntax).Parse(text);
  }
  catch (const YAMLMistake & mistake)
  {
    throw failure(mistake.what());
  }
  catch (const YAML::Exception & error)
  {
    throw failure("is not valid in line " + std::to_string(error.mark.line + 1) + " (" + error.msg + ")");
  }
}

bool
IsAgreement(const PipelineStep & step)
{
  return step.kind == Agreement.key;
}

bool
IsMadeOf(const PipelineStep & step, const BatchCase & batchCase)
{
  return !IsAgreement(step) || !batchCase.reference.empty();
}

void
AddAgreement(const std::vector<BatchCase> & cases, Pipeline & pipeline)
{
  const auto hasReference = [](const BatchCase & batchCase) { return !batchCase.reference.empty(); };
  if (std::any_of(cases.begin(), cases.end(), hasReference) &&
      std::none_of(pipeline.steps.begin(), pipeline.steps.end(), IsAgreement))
  {
    PipelineStep & step = pipeline.steps.emplace_back();
    step.output = "agreement.tsv";
    step.kind = Agreement.key;
    step.command = Agreement.command;
    step.settings = Report::object();
  }
}

Report
GetSettings(const PipelineStep & step, const BatchCase & batchCase, const Report & further, const fs::path & folder)
{
  Report settings{ { "scan", batchCase.scan.string() } };
  if (IsAgreement(step))
  {
    const fs::path & compared = batchCase.labels.empty() ? batchCase.scan : batchCase.labels;
    settings = { { "a", batchCase.reference.string() }, { "b", compared.string() } };
  }
  settings.update(step.settings);
  if (step.takesLabels && !batchCase.labels.empty())
  {
    settings["labels"] = batchCase.labels.string();
  }
  if (step.command != "resample" && !IsAgreement(step)) // which make no surfaces
  {
    settings["unnamed-mask"] = true;
  }
  for (const auto & [name, value] : further.items())
  {
    Report & known = settings[name];
    known = known.is_null() || value.is_boolean() ? Report(value) : Joined(known, value);
  }
  settings["output"] = (folder / step.output).string();
  for (const std::string & file : step.files)
  {
    settings[file] = (folder / settings[file].get<std::string>()).string();
  }
  return settings;
}

} // namespace rhombic
