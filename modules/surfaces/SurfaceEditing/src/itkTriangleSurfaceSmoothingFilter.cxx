#include "itkTriangleSurfaceSmoothingFilter.h"

namespace itk
{

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

} // namespace itk
