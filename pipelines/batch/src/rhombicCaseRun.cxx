#include "rhombicCaseRun.h"

#include "rhombicDigest.h"
#include "rhombicFailure.h"
#include "rhombicSidecar.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>
#include <map>

#include <fcntl.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr char outputFile[] = ".output";
constexpr char errorsFile[] = ".errors";

double
SecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/** The sentence with which the program ended. */
std::string
FindSentence(const fs::path & errors)
{
  std::ifstream stream(errors);
  std::string line;
  std::string last;
  while (std::getline(stream, line))
  {
    last = Trim(line).empty() ? last : line;
  }
  const std::string prefix = "rhombic: ";
  return last.rfind(prefix, 0) == 0 ? last.substr(prefix.size()) : last;
}

/** Replaces a text wherever no letter or digit is beside it. */
void
ReplaceAll(std::string & text, const std::string & part, const std::string & by)
{
  const auto isLetter = [&text](std::size_t place) {
    return place < text.size() && std::isalnum(static_cast<unsigned char>(text[place])) != 0;
  };
  for (auto place = text.find(part); place != std::string::npos && !part.empty(); place = text.find(part, place))
  {
    const bool isPartOfWord = (place > 0 && isLetter(place - 1)) || isLetter(place + part.size());
    if (!isPartOfWord)
    {
      text.replace(place, part.size(), by);
    }
    place += isPartOfWord ? 1 : by.size();
  }
}

/** A sentence in which nothing of the names of a case's files is left, as they may name the patient. Names of one to
 * five digits stay. */
std::string
WithoutNames(std::string sentence, const BatchCase & batchCase, const fs::path & stage)
{
  ReplaceAll(sentence, stage.string(), "CASE");
  ReplaceAll(sentence, batchCase.scan.string(), "SCAN");
  ReplaceAll(sentence, batchCase.labels.string(), "LABELS");
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
    ReplaceAll(sentence, name, by);
  }
  return sentence;
}

/** The files in a folder that are no notes of this program, sorted. */
std::vector<fs::path>
FindOutputs(const fs::path & folder)
{
  std::vector<fs::path> files;
  for (const auto & entry : fs::directory_iterator(folder))
  {
    if (entry.path().filename().string()[0] != '.')
    {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/** Adds the numbers and words of an object of a report, those of objects in it by names such as
 * deviation.meanInMillimetres. */
void
Flatten(const Report & object, const std::string & prefix, Report & flat)
{
  for (const auto & [key, value] : object.items())
  {
    if (value.is_object())
    {
      Flatten(value, key == "measures" ? prefix : prefix + key + '.', flat);
    }
    else if (value.is_primitive() && !value.is_null())
    {
      flat[prefix + key] = value;
    }
  }
}

/** The measures of each surface in a report. */
void
AddSurfaces(const fs::path & sidecar, Report & surfaces)
{
  const Report report = Report::parse(std::ifstream(sidecar), nullptr, false);
  if (!report.is_object() || !report.contains("surfaces") || !report["surfaces"].is_array())
  {
    return;
  }
  for (const Report & surface : report["surfaces"])
  {
    surfaces.push_back({ { "output", sidecar.stem().string() } });
    Flatten(surface, "", surfaces.back());
  }
}

} // namespace

std::string
HashOptions(const BatchCase & batchCase, const Pipeline & pipeline)
{
  std::string text = pipeline.hash;
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
  const PipelineStep & step = m_Settings.pipeline.steps[m_Step];
  std::vector<std::string> arguments = GetArguments(step, m_Case);
  arguments.insert(arguments.begin(),
                   (arguments.front() == "render" ? m_Settings.drawingProgram : m_Settings.program).string());
  m_ChildStart = Clock::now();
  m_Child = std::make_unique<ChildProcess>(
    arguments, m_Stage, std::string(outputFile), std::string(errorsFile), m_Settings.maximumMemory);
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
  if (this->TakeStep())
  {
    if (m_Step < m_Settings.pipeline.steps.size())
    {
      this->StartStep();
      return false;
    }
    m_Record["input"]["md5"] = m_InputHash.get();
    this->Succeed();
  }
  m_Record["seconds"] = SecondsSince(m_Start);
  return true;
}

/** Takes what an ended child has left. Whether it succeeded. */
bool
CaseRun::TakeStep()
{
  const PipelineStep & step = m_Settings.pipeline.steps[m_Step];
  m_Record["steps"].push_back({ { "output", step.output },
                                { "seconds", SecondsSince(m_ChildStart) },
                                { "peakMemory", m_Child->GetPeakMemory() } });
  m_Record["peakMemory"] = std::max(m_Record["peakMemory"].get<std::uintmax_t>(), m_Child->GetPeakMemory());
  const int code = m_Child->GetExitCode();
  const std::string command = "rhombic " + step.arguments.front();
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
    const std::string sentence = FindSentence(m_Stage / errorsFile);
    this->Fail(code, sentence.empty() ? command + " ended with exit code " + std::to_string(code) + "." : sentence);
  }
  else
  {
    ++m_Step;
  }
  return m_Cause.empty();
}

void
CaseRun::Fail(int code, const std::string & cause)
{
  m_Cause = cause;
  m_Record["code"] = code;
  m_Record["cause"] = WithoutNames(cause, m_Case, m_Stage);
}

void
CaseRun::Succeed()
{
  try
  {
    fs::remove(m_Stage / outputFile);
    fs::remove(m_Stage / errorsFile);
    this->AddOutputs();
    const fs::path place = m_Settings.output / m_Case.folder;
    fs::create_directories(place.parent_path());
    fs::rename(m_Stage, place);
    const int folder = open(place.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    fsync(folder);
    close(folder);
    m_Record["status"] = "done";
  }
  catch (const std::exception & error) // of files: a full disk, a folder that was removed
  {
    this->Fail(static_cast<int>(FailureKind::Output), DescribeError(error));
  }
}

/** The case's outputs with their hashes: in its record, and in case.json beside them. */
void
CaseRun::AddOutputs()
{
  m_Record["outputs"] = Report::array();
  m_Record["surfaces"] = Report::array();
  for (const fs::path & file : FindOutputs(m_Stage))
  {
    m_Record["outputs"].push_back(
      { { "name", file.filename().string() }, { "bytes", fs::file_size(file) }, { "md5", HashFiles({ file }) } });
    if (file.extension() == ".json")
    {
      AddSurfaces(file, m_Record["surfaces"]);
    }
  }
  Report sidecar = m_Record;
  for (const char * const key : { "status", "code", "cause", "seconds", "peakMemory", "steps", "surfaces" })
  {
    sidecar.erase(key);
  }
  sidecar["input"].erase("stamp");
  StagedFiles staged;
  StageText(ToJson(sidecar) + '\n', m_Stage / "case.json", staged);
  staged.Commit();
}

} // namespace rhombic
