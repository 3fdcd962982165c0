#ifndef rhombicCaseRun_h
#define rhombicCaseRun_h

#include "rhombicChildProcess.h"
#include "rhombicRunBatch.h"
#include "rhombicScanReport.h"

#include <chrono>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace rhombic
{

/** The folder in which a case's outputs are made; folders of this prefix are left from killed runs. */
constexpr char StagePrefix[] = ".stage-";

double
SecondsSince(std::chrono::steady_clock::time_point start);

/** All that is in a folder, in no order. */
std::vector<std::filesystem::path>
ListEntries(const std::filesystem::path & folder);

/** A hash of all options that a case's outputs depend on. */
std::string
HashOptions(const BatchCase & batchCase, const Pipeline & pipeline);

/** Runs the steps of one case, one child process after the other. Steps run after a failed step, but not after
 * a step that takes too long. */
class CaseRun
{
public:
  /** Removes the case's stage and folder, and starts the first step. \a inputHash is the hash of the case's files. */
  CaseRun(const BatchCase & batchCase, const BatchSettings & settings, std::shared_future<std::string> inputHash);

  /** Removes the stage. */
  ~CaseRun();

  CaseRun(const CaseRun &) = delete;
  CaseRun &
  operator=(const CaseRun &) = delete;

  /** For poll(): readable when there is something to do. */
  int
  GetDescriptor() const
  {
    return m_Child->GetDescriptor();
  }

  /** Starts the next step if a step has ended. True when the case has ended, with its folder in place if any step
   * succeeded. */
  bool
  Continue();

  /** The case's line in the journal, once it has ended. */
  const Report &
  GetRecord() const
  {
    return m_Record;
  }

  /** The cause of the first failure, with names of files, which the record leaves out. */
  const std::string &
  GetCause() const
  {
    return m_Cause;
  }

private:
  using Clock = std::chrono::steady_clock;

  void
  StartStep();
  void
  TakeStep();
  void
  Fail(int code, const std::string & cause);
  void
  KeepOutputs();
  void
  AddOutputs();

  const BatchCase & m_Case;
  const BatchSettings & m_Settings;
  std::filesystem::path m_Stage;
  std::vector<const PipelineStep *> m_Steps; ///< those of the pipeline that are made of the case
  std::size_t m_Step = 0;
  std::unique_ptr<ChildProcess> m_Child;
  bool m_IsTooLong = false;
  std::map<std::string, Report> m_Made; ///< outputs, by the names of files
  Clock::time_point m_Start = Clock::now();
  Clock::time_point m_ChildStart;
  std::shared_future<std::string> m_InputHash;
  Report m_Record;
  std::string m_Cause;
};

} // namespace rhombic

#endif
