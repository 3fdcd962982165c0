#include "itkFCCCellExtractor.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace itk
{

SizeValueType
FCCCellExtractor::CountTriangles(SizeValueType k) const
{
  return CountCellTriangles(m_Signs, m_Scheme, k, m_Field.closed);
}

void
FCCCellExtractor::Fill(SizeValueType begin, SizeValueType end, TriangleSurface & surface)
{
  using Group = FCCStoredEdges::Group;
  const bool reversed = m_Field.frame.IsLeftHanded();
  // Of the planes before, at and after a layer; no edges are cut before the first plane.
  FCCCutEdges inPlane[3] = { this->MakeCutEdges(Group::InPlane),
                             this->MakeCutEdges(Group::InPlane),
                             this->MakeCutEdges(Group::InPlane) };
  FCCCutEdges between[2] = { this->MakeCutEdges(Group::Between), this->MakeCutEdges(Group::Between) };
  if (begin > 0)
  {
    this->Find(begin - 1, inPlane[0]);
    this->FindBetween(begin - 1, between[0]);
  }
  this->Find(begin, inPlane[1]);
  FCCEdgePointFiller filler = this->MakeFiller();
  for (SizeValueType k = begin; k < end; ++k)
  {
    this->FindBetween(k, between[1]);
    this->Find(k + 1, inPlane[2]);
    filler.Fill(k, inPlane[1], between[1], surface);
    FillCellTriangles(m_Signs,
                      m_Scheme,
                      k,
                      { { &inPlane[0], &inPlane[1], &inPlane[2] }, { &between[0], &between[1] } },
                      m_Field.closed,
                      reversed,
                      this->GetTriangles(k, surface));
    std::rotate(std::begin(inPlane), std::begin(inPlane) + 1, std::end(inPlane));
    std::swap(between[0], between[1]);
  }
}

} // namespace itk
