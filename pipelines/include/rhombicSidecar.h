#ifndef rhombicSidecar_h
#define rhombicSidecar_h

#include "rhombicAtomicFile.h"
#include "rhombicScanReport.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** Program and command that made an output, for its sidecar and its metadata. Nothing here is about the patient,
 * and nothing that has no effect on the output. */
struct Provenance
{
  std::string software; ///< name and version
  std::string command;  ///< as a reader may type it again: "rhombic render SCAN --preset=ct-bone"
  Report settings;      ///< of the command, by their names
  bool writesSidecars = true;
};

/** A file that a command makes. */
struct MadeFile
{
  std::filesystem::path path;
  std::string kind;                  ///< page, picture, mesh, volume, agreement, report, table, dicom or thumbnail
  Report measures = Report::array(); ///< of each surface of the file (rhombicMeasureTable.h), or each compared label
  bool isMain = true;                ///< whether a user looks for the file; others, as reports, lie beside those
};

/** The files of a command, which appear together when they are committed. The provenance must outlive the object.
 */
struct OutputFiles
{
  const Provenance & provenance;
  StagedFiles staged{};
  std::vector<MadeFile> made{};
};

/** Adds files without surfaces of their own. */
void
AddOutputs(const std::vector<std::filesystem::path> & paths,
           const std::string & kind,
           std::vector<MadeFile> & outputs,
           bool areMain = true);

/** The path of an output's report: the output's name and ".json". */
std::filesystem::path
SidecarOf(const std::filesystem::path & output);

/** The outputs, and their sidecars if any are written. */
std::vector<std::filesystem::path>
WithSidecars(std::vector<std::filesystem::path> outputs, const Provenance & provenance);

/** Adds an output with the measures of the surfaces in its report, and, if sidecars are written, its sidecar. Throws
 * Failure(Output). */
void
AddOutput(const std::filesystem::path & path, const std::string & kind, const Report & report, OutputFiles & outputs);

/** Writes a text file, to appear with all others of \a staged. Throws Failure(Output).
 * \param permissions unknown: those of new files */
void
StageText(const std::string & text,
          const std::filesystem::path & path,
          StagedFiles & staged,
          std::filesystem::perms permissions = std::filesystem::perms::unknown);

} // namespace rhombic

#endif
