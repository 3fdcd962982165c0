#include "rhombicCaseRun.h"

#include "rhombicBatchResults.h"
#include "rhombicFiles.h"
#include "rhombicFailure.h"
#include "rhombicSidecar.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include <fcntl.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr char requestFile[] = ".request";
constexpr char resultFile[] = ".result";

/** The result that a command wrote to standard output; an empty object if the command was killed, or if the file can't
 * be read. */
Report
ReadResult(const fs::path & path)
{
  std::ostringstream text;
  text << std::ifstream(path).rdbuf(); // a disk that fails ends the text
  Report result = Report::parse(text.str(), nullptr, false);
  return result.is_object() ? result : Report::object();
}

/** A sentence in which files of a folder have their names alone. */
std::string
WithoutFolder(std::string sentence, const fs::path & folder)
{
  const std::string part = folder.string() + '/';
  for (auto place = sentence.find(part); place != std::string::npos; place = sentence.find(part, place))
  {
    sentence.erase(place, part.size());
  }
  return sentence;
}

/** A sentence without the names of a case's files, which may name the patient. Names of up to five digits stay. */
std::string
WithoutNames(std::string sentence, const BatchCase & batchCase, const fs::path & stage)
{
  ReplaceWords(sentence, stage.string(), "CASE");
  ReplaceWords(sentence, batchCase.scan.string(), "SCAN");
  ReplaceWords(sentence, batchCase.labels.string(), "LABELS");
  ReplaceWords(sentence, batchCase.reference.string(), "REFERENCE");
  std::map<std::string, std::string> names;
  for (std::size_t n = 0; n < batchCase.files.size(); ++n)
  {
    const fs::path & file = batchCase.files[n];
    for (const auto & [name, by] : { std::pair(file.filename().string(), "file " + std::to_string(n + 1)),
                                     std::pair(file.parent_path().string(), std::string("FOLDER")),
                                     std::pair(file.parent_path().filename().string(), std::string("FOLDER")) })
    {
      const bool isNumber =
        name.size() < 6 && std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
      if (!isNumber)
      {
        names[name] = by;
      }
    }
  }
  std::vector<std::pair<std::string, std::string>> longestFirst(names.begin(), names.end());
  std::stable_sort(longestFirst.begin(), longestFirst.end(), [](const auto & a, const auto & b) {
    return a.first.size() > b.first.size();
  });
  for (const auto & [name, by] : longestFirst)
  {
    ReplaceWords(sentence, name, by);
  }
  return sentence;
}

/** Adds measures of an output's surfaces to those of the case: surfaces that outputs share are there once, with what is
 * known of any of them. Measures that know the volume of the isosurface tell the volume's error and its reference.
 * Returns the surfaces' identities. */
Report
AddMeasures(const Report & rows, Report & measures)
{
  Report identities = Report::array();
  for (const Report & row : rows)
  {
    const Report identity = row.value("surface_id", Report());
    const auto known = std::find_if(measures.begin(), measures.end(), [&](const Report & other) {
      return other.value("surface_id", Report()) == identity;
    });
    if (known == measures.end())
    {
      measures.push_back(row);
    }
    else
    {
      const bool isPreferred = row.contains("isosurface_volume_ml");
      Report whole = isPreferred ? *known : row;
      whole.update(isPreferred ? row : *known);
      *known = whole;
    }
    identities.push_back(identity);
  }
  return identities;
}

} // namespace

double
SecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<fs::path>
ListEntries(const fs::path & folder)
{
  return std::vector<fs::path>(fs::directory_iterator(folder), fs::directory_iterator());
}

std::string
HashOptions(const BatchCase & batchCase, const Pipeline & pipeline)
{
  constexpr char format[] = "3"; // of lines in the journal: cases of another one run again
  std::string text = format + ('\n' + pipeline.hash);
  for (const std::string & option : batchCase.options)
  {
    text += '\n' + option;
  }
  return HashText(text);
}

CaseRun::CaseRun(const BatchCase & batchCase, const BatchSettings & settings, std::shared_future<std::string> inputHash)
  : m_Case(batchCase)
  , m_Settings(settings)
  , m_Stage(settings.output / (StagePrefix + batchCase.name))
  , m_InputHash(std::move(inputHash))
{
  m_Record = { { "case", batchCase.name },
               { "folder", batchCase.folder.string() },
               { "status", "failed" },
               { "code", 0 },
               { "cause", "" },
               { "seconds", 0.0 },
               { "peakMemory", 0 },
               { "software", settings.software },
               { "options", HashOptions(batchCase, settings.pipeline) },
               { "input",
                 { { "files", batchCase.files.size() },
                   { "bytes", batchCase.GetSize() },
                   { "stamp", HashFileStates(batchCase.files) } } },
               { "steps", Report::array() } };
  fs::remove_all(m_Stage);
  fs::remove_all(settings.output / batchCase.folder);
  fs::create_directory(m_Stage);
  for (const PipelineStep & step : settings.pipeline.steps)
  {
    if (IsMadeOf(step, batchCase))
    {
      m_Steps.push_back(&step);
    }
  }
  this->StartStep();
}

CaseRun::~CaseRun()
{
  m_Child.reset();
  std::error_code ignored; // a destructor must not throw; the next run removes it
  fs::remove_all(m_Stage, ignored);
}

void
CaseRun::StartStep()
{
  const PipelineStep & step = *m_Steps[m_Step];
  const auto options = m_Case.settings.find(step.command);
  Report request{ { "command", step.command }, { "threads", m_Settings.threads }, { "parent", getpid() } };
  Report & settings = request["settings"];
  settings = GetSettings(step, m_Case, options == m_Case.settings.end() ? Report::object() : options->second, m_Stage);
  if (!settings.contains("max-memory"))
  {
    settings["max-memory"] = m_Settings.maximumMemory;
  }
  if (step.command == "render" && !fs::exists(m_Stage / ThumbnailFile))
  {
    settings["thumbnail"] = (m_Stage / ThumbnailFile).string();
  }
  std::ofstream file(m_Stage / requestFile);
  file << request.dump() << std::flush;
  if (!file)
  {
    throw Failure(FailureKind::Output,
                  "Cannot write to " + m_Stage.string() +
                    "; see to the disk, and run the batch again: finished cases are kept.");
  }
  m_ChildStart = Clock::now();
  ChildSettings child;
  child.arguments = { m_Settings.program.string(), m_Settings.requestOption };
  child.input = m_Stage / requestFile;
  child.output = m_Stage / resultFile;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // which keep all memory for themselves
  child.memory = m_Settings.maximumMemory;
#endif
  m_Child = std::make_unique<ChildProcess>(child);
}

bool
CaseRun::Continue()
{
  if (!m_IsTooLong && SecondsSince(m_Start) > m_Settings.maximumSeconds)
  {
    m_IsTooLong = true;
    m_Child->Kill();
  }
  if (!m_Child->HasEnded())
  {
    return false;
  }
  this->TakeStep();
  if (++m_Step < m_Steps.size() && !m_IsTooLong)
  {
    this->StartStep();
    return false;
  }
  for (; m_Step < m_Steps.size(); ++m_Step)
  {
    m_Record["failedOutputs"].push_back(m_Steps[m_Step]->output);
  }
  if (!m_Made.empty())
  {
    this->KeepOutputs();
  }
  m_Record["status"] = m_Cause.empty() ? "done" : "failed";
  m_Record["seconds"] = SecondsSince(m_Start);
  return true;
}

/** Takes the result and the files of an ended child. */
void
CaseRun::TakeStep()
{
  const PipelineStep & step = *m_Steps[m_Step];
  m_Record["steps"].push_back({ { "output", step.output },
                                { "seconds", SecondsSince(m_ChildStart) },
                                { "peakMemory", m_Child->GetPeakMemory() } });
  m_Record["peakMemory"] = std::max(m_Record["peakMemory"].get<std::uintmax_t>(), m_Child->GetPeakMemory());
  const int code = m_Child->GetExitCode();
  const Report result = ReadResult(m_Stage / resultFile);
  const std::string command = "rhombic " + step.command;
  if (m_IsTooLong)
  {
    this->Fail(1,
               "It took longer than " + FormatNumber(m_Settings.maximumSeconds) +
                 " s; allow more with --max-time, or lower --density.");
  }
  else if (code < 0)
  {
    this->Fail(1, command + " was ended by signal " + std::to_string(-code) + " (" + strsignal(-code) + ").");
  }
  else if (code > 0)
  {
    const std::string sentence = WithoutFolder(result.value("failure", std::string()), m_Stage);
    this->Fail(code, sentence.empty() ? command + " ended with exit code " + std::to_string(code) + "." : sentence);
  }
  else if (!result.contains("outputs"))
  {
    this->Fail(static_cast<int>(FailureKind::Output),
               "The result of " + command + " can't be read back; is the disk damaged, or the network?");
  }
  for (Report output : code == 0 && !m_IsTooLong ? result.value("outputs", Report::array()) : Report::array())
  {
    output["output"] = step.output;
    m_Made.emplace(output["name"].get<std::string>(), output);
  }
  for (const fs::path & file : ListEntries(m_Stage))
  {
    if (m_Made.count(file.filename().string()) == 0)
    {
      fs::remove_all(file); // a killed child has left it
    }
  }
}

/** Notes that the running step's output is not made. The case's code and cause are those of its first failure. */
void
CaseRun::Fail(int code, const std::string & cause)
{
  m_Record["failedOutputs"].push_back(m_Steps[m_Step]->output);
  if (m_Cause.empty())
  {
    m_Cause = cause;
    m_Record["code"] = code;
    m_Record["cause"] = WithoutNames(cause, m_Case, m_Stage);
  }
}

/** Moves the stage's files into the case's folder. */
void
CaseRun::KeepOutputs()
{
  try
  {
    this->AddOutputs();
    const fs::path place = m_Settings.output / m_Case.folder;
    fs::create_directories(place.parent_path());
    fs::rename(m_Stage, place);
    const int folder = open(place.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    fsync(folder);
    close(folder);
  }
  catch (const std::exception & error) // of files: a full disk, a folder that was removed
  {
    const auto * const failure = dynamic_cast<const Failure *>(&error);
    m_Cause = DescribeError(error);
    m_Record["code"] = static_cast<int>(failure != nullptr ? failure->GetKind() : FailureKind::Output);
    m_Record["cause"] = WithoutNames(m_Cause, m_Case, m_Stage);
    m_Record["outputs"] = Report::array();
    m_Record["failedOutputs"] = Report::array();
    for (const PipelineStep * const step : m_Steps)
    {
      m_Record["failedOutputs"].push_back(step->output);
    }
    m_Record.erase("measures");
    m_Record.erase("agreement");
  }
}

/** The case's outputs with their hashes: in its record, and in case.json beside them. */
void
CaseRun::AddOutputs()
{
  m_Record["input"]["md5"] = m_InputHash.get();
  m_Record["outputs"] = Report::array();
  m_Record["measures"] = Report::array();
  for (const auto & [name, made] : m_Made)
  {
    const fs::path file = m_Stage / name;
    m_Record["outputs"].push_back({ { "name", name },
                                    { "kind", made["kind"] },
                                    { "output", made["output"] },
                                    { "bytes", fs::file_size(file) },
                                    { "md5", HashFiles({ file }) } });
    if (made["kind"] == "agreement")
    {
      for (const Report & label : made["measures"])
      {
        Report row{ { "output", made["output"] } };
        row.update(label);
        m_Record["agreement"].push_back(row);
      }
    }
    else if (!made["measures"].empty())
    {
      m_Record["outputs"].back()["surfaces"] = AddMeasures(made["measures"], m_Record["measures"]);
    }
  }
  Report sidecar = m_Record;
  for (const char * const key :
       { "status", "code", "cause", "seconds", "peakMemory", "steps", "measures", "agreement" })
  {
    sidecar.erase(key);
  }
  sidecar["input"].erase("stamp");
  StagedFiles staged;
  StageText(ToJson(sidecar) + '\n', m_Stage / CaseFile, staged);
  staged.Commit();
}

} // namespace rhombic
