#include "rhombicCommandLine.h"
#include "rhombicMemoryBudget.h"
#include "rhombicRunBatch.h"
#include "rhombicSidecar.h"
#include "rhombicWording.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <system_error>
#include <tuple>
#include <utility>

namespace rhombic
{
namespace
{

struct BatchOptions
{
  std::string collection;
  std::string output;
  std::string pipeline;
  std::vector<std::string> only;
  unsigned int jobs = 0;
  std::uint64_t maximumMemory = 0;
  double maximumSeconds = BatchSettings().maximumSeconds;
  bool namesFromPaths = false;
  bool isDryRun = false;
  bool writesTables = false;
  bool writesStatistics = false;
  bool hasNoCasesTable = false;
  bool isBIDS = false; ///< the outputs are a BIDS dataset, too
};

/** Parses the options of cases. Refuses options and label maps that do not go with an output, before any case runs. */
void
ParseOptions(std::vector<BatchCase> & cases, const Pipeline & pipeline)
{
  const CommandSyntax syntax = GetCommandSyntax();
  using Given = std::tuple<bool, bool, std::vector<std::string>>; // labels, a reference, and which options
  std::map<Given, std::map<std::string, Report>> known;
  for (BatchCase & batchCase : cases)
  {
    const auto isMade = [&batchCase](const PipelineStep & step) { return IsMadeOf(step, batchCase); };
    if (std::none_of(pipeline.steps.begin(), pipeline.steps.end(), isMade))
    {
      throw Failure(FailureKind::Usage,
                    "The case " + batchCase.name +
                      " has no reference, and all outputs are agreements with it; name it in the column reference of "
                      "the manifest, or leave out the case.");
    }
    const auto [place, isNew] = known.emplace(
      Given(!batchCase.labels.empty(), !batchCase.reference.empty(), batchCase.options), batchCase.settings);
    for (std::size_t n = 0; n < pipeline.steps.size() && isNew; ++n)
    {
      const PipelineStep & step = pipeline.steps[n];
      if (!isMade(step))
      {
        continue;
      }
      try
      {
        Report & settings = place->second[step.command];
        settings = IsAgreement(step) ? Report::object() : syntax.parse(step.command, batchCase.options);
        syntax.check(step.command, GetSettings(step, batchCase, settings, ""));
      }
      catch (const Failure & failure)
      {
        throw Failure(FailureKind::Usage,
                      "The options of the case " + batchCase.name + " don't go with the output " + step.output + ": " +
                        failure.GetDescription());
      }
    }
    batchCase.settings = place->second;
  }
}

/** Makes a folder of outputs a BIDS derivative. */
void
DescribeDataset(const std::filesystem::path & folder)
{
  const Report description{ { "Name", "Surfaces and pictures of scans" },
                            { "BIDSVersion", "1.8.0" },
                            { "DatasetType", "derivative" },
                            { "GeneratedBy", { { { "Name", "Rhombic" }, { "Version", RHOMBIC_VERSION } } } } };
  StagedFiles staged;
  StageText(ToJson(description) + '\n', folder / "dataset_description.json", staged);
  staged.Commit();
}

BatchSettings
GetSettings(const BatchOptions & options, const Events & events)
{
  if (options.collection.empty() || options.output.empty())
  {
    throw Failure(FailureKind::Usage,
                  "Name a collection and a folder for the outputs, as in rhombic batch scans -o results.");
  }
  const std::string casesTable = options.output + "/cases.tsv";
  std::error_code missing;
  if (options.hasNoCasesTable && std::filesystem::equivalent(options.collection, casesTable, missing))
  {
    throw Failure(FailureKind::Usage,
                  "--no-cases-table would remove the manifest " + casesTable + "; leave it out, or move the manifest.");
  }
  BatchSettings settings;
  settings.pipeline = ReadPipeline(options.pipeline, GetCommandSyntax());
  CaseCollection collection = FindCases(options.collection, { options.namesFromPaths, options.output, options.only });
  for (const std::string & note : collection.notes)
  {
    events.Note(note);
  }
  AddAgreement(collection.cases, settings.pipeline);
  ParseOptions(collection.cases, settings.pipeline);
  settings.cases = std::move(collection.cases);
  for (BatchCase & batchCase : settings.cases)
  {
    if (options.isBIDS) // as sub-01/anat/sub-01_T1w
    {
      const auto dataset = std::filesystem::canonical(options.collection);
      batchCase.folder = batchCase.scan.parent_path().lexically_relative(dataset) / batchCase.name;
    }
  }
  settings.isPart = !options.only.empty();
  settings.writesCasesTable = !options.hasNoCasesTable;
  settings.output = options.output;
  settings.program = std::filesystem::read_symlink("/proc/self/exe");
  settings.requestOption = RequestOption;
  settings.software = "Rhombic " RHOMBIC_VERSION;
  settings.maximumSeconds = options.maximumSeconds;
  const unsigned int threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  settings.jobs = options.jobs > 0 ? options.jobs : std::max(1u, threads / 2);
  settings.threads = std::max(1u, threads / settings.jobs);
  settings.maximumMemory = options.maximumMemory > 0 ? options.maximumMemory : FreeMemory() / 10 * 9 / settings.jobs;
  return settings;
}

/** Prints the plan as a manifest. */
void
PrintPlan(const BatchSettings & settings, const Events & events)
{
  const std::vector<CasePlan> plans = PlanBatch(settings);
  double seconds = 0.0;
  std::uintmax_t memory = 0;
  std::cout << "case\tscan\tlabels\treference\toptions\tstate\tmegabytes\tseconds\tpeak_MiB\n";
  for (std::size_t n = 0; n < settings.cases.size(); ++n)
  {
    const BatchCase & batchCase = settings.cases[n];
    const CasePlan & plan = plans[n];
    std::cout << batchCase.name << '\t' << batchCase.scan.string() << '\t' << batchCase.labels.string() << '\t'
              << batchCase.reference.string() << '\t';
    for (const std::string & option : batchCase.options)
    {
      std::cout << (&option == &batchCase.options.front() ? "" : " ") << option;
    }
    std::cout << '\t' << NameOf(plan.state) << '\t' << FormatFixed(static_cast<double>(batchCase.GetSize()) / 1e6, 1)
              << '\t' << FormatFixed(plan.seconds, 1) << '\t'
              << FormatFixed(static_cast<double>(plan.memory) / (1u << 20), 0) << '\n';
    if (plan.state != CaseState::Done)
    {
      seconds += plan.seconds;
      memory = std::max(memory, plan.memory);
    }
  }
  events.Note(Count(settings.cases.size(), "case") + ", " + std::to_string(settings.jobs) + " at a time, " +
              Count(settings.threads, "thread") + " and at most " + DescribeBytes(settings.maximumMemory) +
              " each; estimated: " + FormatFixed(seconds / settings.jobs / 60.0, 1) +
              " min for what is not done, and up to " + DescribeBytes(memory) + " each");
}

volatile std::sig_atomic_t stopSignal = 0;

extern "C" void
RememberSignal(int signal)
{
  stopSignal = signal;
}

void
NoteSummary(const BatchSummary & summary, const std::string & place, const Events & events)
{
  events.Note(std::to_string(summary.done) + " done, " + std::to_string(summary.failed) + " failed" +
              (summary.notRun > 0 ? ", " + std::to_string(summary.notRun) + " not run" : "") + ": " + place);
}

void
Batch(const BatchOptions & options, const CommandContext & context)
{
  const Events events = context.console->MakeEvents();
  if (options.writesStatistics && !options.output.empty())
  {
    std::cout << WriteBatchStatistics(options.output);
    events.Note("statistics: " + options.output + "/statistics.tsv");
    return;
  }
  BatchSettings settings = GetSettings(options, events);
  if (options.isDryRun)
  {
    PrintPlan(settings, events);
    return;
  }
  if (options.writesTables)
  {
    NoteSummary(WriteBatchTables(settings), options.output + "/index.html", events);
    return;
  }
  for (const int signal : { SIGINT, SIGTERM, SIGHUP })
  {
    if (std::signal(signal, RememberSignal) == SIG_IGN)
    {
      std::signal(signal, SIG_IGN);
    }
  }
  settings.isStopped = [] { return stopSignal != 0; };
  const BatchSummary summary = RunBatch(settings, events);
  if (options.isBIDS)
  {
    DescribeDataset(options.output);
  }
  const std::string advice = options.isBIDS ? "; the level group writes the tables" : "; --tables writes the tables";
  NoteSummary(summary, options.output + (settings.isPart ? advice : "/index.html"), events);
  if (summary.isStopped)
  {
    events.Note("stopped; the same command goes on where this one ended");
    context.console->Finish();
    std::signal(stopSignal, SIG_DFL);
    std::raise(stopSignal);
  }
  if (summary.failed > 0)
  {
    throw Failure(FailureKind::SomeFailed,
                  Count(summary.failed, "case") + " of " + std::to_string(settings.cases.size()) + " failed; see " +
                    options.output + (settings.isPart ? "/journal.jsonl" : "/results.tsv") + " for the causes.");
  }
}

/** The settings that batch and bids have. */
const SettingsTable<BatchOptions> &
RunTable()
{
  static const SettingsTable<BatchOptions> table{
    { "--pipeline", &BatchOptions::pipeline, "what is made of each case, a .yaml file (default: a page)" },
    { "-j,--jobs",
      &BatchOptions::jobs,
      "cases at the same time; they share --threads (default: half of them)",
      Checked(CLI::Range(1u, 1024u)) },
    { "--max-memory",
      &BatchOptions::maximumMemory,
      "most memory of a case, as 8G (default: 90 % of what is free, shared by the jobs)",
      InBytes },
    { "--max-time", &BatchOptions::maximumSeconds, "most seconds of a case", AboveZero, ShowingDefault },
    { "--no-cases-table",
      &BatchOptions::hasNoCasesTable,
      "leave out cases.tsv, which tells the paths of the cases' scans, to its owner alone" },
    { "--dry-run", &BatchOptions::isDryRun, "print the cases, their states, and estimates, as a manifest, and stop" },
  };
  return table;
}

} // namespace

CommandRun
AddBatchCommand(CommandSettings & command)
{
  static const SettingsTable<BatchOptions> folders{
    { "COLLECTION",
      &BatchOptions::collection,
      "a folder of scans, in which every series and volume is a case; a BIDS dataset; or a manifest (.tsv) with "
      "columns case, scan, labels, reference, options" },
    { "-o,--output", &BatchOptions::output, "the folder of all outputs: new, empty, or to go on with" },
  };
  static const SettingsTable<BatchOptions> choice{
    { "--case",
      &BatchOptions::only,
      "run the cases of this name only, which may have wildcards, also beside other such runs; writes no tables; "
      "repeatable" },
    { "--tables",
      &BatchOptions::writesTables,
      "run nothing; write the tables and the index of what is done so far",
      Excludes({ "--case" }) },
    { "--stats",
      &BatchOptions::writesStatistics,
      "run nothing; print and write what the measures of all cases are together (OUT/statistics.tsv), and which cases "
      "lie apart; needs no COLLECTION" },
    { "--names-from-paths",
      &BatchOptions::namesFromPaths,
      "name cases by their paths in the folder, if these name no patients (default: by a hash)" },
  };
  const auto options = std::make_shared<BatchOptions>();
  command.Add(folders, *options);
  command.Add(RunTable(), *options);
  command.Add(choice, *options);
  return WithoutOutputs([options](const CommandContext & context) { Batch(*options, context); });
}

CommandRun
AddBIDSCommand(CommandSettings & command)
{
  struct BIDSOptions
  {
    BatchOptions batch;
    std::string level;
    std::vector<std::string> participants;
  };
  static const SettingsTable<BIDSOptions> table{
    { "BIDS_DIR", &BIDSOptions::batch, &BatchOptions::collection, "a BIDS dataset", Required },
    { "OUT_DIR",
      &BIDSOptions::batch,
      &BatchOptions::output,
      "the folder of the derivative: new, empty, or to go on with",
      Required },
    { "LEVEL",
      &BIDSOptions::level,
      "participant: runs the volumes in anat; group: writes the tables and the index of what is done so far",
      Required,
      Checked(CLI::IsMember({ "participant", "group" })) },
    { "--participant-label,--participant_label",
      &BIDSOptions::participants,
      "run these participants only, with or without sub-, also beside other such runs; writes no tables",
      SeveralBehindOneName },
  };
  const auto options = std::make_shared<BIDSOptions>();
  options->batch.isBIDS = true;
  command.Add(table, *options);
  command.Add(RunTable(), options->batch);
  return WithoutOutputs([options](const CommandContext & context) {
    BatchOptions & batch = options->batch;
    if (!IsBIDS(batch.collection))
    {
      throw Failure(FailureKind::NotFound,
                    batch.collection +
                      " is no BIDS dataset, a folder with dataset_description.json and folders sub-...; rhombic batch "
                      "takes other folders.");
    }
    batch.writesTables = options->level == "group";
    if (batch.writesTables && !options->participants.empty())
    {
      throw Failure(FailureKind::Usage, "The level group is of all participants; leave out --participant-label.");
    }
    for (const std::string & label : options->participants)
    {
      batch.only.push_back((label.rfind("sub-", 0) == 0 ? "" : "sub-") + label + "_*");
    }
    Batch(batch, context);
  });
}

} // namespace rhombic
