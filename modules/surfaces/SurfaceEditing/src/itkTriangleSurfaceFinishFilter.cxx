#include "itkTriangleSurfaceFinishFilter.h"

#include <cmath>

namespace itk
{

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
  const int steps = 1 + (finish.smoothing > 0.0 ? 1 : 0) + (finish.Simplifies() ? 1 : 0);
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
