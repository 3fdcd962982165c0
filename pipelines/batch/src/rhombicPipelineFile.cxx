#include "rhombicPipelineFile.h"

#include "rhombicBatchResults.h"
#include "rhombicFailure.h"
#include "rhombicMeshScan.h"
#include "rhombicTextFile.h"
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

/** A kind of output, and the arguments that make it. */
struct OutputKind
{
  const char * key;
  std::vector<std::string> arguments;
};

const std::vector<OutputKind> &
OutputKinds()
{
  static const std::vector<OutputKind> kinds{ { "page", { "render", "--sheet" } },
                                              { "picture", { "render" } },
                                              { "mesh", { "mesh" } },
                                              { "volume", { "resample" } } };
  return kinds;
}

[[noreturn]] void
FailInPipeline(const std::string & source, const std::string & why)
{
  throw Failure(FailureKind::Usage,
                "The pipeline " + source + " " + why + "; see the guide's chapter on many scans for an example.");
}

std::string
LineOf(const YAML::Node & node)
{
  return "in line " + std::to_string(node.Mark().line + 1);
}

/** What stands before the first and behind the last placeholder of a file's name; both are the whole name if there is
 * none. */
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
  const NameEnds one(first);
  const NameEnds other(second);
  if (!one.hasPlaceholder && !other.hasPlaceholder)
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
  return (beginsAs(one, other) || beginsAs(other, one)) && (endsAs(one, other) || endsAs(other, one));
}

/** Reads one pipeline file. */
class PipelineParser
{
public:
  PipelineParser(const fs::path & path, const CommandSyntax & syntax)
    : m_Source(path.string())
    , m_Folder(path.empty() ? fs::path() : fs::absolute(path).parent_path())
    , m_Syntax(syntax)
  {}

  Pipeline
  Parse(const std::string & text)
  {
    const YAML::Node root = YAML::Load(text);
    this->CheckKeysOf(root, { "description", "options", "outputs" });
    Pipeline pipeline;
    if (root["options"])
    {
      this->CheckCommonOptions(root["options"]);
    }
    for (const auto & output : root["outputs"])
    {
      pipeline.steps.push_back(this->ParseOutput(output, root["options"]));
      const std::string & name = pipeline.steps.back().output;
      const auto isSame = [&name](const PipelineStep & step) { return step.output == name; };
      if (std::count_if(pipeline.steps.begin(), pipeline.steps.end(), isSame) > 1)
      {
        FailInPipeline(m_Source, "has a second output " + name + " " + LineOf(output));
      }
    }
    if (pipeline.steps.empty())
    {
      FailInPipeline(m_Source, "has no outputs");
    }
    pipeline.hash = HashText(m_Identity);
    return pipeline;
  }

private:
  void
  CheckKeysOf(const YAML::Node & map, const std::vector<std::string> & known) const
  {
    const std::string mistake = DescribeKeys(map, known);
    if (!mistake.empty())
    {
      FailInPipeline(m_Source, mistake);
    }
  }

  /** The options that may be in the file: those of a command, but for what the batch itself gives. */
  std::vector<std::string>
  OptionsOf(const std::string & command) const
  {
    std::vector<std::string> options = m_Syntax.optionsOf(command);
    const auto isOwn = [](const std::string & option) {
      return option == "output" || option == "help" || option == "sheet" || option == "from" ||
             option == "list-presets" || option == "no-sidecar" || option == "max-memory" || option == "pipeline";
    };
    options.erase(std::remove_if(options.begin(), options.end(), isOwn), options.end());
    return options;
  }

  void
  CheckCommonOptions(const YAML::Node & options) const
  {
    std::vector<std::string> known;
    for (const OutputKind & kind : OutputKinds())
    {
      const auto more = this->OptionsOf(kind.arguments.front());
      known.insert(known.end(), more.begin(), more.end());
    }
    this->CheckKeysOf(options, known);
  }

  PipelineStep
  ParseOutput(const YAML::Node & node, const YAML::Node & common)
  {
    std::vector<std::string> keys;
    const OutputKind * kind = nullptr;
    for (const OutputKind & known : OutputKinds())
    {
      keys.emplace_back(known.key);
      kind = kind == nullptr && node.IsMap() && node[known.key] ? &known : kind;
    }
    if (kind == nullptr)
    {
      FailInPipeline(m_Source, "has an output without " + Enumerate(keys) + " " + LineOf(node));
    }
    PipelineStep step;
    step.line = static_cast<std::size_t>(node.Mark().line) + 1;
    step.kind = kind->key;
    step.arguments = kind->arguments;
    step.output = node[kind->key].as<std::string>();
    if (step.output.empty() || step.output[0] == '.' || step.output.find('/') != std::string::npos)
    {
      FailInPipeline(m_Source, "has '" + step.output + "' where the name of a file is expected, " + LineOf(node));
    }
    const std::vector<std::string> options = this->OptionsOf(kind->arguments.front());
    std::vector<std::string> known = options;
    known.emplace_back(kind->key);
    this->CheckKeysOf(node, known);

    step.takesLabels = std::count(options.begin(), options.end(), "labels") > 0;
    std::map<std::string, YAML::Node> values; // an output's own ones replace the common ones
    for (const auto & entry : common)
    {
      if (std::count(options.begin(), options.end(), entry.first.as<std::string>()) > 0)
      {
        values[entry.first.as<std::string>()].reset(entry.second);
      }
    }
    for (const auto & entry : node)
    {
      if (entry.first.as<std::string>() != kind->key)
      {
        values[entry.first.as<std::string>()].reset(entry.second);
      }
    }
    for (const auto & [option, value] : values)
    {
      this->AddOption(option, value, step);
    }
    this->Check(step);
    m_Identity += step.output + '\n';
    for (const std::string & argument : step.arguments)
    {
      m_Identity += argument + '\n';
    }
    m_Identity += std::to_string(step.takesLabels) + '\n';
    return step;
  }

  void
  AddOption(const std::string & option, const YAML::Node & value, PipelineStep & step)
  {
    if (value.IsSequence())
    {
      for (const auto & one : value)
      {
        this->AddOption(option, one, step);
      }
      return;
    }
    const auto text = value.as<std::string>();
    if (option == "labels")
    {
      if (text != "true" && text != "false")
      {
        FailInPipeline(m_Source, "has '" + text + "' where true or false is expected, " + LineOf(value));
      }
      step.takesLabels = text == "true";
    }
    else if (text == "true")
    {
      step.arguments.push_back("--" + option);
    }
    else if (text != "false")
    {
      step.arguments.push_back("--" + option + "=" + this->FindFile(option, text));
    }
  }

  /** The absolute path of a preset or label table that lies beside the pipeline file; other values as they are. */
  std::string
  FindFile(const std::string & option, const std::string & value)
  {
    const fs::path path = m_Folder / value;
    if ((option != "preset" && option != "label-table") || value.empty() || !fs::is_regular_file(path))
    {
      return value;
    }
    std::ostringstream content;
    content << std::ifstream(path, std::ios::binary).rdbuf();
    m_Identity += content.str();
    return path.lexically_normal().string();
  }

  /** Lets the command's own parser judge. */
  void
  Check(const PipelineStep & step)
  {
    std::vector<std::string> arguments = step.arguments;
    arguments.insert(arguments.end(), { "SCAN", "-o", step.output });
    try
    {
      for (const fs::path & file : m_Syntax.check(arguments))
      {
        this->AddFile(file.string(), step);
      }
    }
    catch (const Failure & failure)
    {
      FailInPipeline(
        m_Source, "has a mistake in the output in line " + std::to_string(step.line) + ": " + DescribeError(failure));
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

  std::string m_Source;
  fs::path m_Folder;
  const CommandSyntax & m_Syntax;
  std::string m_Identity;                     ///< all that determines the outputs
  std::map<std::string, std::size_t> m_Files; ///< of all outputs, and the lines of these
};

std::string
ReadPipelineText(const fs::path & path)
{
  return path.empty() ? defaultPipeline : ReadTextFile(path, "pipeline file");
}

} // namespace

Pipeline
ReadPipeline(const fs::path & path, const CommandSyntax & syntax)
{
  const std::string text = ReadPipelineText(path);
  try
  {
    return PipelineParser(path, syntax).Parse(text);
  }
  catch (const YAML::Exception & error)
  {
    FailInPipeline(path.string(),
                   "is not valid in line " + std::to_string(error.mark.line + 1) + " (" + error.msg + ")");
  }
}

std::vector<std::string>
GetArguments(const PipelineStep & step, const BatchCase & batchCase)
{
  std::vector<std::string> arguments{ step.arguments.front(), batchCase.scan.string() };
  arguments.insert(arguments.end(), step.arguments.begin() + 1, step.arguments.end());
  if (step.takesLabels && !batchCase.labels.empty())
  {
    arguments.push_back("--labels=" + batchCase.labels.string());
  }
  if (step.arguments.front() != "resample") // which makes no surfaces
  {
    arguments.push_back("--unnamed-mask");
  }
  arguments.insert(arguments.end(), { "-o", step.output });
  arguments.insert(arguments.end(), batchCase.options.begin(), batchCase.options.end());
  return arguments;
}

} // namespace rhombic
