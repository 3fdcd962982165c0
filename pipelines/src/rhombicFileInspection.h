#ifndef rhombicFileInspection_h
#define rhombicFileInspection_h

#include "rhombicMeshScan.h"
#include "rhombicSourceSurfaces.h"

#include <optional>

namespace rhombic
{

/** \class FileInspection
 * \brief Writes surfaces as files, measures them, compares them with the scan, and audits them as their file holds
 * them. Notes give the main figures. */
class FileInspection
{
public:
  /** All three must outlive the inspection. */
  FileInspection(const MeshScanSettings & settings, const std::optional<Scan> & scan, const Events & events)
    : m_Settings(settings)
    , m_Scan(scan)
    , m_Events(events)
  {}

  /** Writes \a count surfaces from \a begin on as one file with its sidecar, to appear with all others of \a staged,
   * and sets their measures, deviation and audit. Throws Failure, NotWatertight for a surface that has to be watertight
   * and is not.
   * \param sourceReport the sidecar's part about the source */
  MadeFile
  Stage(const std::filesystem::path & path,
        MeshedSurface * begin,
        std::size_t count,
        const Report & sourceReport,
        StagedFiles & staged) const;

  bool
  NeedsAudit() const
  {
    return m_Settings.audits || m_Settings.requiresWatertight;
  }

  /** Notes the audit of the walls that labels share, and returns its report; nothing if they share none. Throws
   * Failure(NotWatertight) as Stage() does. */
  std::optional<Report>
  AuditTogether(const std::vector<MeshedSurface> & surfaces) const;

private:
  void
  Measure(MeshedSurface & surface) const;
  void
  Audit(const itk::TriangleSurface & stored, MeshedSurface & surface) const;
  itk::TriangleSurfaceAuditSettings
  GetAuditSettings() const;
  void
  NoteResults(const MeshedSurface & surface) const;
  void
  NoteFinish(const MeshedSurface & surface) const;
  void
  NoteThinParts(const MeshedSurface & surface) const;
  void
  NoteDeviation(const MeshedSurface & surface) const;
  std::string
  AdviseDensity() const;

  const MeshScanSettings & m_Settings;
  const std::optional<Scan> & m_Scan;
  const Events & m_Events;
};

} // namespace rhombic

#endif
