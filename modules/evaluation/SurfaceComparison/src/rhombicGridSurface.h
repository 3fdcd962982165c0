#ifndef rhombicGridSurface_h
#define rhombicGridSurface_h

#include "rhombicCartesianSurfaces.h"

#include "detail/itkPositionArithmetic.h"

#include <algorithm>
#include <unordered_map>

namespace rhombic
{

/** A surface that grows while the cells of a grid are marched. */
class GridSurface
{
public:
  /** An integer point of the grid and its value. */
  struct Corner
  {
    std::array<int, 3> point;
    float value;
  };

  explicit GridSurface(const TetrahedraGrid & grid)
    : m_Grid(grid)
  {}

  /** The value of an integer point; NoSite beyond the box. */
  float
  ValueAt(const std::array<int, 3> & point) const
  {
    bool isInBox = true;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      isInBox = isInBox && point[axis] >= 0 && point[axis] < m_Grid.size[axis];
    }
    return isInBox ? m_Grid.values[m_Grid.GetOffset(point)] : TetrahedraGrid::NoSite;
  }

  /** The point on an edge of a type below 7; made when it is first asked for, at least 1e-4 of the edge from its ends.
   */
  std::uint32_t
  PointBetween(const Corner & begin, const Corner & end, unsigned int type)
  {
    const auto next = static_cast<std::uint32_t>(m_Surface->GetNumberOfPoints());
    const auto [found, isNew] = m_Points.emplace(8 * m_Grid.GetOffset(begin.point) + type, next);
    if (isNew)
    {
      constexpr double margin = 1e-4;
      const double t = std::clamp<double>(begin.value / (double{ begin.value } - end.value), margin, 1.0 - margin);
      const Vector3 point = Mix(m_Grid.GetPosition(begin.point), m_Grid.GetPosition(end.point), t);
      m_Surface->GetPoints().push_back(itk::ToPoint(point));
    }
    return found->second;
  }

  void
  AddTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c)
  {
    m_Surface->GetTriangles().push_back({ a, b, c });
  }

  itk::TriangleSurface::Pointer
  GetSurface() const
  {
    return m_Surface;
  }

private:
  const TetrahedraGrid & m_Grid;
  itk::TriangleSurface::Pointer m_Surface = itk::TriangleSurface::New();
  std::unordered_map<std::size_t, std::uint32_t> m_Points; ///< of edges
};

} // namespace rhombic

#endif
