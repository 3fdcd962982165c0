#include "itkFCCEdgeExtractor.h"

#include <utility>

namespace itk
{

FCCEdgeExtractor::FCCEdgeExtractor(const FCCSigns & signs, const FCCScalarField & field, std::uint8_t types, bool cubic)
  : m_Signs(signs)
  , m_Field(field)
  , m_Types(types)
  , m_EdgePoints(field.region, field.frame, cubic, field.minimumFraction, field.closed ? 1 : 0)
  , m_InPlane(signs.GetDepth() + 1)
  , m_Between(signs.GetDepth() + 1)
  , m_Triangles(signs.GetDepth() + 1)
{}

void
FCCEdgeExtractor::Count(SizeValueType begin, SizeValueType end)
{
  for (SizeValueType k = begin; k < end; ++k)
  {
    m_InPlane[k] = FCCCutEdges::Count(m_Signs, FCCStoredEdges::Group::InPlane, k, m_Types);
    m_Between[k] = FCCCutEdges::Count(m_Signs, FCCStoredEdges::Group::Between, k, m_Types);
    m_Triangles[k] = this->CountTriangles(k);
  }
}

void
FCCEdgeExtractor::Resolve(const Crew &)
{
  SizeValueType points = 0;
  SizeValueType triangles = 0;
  for (SizeValueType k = 0; k <= m_Signs.GetDepth(); ++k)
  {
    points += std::exchange(m_InPlane[k], points);
    points += std::exchange(m_Between[k], points);
    triangles += std::exchange(m_Triangles[k], triangles);
  }
}

} // namespace itk
