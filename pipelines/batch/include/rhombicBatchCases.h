#ifndef rhombicBatchCases_h
#define rhombicBatchCases_h

#include "rhombicScanReport.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rhombic
{

/** One scan of a collection. */
struct BatchCase
{
  std::string name;
  std::filesystem::path folder;             ///< of its outputs, below those of the batch: its name, by default
  std::filesystem::path scan;               ///< absolute
  std::filesystem::path labels;             ///< its label map or folder of masks, absolute; empty for none
  std::vector<std::string> options;         ///< of each of its commands, as "--series=1b2c"
  std::map<std::string, Report> settings;   ///< that the options set, by the command's name
  std::vector<std::filesystem::path> files; ///< all that is read, sorted
  /** The label map or folder of masks that its labels, or its scan without labels, should agree with; absolute; empty
   * for none. */
  std::filesystem::path reference;

  /** The size of all files in bytes. */
  std::uintmax_t
  GetSize() const;
};

/** How the cases of a collection are found and named. */
struct CaseSearch
{
  /** Names of cases in a tree of folders are made from their paths, which may name patients. Otherwise they are made
   * from a hash of the path below the collection. */
  bool namesFromPaths = false;

  std::filesystem::path excluded; ///< a folder that is not searched
  std::vector<std::string> only;  ///< names of the cases to choose, with wildcards; empty: all
};

/** The cases of a collection, and notes on left out files. */
struct CaseCollection
{
  std::vector<BatchCase> cases; ///< in the order of their paths, or of the manifest; names are different
  std::vector<std::string> notes;
};

/** Whether a folder is a BIDS dataset: it has dataset_description.json and folders sub-... */
bool
IsBIDS(const std::filesystem::path & folder);

/** The cases of
 * - a manifest (.tsv): columns case, scan, and perhaps labels, reference and options, with paths relative to the
 *   manifest;
 * - a BIDS dataset (see IsBIDS()): each volume in a folder anat, with its label map (..._dseg) from there or from the
 *   derivatives, if a label map is there;
 * - any other folder: each DICOM series, volume file and image of OME-Zarr in it and in its subfolders, but for
 *   hidden ones, symbolic links, and series of a single slice beside others;
 * - a single volume file.
 *
 * Throws Failure: NotFound when there are none, Usage for a mistake in a manifest, naming its line, and for a chosen
 * name that no case has. */
CaseCollection
FindCases(const std::filesystem::path & collection, const CaseSearch & search = {});

} // namespace rhombic

#endif
