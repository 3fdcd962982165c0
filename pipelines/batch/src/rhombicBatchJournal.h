#ifndef rhombicBatchJournal_h
#define rhombicBatchJournal_h

#include "rhombicScanReport.h"

#include <filesystem>
#include <map>
#include <string>

namespace rhombic
{

/** \class BatchJournal
 * \brief The file journal.jsonl in the folder of outputs: one line of JSON for each case that ended, with "case" as its
 * name. Lines are only added, and are on the disk before Add() returns.
 *
 * The journal locks the folder: as long as it is open, no other one can be opened there. The lock goes with the
 * process. */
class BatchJournal
{
public:
  /** Opens or creates the journal. Throws Failure(Output) when the folder belongs to something else, is used by another
   * run, or can't be written. */
  explicit BatchJournal(const std::filesystem::path & folder);
  ~BatchJournal();

  BatchJournal(const BatchJournal &) = delete;
  BatchJournal &
  operator=(const BatchJournal &) = delete;

  /** The last line of a case; null when there is none. */
  const Report *
  Find(const std::string & name) const;

  /** Throws Failure(Output). */
  void
  Add(const Report & line);

private:
  std::filesystem::path m_Path;
  int m_Descriptor = -1; ///< holds the lock
  std::map<std::string, Report> m_Last;
};

} // namespace rhombic

#endif
