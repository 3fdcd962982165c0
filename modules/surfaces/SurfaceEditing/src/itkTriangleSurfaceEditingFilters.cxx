#include "itkTriangleSurfaceToTriangleSurfaceFilter.h"

#include "itkTriangleSurfaceFinishFilter.h"
#include "itkTriangleSurfaceSimplificationFilter.h"
#include "itkTriangleSurfaceSmoothingFilter.h"
#include "itkWorkProgress.h"

#include <cmath>

namespace itk
{

void
TriangleSurfaceToTriangleSurfaceFilter::GenerateData()
{
  if (this->GetInput()->GetDataReleased())
  {
    itkExceptionMacro("The input's data were released: turn its ReleaseDataFlag off, or fill it anew before each "
                      "update.");
  }
  this->GetInput()->VerifyTriangles();
  constexpr SizeValueType wholeWork = SizeValueType{ 1 } << 30;
  WorkProgress progress(*this, wholeWork);
  const auto report = [&progress](double share) {
    const auto done = static_cast<SizeValueType>(share * static_cast<double>(wholeWork));
    progress.Completed(std::max(done, progress.GetCompleted()) - progress.GetCompleted());
  };
  TriangleSurface & output = *this->GetOutput();
  output.Graft(this->GetInput());
  try
  {
    this->Edit(output, report);
  }
  catch (...)
  {
    output.Initialize();
    throw;
  }
  progress.Finish();
}

void
TriangleSurfaceSimplificationFilter::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "TargetTriangles: " << m_TargetTriangles << std::endl;
  os << indent << "MaximumError: " << m_MaximumError << std::endl;
  os << indent << "TrianglesBefore: " << m_Report.trianglesBefore << std::endl;
  os << indent << "TrianglesAfter: " << m_Report.trianglesAfter << std::endl;
  os << indent << "End: " << m_Report.end << std::endl;
  os << indent << "PlacesTakenBack: " << m_Report.placesTakenBack << std::endl;
}

void
TriangleSurfaceSimplificationFilter::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  TriangleSurfaceSimplificationSettings{ m_TargetTriangles, m_MaximumError }.Verify();
}

void
TriangleSurfaceSimplificationFilter::Edit(TriangleSurface & surface, const rhombic::ProgressFunction & report)
{
  m_Report = SimplifyTriangleSurface(surface, { m_TargetTriangles, m_MaximumError }, report);
}

void
TriangleSurfaceSmoothingFilter::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Iterations: " << m_Iterations << std::endl;
  os << indent << "MaximumMove: " << m_MaximumMove << std::endl;
  os << indent << "MeanMove: " << m_Report.meanMove << std::endl;
  os << indent << "LargestMove: " << m_Report.largestMove << std::endl;
  os << indent << "PointsAtLimit: " << m_Report.pointsAtLimit << std::endl;
  os << indent << "PointsOnBorder: " << m_Report.pointsOnBorder << std::endl;
}

void
TriangleSurfaceSmoothingFilter::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  TriangleSurfaceSmoothingSettings{ m_Iterations, m_MaximumMove }.Verify();
}

void
TriangleSurfaceSmoothingFilter::Edit(TriangleSurface & surface, const rhombic::ProgressFunction & report)
{
  m_Report = SmoothTriangleSurface(surface, { m_Iterations, m_MaximumMove }, report);
}

void
TriangleSurfaceFinishFilter::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Spacing: " << m_Spacing << std::endl;
  os << indent << "MinimumVolume: " << m_MinimumVolume << std::endl;
  os << indent << "KeepLargestPart: " << (m_KeepLargestPart ? "On" : "Off") << std::endl;
  os << indent << "FillCavities: " << (m_FillCavities ? "On" : "Off") << std::endl;
  os << indent << "Smoothing: " << m_Smoothing << std::endl;
  os << indent << "MaximumError: " << m_MaximumError << std::endl;
  os << indent << "MaximumTriangles: " << m_MaximumTriangles << std::endl;
  os << indent << "Notes: " << m_Notes.size() << std::endl;
  for (const std::string & note : m_Notes)
  {
    os << indent.GetNextIndent() << note << std::endl;
  }
}

rhombic::SurfaceFinish
TriangleSurfaceFinishFilter::MakeFinish() const
{
  rhombic::SurfaceFinish finish;
  finish.minimumVolume = m_MinimumVolume;
  finish.keepsLargestPart = m_KeepLargestPart;
  finish.fillsCavities = m_FillCavities;
  finish.smoothing = m_Smoothing;
  finish.maximumError = m_MaximumError == 0.0 ? std::nullopt : std::optional<double>(m_MaximumError);
  finish.maximumTriangles = m_MaximumTriangles;
  return finish;
}

void
TriangleSurfaceFinishFilter::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  if (!(m_Spacing > 0.0 && std::isfinite(m_Spacing)))
  {
    itkExceptionMacro("Spacing must be a number of mm above 0, not " << m_Spacing << "; give that of the lattice.");
  }
  rhombic::CheckSurfaceFinish(this->MakeFinish());
}

void
TriangleSurfaceFinishFilter::Edit(TriangleSurface & surface, const rhombic::ProgressFunction & report)
{
  const rhombic::SurfaceFinish finish = this->MakeFinish();
  const int steps = 1 + (finish.smoothing.IsNothing() ? 0 : 1) + (finish.Simplifies() ? 1 : 0);
  int begun = 0;
  std::string current;
  m_Notes.clear();
  rhombic::Events events;
  events.note = [this](const std::string & line) { m_Notes.push_back(line); };
  events.progress = [&](const std::string & step, double share) {
    begun += step != current ? 1 : 0;
    current = step;
    report((begun - 1 + share) / steps);
  };
  const std::string name = "surface";
  m_Refinement = {};
  m_Removal = rhombic::RemoveParts(surface, finish, name, events);
  if (surface.GetNumberOfTriangles() > 0)
  {
    m_Refinement = rhombic::RefineSurface(surface, finish, m_Spacing, name, events);
  }
  surface.Modified();
}

} // namespace itk
