#ifndef rhombicBatchJournal_h
#define rhombicBatchJournal_h

#include "rhombicScanReport.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rhombic
{

/** The last line of each case in the journal of a folder of outputs; empty when there is none. */
using CaseRecords = std::map<std::string, Report>;

CaseRecords
ReadJournal(const std::filesystem::path & folder);

/** The file journal.jsonl in the folder of outputs: one line of JSON for each case that ended, with "case" as its
 * name. Lines are only added, and are on the disk before Add() returns.
 *
 * The journal locks cases: as long as the journal is open, no other journal can be opened for them, on all machines
 * that share the folder. The locks go with the process. */
class BatchJournal
{
public:
  /** Opens or creates the journal and locks the cases of these names; all, when there are none. Throws Failure(Output)
   * when the folder belongs to something else, a case is locked, or the journal can't be written. */
  BatchJournal(const std::filesystem::path & folder, const std::vector<std::string> & cases);
  ~BatchJournal();

  BatchJournal(const BatchJournal &) = delete;
  BatchJournal &
  operator=(const BatchJournal &) = delete;

  /** The last line of each case. */
  const CaseRecords &
  GetRecords() const
  {
    return m_Records;
  }

  /** Throws Failure(Output). */
  void
  Add(const Report & line);

private:
  std::filesystem::path m_Path;
  int m_Descriptor = -1; ///< holds the locks
  CaseRecords m_Records;
};

} // namespace rhombic

#endif
