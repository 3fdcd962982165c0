#include "itkSimplifiedPatch.h"

#include <algorithm>

namespace itk
{

SimplifiedPatch::SimplifiedPatch(const TriangleSurface & surface, std::size_t begin, std::size_t end)
  : m_Surface(&surface)
  , m_Before{ { surface.GetTriangles().data() + begin, surface.GetTriangles().data() + end }, {} }
  , m_Bounds(BoxOf(surface.GetPoints(), surface.GetTriangles()[begin]))
  , m_IsHeld(end - begin, 0)
{
  for (const auto & triangle : m_Before.triangles)
  {
    const Box box = BoxOf(surface.GetPoints(), triangle);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Bounds.lowest[axis] = std::min(m_Bounds.lowest[axis], box.lowest[axis]);
      m_Bounds.highest[axis] = std::max(m_Bounds.highest[axis], box.highest[axis]);
    }
  }
}

void
SimplifiedPatch::AddWitness(const EdgeCollapse::Witness & witness)
{
  m_Before.witnesses.push_back(witness);
}

void
SimplifiedPatch::Simplify(const Goal & goal, const EdgeCollapse::Original & original)
{
  EdgeCollapse collapse(*m_Surface, m_Before, m_IsHeld, original);
  m_Progress = collapse.Run(goal);
  m_Result = collapse.GetResult();
  m_NumberOfOldTriangles = collapse.CountOldTriangles();
  m_Moved = collapse.GetMovedPoints();
  m_WasHeldBack = collapse.WasHeldBack();
}

bool
SimplifiedPatch::Hold(const std::vector<Box> & places)
{
  bool isAnyNew = false;
  for (std::size_t id = 0; id < m_IsHeld.size(); ++id)
  {
    const Box own = BoxOf(m_Surface->GetPoints(), m_Before.triangles[id]);
    if (!m_IsHeld[id] &&
        std::any_of(places.begin(), places.end(), [&own](const Box & place) { return place.Overlaps(own); }))
    {
      m_IsHeld[id] = 1;
      isAnyNew = true;
    }
  }
  return isAnyNew;
}

void
SimplifiedPatch::HoldAll()
{
  std::fill(m_IsHeld.begin(), m_IsHeld.end(), std::uint8_t{ 1 });
}

TriangleTree::Box
BoxOf(const TriangleSurface::PointsContainer & points, const TriangleSurface::TriangleType & triangle)
{
  TriangleTree::Box box{ points[triangle[0]], points[triangle[0]] };
  for (const std::uint32_t point : triangle)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      box.lowest[axis] = std::min(box.lowest[axis], points[point][axis]);
      box.highest[axis] = std::max(box.highest[axis], points[point][axis]);
    }
  }
  return box;
}

} // namespace itk
