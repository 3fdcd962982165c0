#ifndef itkPatchTopology_h
#define itkPatchTopology_h

#include "itkTriangleSurface.h"

#include <functional>

namespace itk
{

/** \class PatchTopology
 * \brief The connectivity of some triangles of a surface: where it is no manifold, its border, its components.
 *
 * \ingroup TriangleSurface
 */
class PatchTopology
{
public:
  using PointId = std::uint32_t;
  using TriangleType = TriangleSurface::TriangleType;

  /** A side of a triangle, in the direction in which the triangle runs along it. */
  using DirectedEdge = std::array<PointId, 2>;

  /** Points and edges are judged where isChecked(point) holds for one of their points at least; without it, all are. */
  PatchTopology(const std::vector<TriangleType> & triangles,
                std::size_t numberOfPoints,
                const std::function<bool(PointId)> & isChecked = nullptr);

  /** Triangles, by their place in the vector, at edges of three or more triangles or of two that run along it in the
   * same direction or lie upon each other, and at points with more fans of triangles than the border makes there.
   * Sorted. */
  const std::vector<std::uint32_t> &
  GetBadTriangles() const
  {
    return m_BadTriangles;
  }

  /** Edges of one triangle, sorted. */
  const std::vector<DirectedEdge> &
  GetBorder() const
  {
    return m_Border;
  }

  /** For each point the smallest point of its component; itself when it is of no triangle. */
  const std::vector<PointId> &
  GetComponents() const
  {
    return m_Components;
  }

  /** For each point used points - edges + triangles of its component, 0 unless the point is the component's smallest.
   */
  const std::vector<int> &
  GetEulerCharacteristics() const
  {
    return m_EulerCharacteristics;
  }

private:
  /** A side of a triangle: from corner to the next corner; corners are numbered 3 * triangle + 0, 1 or 2. */
  struct Side
  {
    PointId low;
    PointId high;
    std::uint32_t corner;
  };

  void
  FindComponents();
  void
  FindSides(const std::function<bool(PointId)> & isChecked);
  void
  CheckEdges();
  void
  CheckFans(const std::function<bool(PointId)> & isChecked);

  static std::uint32_t
  Next(std::uint32_t corner)
  {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
  }
  PointId
  PointAt(std::uint32_t corner) const
  {
    return m_Triangles[corner / 3][corner % 3];
  }
  bool
  AreNeighbours(std::uint32_t corner, std::uint32_t other) const;

  const std::vector<TriangleType> & m_Triangles;
  std::vector<Side> m_Sides;
  std::vector<std::uint32_t> m_BadTriangles;
  std::vector<DirectedEdge> m_Border;
  std::vector<PointId> m_Components;
  std::vector<int> m_EulerCharacteristics;
};

} // namespace itk

#endif
