#ifndef rhombicFileInspection_h
#define rhombicFileInspection_h

#include "rhombicMeshScan.h"
#include "rhombicSourceSurfaces.h"

#include <optional>

namespace rhombic
{

/** \class FileInspection
 * \brief How surface files are written, measured, compared with the scan, and audited as their file holds them. Notes
 * give the main figures. All three must outlive the object. */
struct FileInspection
{
  const MeshScanSettings & settings;
  const std::optional<Scan> & scan;
  const Events & events;
};

/** Writes \a count surfaces from \a begin on as one file with its sidecar, and sets their measures, deviation and
 * audit. Throws Failure, NotWatertight for a surface that has to be watertight and is not. \param sourceReport the
 * sidecar's part about the source */
void
StageInspected(const FileInspection & inspection,
               const std::filesystem::path & path,
               MeshedSurface * begin,
               std::size_t count,
               const Report & sourceReport,
               OutputFiles & outputs);

/** Notes the audit of the walls that labels share, and returns its report; nothing if they share none. Throws
 * Failure(NotWatertight) as StageInspected() does. */
std::optional<Report>
AuditTogether(const FileInspection & inspection, const std::vector<MeshedSurface> & surfaces);

} // namespace rhombic

#endif
