#include "itkTriangleSurface.h"

#include <algorithm>

namespace itk
{

SizeValueType
TriangleSurface::GetMemorySize() const
{
  return m_Points.size() * sizeof(PointType) + m_Normals.size() * sizeof(NormalType) +
         m_Triangles.size() * sizeof(TriangleType);
}

std::array<double, 6>
TriangleSurface::GetBounds() const
{
  if (m_Points.empty())
  {
    return {};
  }
  PointType lowest = m_Points.front();
  PointType highest = lowest;
  for (const PointType & point : m_Points)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      lowest[axis] = std::min(lowest[axis], point[axis]);
      highest[axis] = std::max(highest[axis], point[axis]);
    }
  }
  return { lowest[0], highest[0], lowest[1], highest[1], lowest[2], highest[2] };
}

void
TriangleSurface::VerifyTriangles() const
{
  for (std::size_t id = 0; id < m_Triangles.size(); ++id)
  {
    const std::uint32_t highest = *std::max_element(m_Triangles[id].begin(), m_Triangles[id].end());
    if (highest >= m_Points.size())
    {
      itkGenericExceptionMacro("Triangle " << id << " has point " << highest << ", but the surface has only "
                                           << m_Points.size() << " points; write the surface again from its source");
    }
  }
}

void
TriangleSurface::RemoveUnusedPoints()
{
  constexpr std::uint32_t unused = 0;
  constexpr std::uint32_t used = 1;
  std::vector<std::uint32_t> newId(m_Points.size(), unused);
  for (const TriangleType & triangle : m_Triangles)
  {
    for (const std::uint32_t point : triangle)
    {
      newId[point] = used;
    }
  }
  const bool hasNormals = this->HasNormals();
  std::uint32_t kept = 0;
  for (std::size_t point = 0; point < newId.size(); ++point)
  {
    if (newId[point] == used)
    {
      m_Points[kept] = m_Points[point];
      if (hasNormals)
      {
        m_Normals[kept] = m_Normals[point];
      }
      newId[point] = kept++;
    }
  }
  m_Points.resize(kept);
  if (hasNormals)
  {
    m_Normals.resize(kept);
  }
  for (TriangleType & triangle : m_Triangles)
  {
    for (std::uint32_t & point : triangle)
    {
      point = newId[point];
    }
  }
  this->Modified();
}

void
TriangleSurface::Initialize()
{
  Superclass::Initialize();
  PointsContainer().swap(m_Points);
  NormalsContainer().swap(m_Normals);
  TrianglesContainer().swap(m_Triangles);
}

void
TriangleSurface::Graft(const DataObject * data)
{
  if (data == nullptr)
  {
    return;
  }
  const auto * const other = dynamic_cast<const Self *>(data);
  if (other == nullptr)
  {
    itkExceptionMacro("Only another TriangleSurface can be grafted; got " << data->GetNameOfClass());
  }
  m_Points = other->m_Points;
  m_Normals = other->m_Normals;
  m_Triangles = other->m_Triangles;
  this->Modified();
}

void
TriangleSurface::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPoints: " << m_Points.size() << std::endl;
  os << indent << "NumberOfNormals: " << m_Normals.size() << std::endl;
  os << indent << "NumberOfTriangles: " << m_Triangles.size() << std::endl;
}

} // namespace itk
