#include "itkFCCTetrahedraSurface.h"

#include <utility>

namespace itk
{

SizeValueType
FCCTetrahedraSurface::CountTriangles(SizeValueType k) const
{
  return k + 1 < m_Signs.GetDepth() ? itk::CountTriangles(m_Signs, k) : 0;
}

void
FCCTetrahedraSurface::Fill(SizeValueType begin, SizeValueType end, TriangleSurface & surface)
{
  const bool reversed = m_Field.frame.IsLeftHanded();
  FCCEdgePointFiller filler = this->MakeFiller();
  FCCCutEdges lower = this->MakeCutEdges(FCCCutEdges::Group::InPlane);
  FCCCutEdges upper = this->MakeCutEdges(FCCCutEdges::Group::InPlane);
  FCCCutEdges between = this->MakeCutEdges(FCCCutEdges::Group::Between);
  this->Find(begin, lower);
  for (SizeValueType k = begin; k < end; ++k)
  {
    this->FindBetween(k, between);
    this->Find(k + 1, upper);
    filler.Fill(k, lower, between, surface);
    if (k + 1 < m_Signs.GetDepth())
    {
      FillTriangles(m_Signs, k, lower, upper, between, reversed, this->GetTriangles(k, surface));
    }
    std::swap(lower, upper);
  }
}

} // namespace itk
