#ifndef rhombicRunBatch_h
#define rhombicRunBatch_h

#include "rhombicBatchCases.h"
#include "rhombicEvents.h"
#include "rhombicPipelineFile.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rhombic
{

/** The cases and outputs of RunBatch(), and its limits. */
struct BatchSettings
{
  std::vector<BatchCase> cases;
  /** The cases are some of a collection. The others may run at the same time, here or on other machines; no tables are
   * written. */
  bool isPart = false;
  bool writesCasesTable = true; ///< cases.tsv, which names the cases' files
  Pipeline pipeline;
  std::filesystem::path output;     ///< a folder: new, empty, or of an earlier run
  std::filesystem::path program;    ///< `rhombic`
  std::string requestOption;        ///< its argument when standard input holds its command
  std::string software;             ///< name and version
  unsigned int jobs = 1;            ///< cases at the same time
  unsigned int threads = 1;         ///< of each case
  std::uintmax_t maximumMemory = 0; ///< of each process, in bytes
  double maximumSeconds = 3600.0;   ///< of each case

  /** Asked several times a second: true ends the run. May be empty. */
  std::function<bool()> isStopped;
};

/** The state of a case before a run. */
enum class CaseState
{
  Missing, ///< it never ended, or its outputs are gone
  Changed, ///< its files, the pipeline or the version are others
  Failed,
  Done
};

/** "missing", "changed", "failed" or "done". */
std::string
NameOf(CaseState state);

/** The state of a case, with its time and memory, or estimates of both. */
struct CasePlan
{
  CaseState state = CaseState::Missing;
  double seconds = 0.0;
  std::uintmax_t memory = 0; ///< the largest of a process, in bytes
};

/** The plans of BatchSettings::cases. Reads the inputs of cases whose files changed, and the headers of those that are
 * not done: time and memory are estimated from the number of voxels, and corrected by those of the cases that are done.
 */
std::vector<CasePlan>
PlanBatch(const BatchSettings & settings);

/** Numbers of cases after a run. */
struct BatchSummary
{
  std::size_t done = 0; ///< by this or an earlier run
  std::size_t failed = 0;
  std::size_t notRun = 0;
  bool isStopped = false;
};

/** Runs the pipeline's steps on each case that is not done, each step in a child process, and writes into the folder of
 * outputs: a folder for each case of which anything is made, journal.jsonl, results.tsv, results.json, measures.tsv and
 * outputs.tsv with the descriptions of their columns (.json), cases.tsv, index.html.
 *
 * A case's folder appears when its last step has ended, with the outputs of all steps that succeeded; the case has
 * failed if any step did not. The folder is removed before the case runs again. A run that was killed is continued by
 * the next run; both together write the same outputs as a single run, for any number of jobs. Paths and names of input
 * files are in cases.tsv alone, which only its owner may read, and patients' names only in DICOM files that the
 * pipeline asks for, which a note says.
 *
 * The children end with the calling thread. Each gets {"command": "mesh", "settings": {...}, "threads": 2} on standard
 * input, and writes {"outputs": [{"name": "bone.stl", "kind": "mesh", "measures": [...]}]} or {"failure": sentence} to
 * standard output.
 *
 * Throws Failure: Output, Internal. Failures of cases are in the results. */
BatchSummary
RunBatch(const BatchSettings & settings, const Events & events);

/** Writes the tables and the index of the cases in the journal so far, also beside runs. Throws Failure(Output). */
BatchSummary
WriteBatchTables(const BatchSettings & settings);

/** Summarizes measures.tsv in a folder of outputs: writes statistics.tsv there, a line for each measure of each
 * surface, with number of cases, least value, quartiles and largest value, and the cases that lie apart. Surfaces of
 * one name that are finished differently for several outputs (outputs.tsv) have lines of their own. Returns the same
 * with blanks instead of tabs, to be read.
 *
 * Quartiles are interpolated between the sorted values (Hyndman and Fan 1996, type 7). A value lies apart when it
 * differs from the median by more than 3.5 standard deviations, which are estimated as 1.4826 times the median of all
 * such differences (Iglewicz and Hoaglin 1993), or, where more than half of the values are the same, as 1.2533 times
 * their mean. Of fewer than 5 values, none does.
 *
 * Throws Failure: NotFound and Unreadable without measures.tsv and outputs.tsv of this version, Output. */
std::string
WriteBatchStatistics(const std::filesystem::path & folder);

} // namespace rhombic

#endif
