#ifndef rhombicSidecar_h
#define rhombicSidecar_h

#include "rhombicAtomicFile.h"
#include "rhombicScanReport.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** \class Provenance
 * \brief Program and command that made an output, for its sidecar and its metadata. Nothing here is about the patient,
 * and nothing that has no effect on the output. */
struct Provenance
{
  std::string software; ///< name and version
  std::string command;  ///< as a reader may type it again: "rhombic render SCAN --preset=ct-bone"
  Report settings;      ///< of the command, by their names
  bool writesSidecars = true;
};

/** The path of an output's report: the output's name and ".json". */
std::filesystem::path
SidecarOf(const std::filesystem::path & output);

/** The outputs, and their sidecars if any are written. */
std::vector<std::filesystem::path>
WithSidecars(std::vector<std::filesystem::path> outputs, const Provenance & provenance);

/** Writes the sidecar of an output, if any are written, to appear with all others of \a staged. Throws
 * Failure(Output). */
void
StageSidecar(const std::filesystem::path & output,
             const Provenance & provenance,
             const Report & report,
             StagedFiles & staged);

/** Writes a text file, to appear with all others of \a staged. Throws Failure(Output).
 * \param permissions unknown: those of new files */
void
StageText(const std::string & text,
          const std::filesystem::path & path,
          StagedFiles & staged,
          std::filesystem::perms permissions = std::filesystem::perms::unknown);

} // namespace rhombic

#endif
