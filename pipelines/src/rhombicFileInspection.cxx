#include "rhombicFileInspection.h"

#include "rhombicAuditReport.h"
#include "rhombicFailure.h"
#include "rhombicForEachBlock.h"
#include "rhombicMeasureTable.h"
#include "rhombicSurfaceReport.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace rhombic
{
namespace
{

constexpr double NotablePercent = 1.0; // smaller differences of volumes are not mentioned

/** The steps of finishing that may have changed the volume of parts. */
std::string
NameSteps(const SurfaceFinish & finish)
{
  if (finish.smoothing > 0.0)
  {
    return finish.Simplifies() ? "smoothing and simplification" : "smoothing";
  }
  return finish.Simplifies() ? "simplification" : "untangling";
}

[[noreturn]] void
RefuseToWrite(const std::string & why)
{
  throw Failure(FailureKind::NotWatertight,
                why + ", so nothing was written; leave out --require-watertight to have it all the same.");
}

} // namespace

MadeFile
FileInspection::Stage(const std::filesystem::path & path,
                      MeshedSurface * begin,
                      std::size_t count,
                      const Report & sourceReport,
                      StagedFiles & staged) const
{
  std::vector<SceneSurface> scene;
  std::transform(begin, begin + count, std::back_inserter(scene), [](const auto & surface) { return surface.scene; });
  SurfaceFileSettings file;
  file.space = m_Settings.space;
  ForEachOnThreads(2, [&](std::size_t task) {
    if (task == 0)
    {
      StageSurfaces(scene, path, staged, file);
    }
    else
    {
      std::for_each(begin, begin + count, [this](MeshedSurface & surface) { this->Measure(surface); });
    }
  });
  Report report = sourceReport;
  report["surfaces"] = Report::array();
  for (std::size_t n = 0; n < count; ++n)
  {
    this->NoteResults(begin[n]);
    if (this->NeedsAudit())
    {
      this->Audit(*SurfaceAsStored(*scene[n].surface, path), begin[n]);
    }
    report["surfaces"].push_back(ReportMeshedSurface(begin[n]));
  }
  StageSidecar(path, m_Settings.provenance, report, staged);
  return MakeOutput(path, "mesh", report);
}

/** Sets the surface's sizes, measures and deviation. For any thread. */
void
FileInspection::Measure(MeshedSurface & surface) const
{
  MeasureFinished(m_Scan ? &*m_Scan : nullptr, surface);
  surface.measures.isosurface = surface.parts.IsNothing() ? surface.isosurface : std::nullopt;
  if (m_Scan && surface.request)
  {
    constexpr std::size_t quick = 50'000; // the mean's standard error is below 0.5 % of the spread
    constexpr std::size_t thorough = 10'000'000;
    surface.deviation = ComputeDeviation(*surface.scene.surface,
                                         *m_Scan,
                                         m_Settings.source.lattice.kernel,
                                         surface.request->GetThreshold(),
                                         m_Settings.audits ? thorough : quick);
  }
}

void
FileInspection::NoteResults(const MeshedSurface & surface) const
{
  m_Events.Note(SummarizeMeasures(surface));
  this->NoteFinish(surface);
  this->NoteThinParts(surface);
  if (surface.deviation)
  {
    this->NoteDeviation(surface);
  }
}

/** Notes how finishing changed the volume of the kept parts. */
void
FileInspection::NoteFinish(const MeshedSurface & surface) const
{
  const double before = surface.GetVolumeOfKeptParts();
  const double after = surface.measures.volume;
  const double change = PercentChange(before, after);
  if (std::abs(change) > NotablePercent)
  {
    m_Events.Note(surface.scene.name + ": " + NameSteps(m_Settings.finish) + " changed the volume by " +
                  (change > 0.0 ? "+" : "") + FormatFixed(change, 1) + " %, from " +
                  FormatFixed(before / CubicMillimetresPerMl, 1) + " to " +
                  FormatMillilitres(after / CubicMillimetresPerMl));
  }
}

/** Notes by how much the surface's volume was off after extraction, if by more than the uncertainty. */
void
FileInspection::NoteThinParts(const MeshedSurface & surface) const
{
  if (surface.isosurface)
  {
    const double error = 100.0 * surface.isosurface->GetErrorOf(surface.extracted->volume);
    if (std::abs(error) > NotablePercent + 100.0 * surface.isosurface->GetRelativeUncertainty())
    {
      m_Events.Note(surface.scene.name + ": parts are thinner than the lattice's spacing, so the surface encloses " +
                    DescribeDifference(error) + " than the isosurface" + this->AdviseDensity());
    }
  }
  else if (surface.request && surface.measures.voxelVolume)
  {
    const double difference = PercentChange(*surface.measures.voxelVolume, surface.measures.volume);
    if (std::abs(difference) > NotablePercent)
    {
      m_Events.Note(surface.scene.name + ": the volume is " + FormatFixed(std::abs(difference), 1) + " % " +
                    (difference < 0.0 ? "below" : "above") +
                    " that of the scan's voxels on this side of the threshold");
    }
  }
}

/** Advice to use a denser lattice; empty where no option makes it denser, or it would be very large. */
std::string
FileInspection::AdviseDensity() const
{
  constexpr double mostDense = 8.0;
  const LatticeSettings & lattice = m_Settings.source.lattice;
  const bool isSpacingGiven = lattice.spacing != LatticeSettings().spacing;
  if (!m_Scan || lattice.nested || isSpacingGiven || lattice.density > mostDense)
  {
    return "";
  }
  return "; try --density " + std::to_string(std::lround(std::ceil(2.0 * lattice.density)));
}

/** Notes the distance from the scan's isosurface, and the share of points that have none near. */
void
FileInspection::NoteDeviation(const MeshedSurface & surface) const
{
  using Parts = SurfaceRequest::Parts;
  const SurfaceDeviation & deviation = *surface.deviation;
  std::string note = surface.scene.name + ": from the scan's isosurface ";
  note += deviation.IsKnown() ? FormatNumber(deviation.mean, 2) + " mm on average, 95 % within " +
                                  FormatNumber(deviation.percentile95, 2) + " mm, all within " +
                                  FormatNumber(deviation.maximum, 2) + " mm"
                              : "at an unknown distance: it has no isosurface near this surface";
  const double percent = 100.0 * static_cast<double>(deviation.unresolved) /
                         static_cast<double>(std::max<std::size_t>(1, deviation.samples));
  if (percent > NotablePercent)
  {
    const Parts parts = surface.request->parts;
    note += "; " + FormatFixed(percent, 1) + " % of the measured points have no isosurface within two voxels" +
            (parts == Parts::Outermost  ? " (an outline also runs across filled hollows)"
             : parts == Parts::Enclosed ? " (the surface also runs where air around the body was cut off)"
                                        : "");
  }
  m_Events.Note(note);
}

/** Sets and notes the audit of a surface.
 * \param stored the surface as the file holds it */
void
FileInspection::Audit(const itk::TriangleSurface & stored, MeshedSurface & surface) const
{
  const std::string & name = surface.scene.name;
  m_Events.Progress("auditing " + name, 0.0);
  surface.audit = AuditTriangleSurface(stored, this->GetAuditSettings());
  for (const std::string & line : DescribeAudit(*surface.audit))
  {
    m_Events.Note(name + ": " + line);
  }
  if (m_Settings.requiresWatertight && !surface.audit->IsWatertight())
  {
    RefuseToWrite("The surface " + name + " is not watertight (" + DescribeLeaks(*surface.audit) + ")");
  }
}

std::optional<Report>
FileInspection::AuditTogether(const std::vector<MeshedSurface> & surfaces) const
{
  std::map<std::size_t, std::vector<SceneSurface>> layers; // whose labels do not overlap
  for (const MeshedSurface & surface : surfaces)
  {
    if (surface.label)
    {
      layers[surface.label->layer].push_back(surface.scene);
    }
  }
  m_Events.Progress("auditing walls", 0.0);
  WallAudit audit;
  for (const auto & [layer, scene] : layers)
  {
    audit.Add(AuditWalls(scene, this->GetAuditSettings()));
  }
  if (audit.sharedTriangles == 0)
  {
    return std::nullopt;
  }
  m_Events.Note((layers.size() > 1 ? "all surfaces together, in " + std::to_string(layers.size()) + " layers: "
                                   : "all surfaces together: ") +
                DescribeWalls(audit));
  if (m_Settings.requiresWatertight && !audit.IsClosed())
  {
    RefuseToWrite("The walls that surfaces share have flaws (" + DescribeWalls(audit) + ")");
  }
  return ReportWalls(audit);
}

itk::TriangleSurfaceAuditSettings
FileInspection::GetAuditSettings() const
{
  itk::TriangleSurfaceAuditSettings settings;
  settings.testsIntersections = m_Settings.audits;
  return settings;
}

} // namespace rhombic
