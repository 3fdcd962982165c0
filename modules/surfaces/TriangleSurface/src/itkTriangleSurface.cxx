#include "itkTriangleSurface.h"

#include "itkPointBox.h"

#include <algorithm>

namespace itk
{

SizeValueType
TriangleSurface::GetMemorySize() const
{
  return this->GetPoints().size() * sizeof(PointType) + this->GetNormals().size() * sizeof(NormalType) +
         this->GetTriangles().size() * sizeof(TriangleType);
}

std::array<double, 6>
TriangleSurface::GetBounds() const
{
  const PointsContainer & points = this->GetPoints();
  if (points.empty())
  {
    return {};
  }
  PointBox box{ points.front(), points.front() };
  for (const PointType & point : points)
  {
    box.Add(point);
  }
  const auto & [lowest, highest] = box;
  return { lowest[0], highest[0], lowest[1], highest[1], lowest[2], highest[2] };
}

void
TriangleSurface::VerifyTriangles() const
{
  const TrianglesContainer & triangles = this->GetTriangles();
  for (std::size_t id = 0; id < triangles.size(); ++id)
  {
    const std::uint32_t highest = *std::max_element(triangles[id].begin(), triangles[id].end());
    if (highest >= this->GetNumberOfPoints())
    {
      itkGenericExceptionMacro("Triangle " << id << " has point " << highest << ", but the surface has only "
                                           << this->GetNumberOfPoints()
                                           << " points; write the surface again from its source");
    }
  }
}

void
TriangleSurface::RemoveUnusedPoints()
{
  constexpr std::uint32_t unused = 0;
  constexpr std::uint32_t used = 1;
  PointsContainer & points = this->GetPoints();
  NormalsContainer & normals = this->GetNormals();
  TrianglesContainer & triangles = this->GetTriangles();
  BulkVector<std::uint32_t> newId(points.size(), unused);
  for (const TriangleType & triangle : triangles)
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
      points[kept] = points[point];
      if (hasNormals)
      {
        normals[kept] = normals[point];
      }
      newId[point] = kept++;
    }
  }
  points.resize(kept);
  if (hasNormals)
  {
    normals.resize(kept);
  }
  for (TriangleType & triangle : triangles)
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
  m_Points = {};
  m_Normals = {};
  m_Triangles = {};
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
  os << indent << "NumberOfPoints: " << this->GetNumberOfPoints() << std::endl;
  os << indent << "NumberOfNormals: " << this->GetNormals().size() << std::endl;
  os << indent << "NumberOfTriangles: " << this->GetNumberOfTriangles() << std::endl;
}

} // namespace itk
