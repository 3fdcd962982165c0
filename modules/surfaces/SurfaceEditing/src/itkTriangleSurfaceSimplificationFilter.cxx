#include "itkTriangleSurfaceSimplificationFilter.h"

namespace itk
{

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

} // namespace itk
