#ifndef rhombicFileInspection_h
#define rhombicFileInspection_h

#include "rhombicMeshScan.h"
#include "rhombicSourceSurfaces.h"

#include <optional>

namespace rhombic
{

/** \class FileInspection
 * \brief Measures surfaces, compares them with the scan, and audits them as their file holds them. Notes give the main
 * figures. */
class FileInspection
{
public:
  /** All three must outlive the inspection. */
  FileInspection(const MeshScanSettings & settings, const std::optional<Scan> & scan, const Events & events)
    : m_Settings(settings)
    , m_Scan(scan)
    , m_Events(events)
  {}

  /** Sets the surface's sizes, measures and deviation. For any thread. */
  void
  Measure(MeshedSurface & surface) const;

  void
  NoteResults(const MeshedSurface & surface) const;

  bool
  NeedsAudit() const
  {
    return m_Settings.audits || m_Settings.requiresWatertight;
  }

  /** Sets and notes the audit of a surface as its file holds it. Throws Failure(NotWatertight) for a surface that has
   * to be watertight and is not.
   *
   * \param stored the surface as the file holds it */
  void
  Audit(const itk::TriangleSurface & stored, MeshedSurface & surface) const;

  /** Notes the audit of the walls that labels share, and returns its report; nothing if they share none. Throws
   * Failure(NotWatertight) as Audit() does. */
  std::optional<Report>
  AuditTogether(const std::vector<MeshedSurface> & surfaces) const;

private:
  itk::TriangleSurfaceAuditSettings
  GetAuditSettings() const;
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
