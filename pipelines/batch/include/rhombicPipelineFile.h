#ifndef rhombicPipelineFile_h
#define rhombicPipelineFile_h

#include "rhombicBatchCases.h"
#include "rhombicScanReport.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rhombic
{

/** One output of each case, and the command of `rhombic` that makes it. */
struct PipelineStep
{
  std::string output;             ///< name of the file
  std::string kind;               ///< page, picture, mesh, volume or agreement
  std::string command;            ///< of `rhombic`
  Report settings;                ///< of the command, by their names, without scan, labels and output
  std::vector<std::string> files; ///< names of those settings that are files to write, but for the output
  bool takesLabels = false;       ///< the command shows the labels of cases that have any
  std::size_t line = 0;           ///< in the pipeline file, from 1
};

/** The outputs of each case. */
struct Pipeline
{
  std::vector<PipelineStep> steps;
  std::string hash; ///< of the steps, and of the files that they name
};

/** The settings of `rhombic`'s commands. */
struct CommandSyntax
{
  /** A setting that a pipeline file may hold. */
  struct Setting
  {
    std::string name;
    bool isInputFile; ///< that may lie beside the pipeline file
    bool isOutput;    ///< a file to write, beside the command's main output
  };

  std::function<std::vector<Setting>(const std::string & command)> settingsOf;

  /** Returns the files that the command would write; names of surfaces, which are not known yet, are
   * NamePlaceholder. Throws Failure(Usage) when it would refuse the settings. Reads and writes nothing. */
  std::function<std::vector<std::filesystem::path>(const std::string & command, const Report & settings)> check;

  /** The settings that options have, as words of a command line. Throws Failure(Usage). */
  std::function<Report(const std::string & command, const std::vector<std::string> & options)> parse;
};

/** Reads a pipeline file, or an empty path for the default: a page, page.png, with "preset: auto".
 *
 * The file is YAML: a list "outputs", and "options" for those of them whose command has the option. Each output is
 * "page", "picture", "mesh", "volume" or "agreement" with a file's name, and options of the commands render, render,
 * mesh, resample and compare-labels by their long names. "true" gives an option that has no value, "false" leaves it
 * out, a list repeats it. One key is not that of the commands: "labels: false" for an output without the case's labels.
 *
 * Throws Failure: NotFound, or Usage, naming the line of the mistake. */
Pipeline
ReadPipeline(const std::filesystem::path & path, const CommandSyntax & syntax);

/** Whether an output is the agreement of a case's labels with its reference. Cases' options are not of its command. */
bool
IsAgreement(const PipelineStep & step);

/** Whether an output is made of a case: an agreement only where there is a reference. */
bool
IsMadeOf(const PipelineStep & step, const BatchCase & batchCase);

/** Adds the output agreement.tsv if any case has a reference, unless the pipeline has an output of this kind. */
void
AddAgreement(const std::vector<BatchCase> & cases, Pipeline & pipeline);

/** All settings of the command for a step of a case, whose outputs are written to a folder. Agreements are those of the
 * case's reference (A) with its labels, or with its scan without labels (B).
 * \param further settings, as those that CommandSyntax::parse() finds in the case's options. Lists go behind the
 * step's; what may be given once is refused by the command if the step has it. */
Report
GetSettings(const PipelineStep & step,
            const BatchCase & batchCase,
            const Report & further,
            const std::filesystem::path & folder);

} // namespace rhombic

#endif
