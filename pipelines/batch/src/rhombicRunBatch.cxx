#include "rhombicRunBatch.h"

#include "rhombicBatchJournal.h"
#include "rhombicBatchResults.h"
#include "rhombicCaseRun.h"
#include "rhombicFiles.h"
#include "rhombicFailure.h"
#include "rhombicMemoryBudget.h"
#include "rhombicScanReader.h"
#include "rhombicWording.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <map>
#include <memory>

#include <poll.h>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** Whether the outputs of a journal's line are there. */
bool
HasOutputs(const Report & record, const fs::path & folder)
{
  const Report outputs = record.value("outputs", Report::array());
  return std::all_of(outputs.begin(), outputs.end(), [&folder](const Report & output) {
    std::error_code error;
    return fs::file_size(folder / output.value("name", std::string()), error) ==
             output.value("bytes", std::uintmax_t{ 0 }) &&
           !error;
  });
}

/** A case's state. When its files have other times or places but the same contents, \a moved is set to a new line for
 * the journal. */
CaseState
FindState(const BatchCase & batchCase, const BatchSettings & settings, const Report * record, Report & moved)
{
  if (record == nullptr)
  {
    return CaseState::Missing;
  }
  const bool isDone = record->value("status", std::string()) == "done";
  if (!isDone || !HasOutputs(*record, settings.output / batchCase.folder))
  {
    return isDone ? CaseState::Missing : CaseState::Failed;
  }
  const Report input = record->value("input", Report::object());
  const std::string stamp = HashFileStates(batchCase.files);
  if (record->value("options", std::string()) != HashOptions(batchCase, settings.pipeline) ||
      record->value("software", std::string()) != settings.software)
  {
    return CaseState::Changed;
  }
  if (input.value("stamp", std::string()) != stamp)
  {
    try
    {
      if (input.value("md5", std::string()) != HashFiles(batchCase.files))
      {
        return CaseState::Changed;
      }
    }
    catch (const Failure &) // the case tells that its files can't be read
    {
      return CaseState::Changed;
    }
    moved = *record;
    moved["input"]["stamp"] = stamp;
  }
  return CaseState::Done;
}

/** The number of voxels of a case's scan, as its headers say; 0 when they can't be read. */
double
CountVoxels(const BatchCase & batchCase)
{
  ScanReadOptions options;
  options.onUneven = ScanReadOptions::Policy::Accept;
  options.onGap = ScanReadOptions::Policy::Accept;
  options.onSeveralFrames = ScanReadOptions::Policy::Accept;
  for (const auto & ofCommand : batchCase.settings)
  {
    options.series = ofCommand.second.value("series", options.series);
  }
  try
  {
    const Scan scan = OpenScan(batchCase.scan, options).scan;
    return static_cast<double>(GeometryOf(scan.image).GetLargestPossibleRegion().GetNumberOfPixels());
  }
  catch (const Failure &)
  {
    return 0.0; // the case's own command will say why
  }
}

/** Rough time and memory of a case on two cores: most cases need less than twice as much. */
CasePlan
Estimate(const BatchCase & batchCase, const Pipeline & pipeline)
{
  constexpr double startSeconds = 1.5;
  constexpr double voxelsPerSecond = 4e6;
  constexpr double startMemory = 300.0 * (1u << 20);
  constexpr double bytesPerVoxel = 16.0;
  const double voxels = CountVoxels(batchCase);
  CasePlan plan;
  plan.seconds = static_cast<double>(pipeline.steps.size()) * (startSeconds + voxels / voxelsPerSecond);
  plan.memory = static_cast<std::uintmax_t>(startMemory + bytesPerVoxel * voxels);
  return plan;
}

/** "5 s", "12 min", "3.5 h". */
std::string
DescribeDuration(double seconds)
{
  return seconds < 90.0     ? FormatFixed(seconds, 0) + " s"
         : seconds < 5400.0 ? FormatFixed(seconds / 60.0, 0) + " min"
                            : FormatFixed(seconds / 3600.0, 1) + " h";
}

/** Whether a setting is given for any output of any case. */
bool
IsGiven(const std::string & name, const BatchSettings & settings)
{
  const auto hasIt = [&name](const Report & report) { return report.contains(name); };
  return std::any_of(settings.pipeline.steps.begin(),
                     settings.pipeline.steps.end(),
                     [&hasIt](const PipelineStep & step) { return hasIt(step.settings); }) ||
         std::any_of(settings.cases.begin(), settings.cases.end(), [&hasIt](const BatchCase & batchCase) {
           return std::any_of(batchCase.settings.begin(), batchCase.settings.end(), [&hasIt](const auto & ofCommand) {
             return hasIt(ofCommand.second);
           });
         });
}

/** The names to lock: none, which is all, for a whole collection. */
std::vector<std::string>
NamesToLock(const BatchSettings & settings)
{
  std::vector<std::string> names;
  for (const BatchCase & batchCase : settings.cases)
  {
    names.push_back(batchCase.name);
  }
  return settings.isPart ? names : std::vector<std::string>();
}

const Report *
FindRecord(const CaseRecords & records, const std::string & name)
{
  const auto found = records.find(name);
  return found == records.end() ? nullptr : &found->second;
}

/** Counts the cases, and writes their tables unless they are a part. */
BatchSummary
Summarize(const BatchSettings & settings, const CaseRecords & records)
{
  BatchSummary summary;
  std::vector<Report> lines;
  for (const BatchCase & batchCase : settings.cases)
  {
    const Report * const record = FindRecord(records, batchCase.name);
    // A case that a stopped run was to repeat has lost its outputs.
    const bool hasRun = record != nullptr && HasOutputs(*record, settings.output / batchCase.folder);
    lines.push_back(hasRun ? *record : Report{ { "case", batchCase.name }, { "status", "not run" } });
    ++(!hasRun ? summary.notRun : lines.back()["status"] == "done" ? summary.done : summary.failed);
  }
  if (!settings.isPart)
  {
    WriteResults(lines, settings.writesCasesTable ? &settings.cases : nullptr, settings.output);
  }
  return summary;
}

/** Runs the cases, several at a time. */
class BatchRun
{
public:
  BatchRun(const BatchSettings & settings, const Events & events)
    : m_Settings(settings)
    , m_Events(events)
    , m_Journal(settings.output, NamesToLock(settings))
  {
    m_Settings.output = fs::canonical(settings.output); // children run in folders of their own
  }

  BatchSummary
  Run()
  {
    if (!m_Settings.isPart)
    {
      this->RemoveStages();
    }
    this->Plan();
    bool isStopped = false;
    while (!isStopped && (m_Next < m_Queue.size() || !m_Running.empty()))
    {
      while (m_Running.size() < m_Settings.jobs && m_Next < m_Queue.size())
      {
        m_Running.push_back(this->Start(*m_Queue[m_Next++].second));
      }
      this->ReportProgress();
      this->Wait();
      this->TakeEnded();
      isStopped = m_Settings.isStopped && m_Settings.isStopped();
    }
    m_Running.clear(); // ends their processes, removes their stages
    BatchSummary summary = Summarize(m_Settings, m_Journal.GetRecords());
    summary.isStopped = isStopped;
    return summary;
  }

private:
  /** Removes the stages that killed runs have left. */
  void
  RemoveStages() const
  {
    for (const fs::path & entry : ListEntries(m_Settings.output))
    {
      if (entry.filename().string().rfind(StagePrefix, 0) == 0)
      {
        fs::remove_all(entry);
      }
    }
  }

  /** Finds the cases to run. The largest are first, so that at the end no job waits long for another. */
  void
  Plan()
  {
    for (const BatchCase & batchCase : m_Settings.cases)
    {
      Report moved;
      const CaseState state =
        FindState(batchCase, m_Settings, FindRecord(m_Journal.GetRecords(), batchCase.name), moved);
      if (!moved.is_null())
      {
        m_Journal.Add(moved);
      }
      if (state != CaseState::Done)
      {
        m_Queue.emplace_back(batchCase.GetSize(), &batchCase);
      }
    }
    std::stable_sort(m_Queue.begin(), m_Queue.end(), [](const auto & a, const auto & b) { return a.first > b.first; });
    const std::size_t done = m_Settings.cases.size() - m_Queue.size();
    m_Events.Note(Count(m_Settings.cases.size(), "case") + ", " + std::to_string(done) + " done before, " +
                  std::to_string(m_Queue.size()) + " to run, " + std::to_string(m_Settings.jobs) + " at a time, " +
                  Count(m_Settings.threads, "thread") + " and at most " + DescribeBytes(m_Settings.maximumMemory) +
                  " each");
    if (IsGiven("dicom-sc", m_Settings))
    {
      m_Events.Note("DICOM files among the outputs (--dicom-sc) hold the patients' names");
    }
  }

  /** Series in one folder share its hash. */
  std::unique_ptr<CaseRun>
  Start(const BatchCase & batchCase)
  {
    std::shared_future<std::string> & hash = m_InputHashes[HashFileStates(batchCase.files)];
    if (!hash.valid())
    {
      hash = std::async(HashFiles, batchCase.files).share(); // when it is needed, where no thread can be started
    }
    return std::make_unique<CaseRun>(batchCase, m_Settings, hash);
  }

  /** Until a process ends, for at most a quarter of a second. */
  void
  Wait() const
  {
    std::vector<pollfd> descriptors;
    for (const auto & run : m_Running)
    {
      descriptors.push_back({ run->GetDescriptor(), POLLIN, 0 });
    }
    constexpr int milliseconds = 250;
    poll(descriptors.data(), descriptors.size(), milliseconds);
  }

  void
  TakeEnded()
  {
    for (auto run = m_Running.begin(); run != m_Running.end();)
    {
      if (!(*run)->Continue())
      {
        ++run;
        continue;
      }
      const Report & record = (*run)->GetRecord();
      m_Journal.Add(record);
      ++m_Ended;
      const bool isDone = (*run)->GetCause().empty();
      m_Failed += isDone ? 0 : 1;
      m_Events.Note(record["case"].get<std::string>() + ": " +
                    (isDone ? "done in " + FormatFixed(record["seconds"].get<double>(), 1) + " s, " +
                                DescribeBytes(record["peakMemory"].get<std::uintmax_t>())
                            : "failed: " + (*run)->GetCause() + " Not made: " + ListOf(record, "failedOutputs")));
      run = m_Running.erase(run);
    }
  }

  void
  ReportProgress() const
  {
    const double seconds = SecondsSince(m_Start);
    const double share = static_cast<double>(m_Ended) / static_cast<double>(m_Queue.size());
    m_Events.Progress("cases: " + std::to_string(m_Ended) + " of " + std::to_string(m_Queue.size()) +
                        (m_Failed > 0 ? ", " + std::to_string(m_Failed) + " failed" : "") +
                        (m_Ended > 0 ? ", " + DescribeDuration(seconds * (1.0 / share - 1.0)) + " left" : ""),
                      share);
  }

  BatchSettings m_Settings;
  const Events & m_Events;
  BatchJournal m_Journal;
  std::vector<std::pair<std::uintmax_t, const BatchCase *>> m_Queue; ///< with the sizes of the cases
  std::size_t m_Next = 0;                                            ///< in the queue
  std::vector<std::unique_ptr<CaseRun>> m_Running;
  std::map<std::string, std::shared_future<std::string>> m_InputHashes; ///< by the states of the files
  std::size_t m_Ended = 0;
  std::size_t m_Failed = 0; ///< of those that ended in this run
  std::chrono::steady_clock::time_point m_Start = std::chrono::steady_clock::now();
};

/** What \a work returns. Throws Failure(Output) for a file or folder of the batch that can't be changed. */
template <typename TWork>
BatchSummary
ChangeFiles(const TWork & work)
{
  try
  {
    return work();
  }
  catch (const fs::filesystem_error & error)
  {
    throw Failure(FailureKind::Output,
                  "Cannot change " + error.path1().string() + ": " + error.code().message() +
                    "; see to the disk, and run the batch again: finished cases are kept.");
  }
}

} // namespace

std::string
NameOf(CaseState state)
{
  constexpr const char * names[] = { "missing", "changed", "failed", "done" };
  return names[static_cast<std::size_t>(state)];
}

std::vector<CasePlan>
PlanBatch(const BatchSettings & settings)
{
  const CaseRecords records = ReadJournal(settings.output);
  std::vector<CasePlan> plans;
  double seconds = 0.0; // of the cases that are done, and as they were estimated
  double estimatedSeconds = 0.0;
  double memoryRatio = 0.0;
  for (const BatchCase & batchCase : settings.cases)
  {
    Report moved;
    const Report * const record = FindRecord(records, batchCase.name);
    CasePlan plan = Estimate(batchCase, settings.pipeline);
    plan.state = FindState(batchCase, settings, record, moved);
    if (plan.state == CaseState::Done)
    {
      estimatedSeconds += plan.seconds;
      seconds += record->value("seconds", 0.0);
      memoryRatio = std::max(memoryRatio, record->value("peakMemory", 0.0) / static_cast<double>(plan.memory));
      plan.seconds = record->value("seconds", 0.0);
      plan.memory = record->value("peakMemory", std::uintmax_t{ 0 });
    }
    plans.push_back(plan);
  }
  for (CasePlan & plan : plans)
  {
    if (plan.state != CaseState::Done && estimatedSeconds > 0.0)
    {
      plan.seconds *= seconds / estimatedSeconds;
      plan.memory = static_cast<std::uintmax_t>(static_cast<double>(plan.memory) * memoryRatio);
    }
  }
  return plans;
}

BatchSummary
RunBatch(const BatchSettings & settings, const Events & events)
{
  return ChangeFiles([&] { return BatchRun(settings, events).Run(); });
}

BatchSummary
WriteBatchTables(const BatchSettings & settings)
{
  return ChangeFiles([&] { return Summarize(settings, ReadJournal(settings.output)); });
}

} // namespace rhombic
