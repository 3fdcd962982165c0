#ifndef rhombicPipelineFile_h
#define rhombicPipelineFile_h

#include "rhombicBatchCases.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rhombic
{

/** \class PipelineStep
 * \brief One output of each case, and the command of `rhombic` that makes it. */
struct PipelineStep
{
  std::string output;                 ///< name of the file
  std::string kind;                   ///< page, picture, mesh or volume
  std::vector<std::string> arguments; ///< the command and its options, without scan, labels and output
  bool takesLabels = false;           ///< the command shows the labels of cases that have any
  std::size_t line = 0;               ///< in the pipeline file, from 1
};

/** \class Pipeline
 * \brief What is made of each case. */
struct Pipeline
{
  std::vector<PipelineStep> steps;
  std::string hash; ///< of the steps, and of the files that they name
};

/** \class CommandSyntax
 * \brief The options of `rhombic`'s commands. */
struct CommandSyntax
{
  /** The long names of a command's options, without dashes. */
  std::function<std::vector<std::string>(const std::string & command)> optionsOf;

  /** Returns the files that the program would write, as far as their names are known. Throws Failure(Usage) when it
   * would refuse the arguments. Reads and writes nothing. */
  std::function<std::vector<std::filesystem::path>(const std::vector<std::string> & arguments)> check;
};

/** Reads a pipeline file, or an empty path for the default: a page, page.png, with "preset: auto".
 *
 * The file is YAML: a list "outputs", and "options" for those of them whose command has the option. Each output is
 * "page", "picture", "mesh" or "volume" with a file's name, and options of the commands render, render, mesh and
 * resample by their long names. "true" gives an option that has no value, "false" leaves it out, a list repeats it. One
 * key is not that of the commands: "labels: false" for an output without the case's labels.
 *
 * Throws Failure: NotFound, or Usage, naming the line of the mistake. */
Pipeline
ReadPipeline(const std::filesystem::path & path, const CommandSyntax & syntax);

/** The arguments of `rhombic` for a step of a case. */
std::vector<std::string>
GetArguments(const PipelineStep & step, const BatchCase & batchCase);

} // namespace rhombic

#endif
