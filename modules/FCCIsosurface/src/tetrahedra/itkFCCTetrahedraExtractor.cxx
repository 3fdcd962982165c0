#include "itkFCCTetrahedraExtractor.h"

#include "itkFCCColumnMarching.h"

#include <utility>

namespace itk
{

SizeValueType
FCCTetrahedraExtractor::CountTriangles(SizeValueType k) const
{
  return k + 1 < m_Signs.GetDepth() ? CountColumnTriangles(m_Signs, k) : 0;
}

void
FCCTetrahedraExtractor::Fill(SizeValueType begin, SizeValueType end, TriangleSurface & surface)
{
  const bool reversed = m_Field.frame.IsLeftHanded();
  FCCEdgePointFiller filler = this->MakeFiller();
  FCCCutEdges lower = this->MakeCutEdges(FCCStoredEdges::Group::InPlane);
  FCCCutEdges upper = this->MakeCutEdges(FCCStoredEdges::Group::InPlane);
  FCCCutEdges between = this->MakeCutEdges(FCCStoredEdges::Group::Between);
  this->Find(begin, lower);
  for (SizeValueType k = begin; k < end; ++k)
  {
    this->FindBetween(k, between);
    this->Find(k + 1, upper);
    filler.Fill(k, lower, between, surface);
    if (k + 1 < m_Signs.GetDepth())
    {
      FillColumnTriangles(m_Signs, k, lower, upper, between, reversed, this->GetTriangles(k, surface));
    }
    std::swap(lower, upper);
  }
}

} // namespace itk
