#include "itkTriangleSurfaceComponents.h"

#include <algorithm>
#include <numeric>

namespace itk
{
namespace
{

/** Sets of the items from 0 to size - 1; each item begins in a set of its own. */
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t size)
    : m_Parent(size)
  {
    std::iota(m_Parent.begin(), m_Parent.end(), 0u);
  }

  /** The smallest item of the set. */
  std::uint32_t
  Find(std::uint32_t item)
  {
    while (m_Parent[item] != item)
    {
      m_Parent[item] = m_Parent[m_Parent[item]];
      item = m_Parent[item];
    }
    return item;
  }

  void
  Join(std::uint32_t a, std::uint32_t b)
  {
    const std::uint32_t firstOfA = Find(a);
    const std::uint32_t firstOfB = Find(b);
    m_Parent[std::max(firstOfA, firstOfB)] = std::min(firstOfA, firstOfB);
  }

private:
  std::vector<std::uint32_t> m_Parent;
};

} // namespace

TriangleSurfaceComponents
FindTriangleSurfaceComponents(const TriangleSurface & surface)
{
  DisjointSets sets(surface.GetNumberOfPoints());
  TriangleSurfaceComponents components;
  components.ofPoint.assign(surface.GetNumberOfPoints(), TriangleSurfaceComponents::None);
  for (const auto & triangle : surface.GetTriangles())
  {
    sets.Join(triangle[0], triangle[1]);
    sets.Join(triangle[1], triangle[2]);
    for (const std::uint32_t point : triangle)
    {
      components.ofPoint[point] = 0; // used; the number follows
    }
  }
  for (std::uint32_t point = 0; point < components.ofPoint.size(); ++point)
  {
    if (components.ofPoint[point] != TriangleSurfaceComponents::None)
    {
      const std::uint32_t first = sets.Find(point);
      components.ofPoint[point] = first == point ? components.count++ : components.ofPoint[first];
    }
  }
  return components;
}

std::vector<std::uint32_t>
FindTriangleSurfaceFirstPoints(const TriangleSurfaceComponents & components)
{
  std::vector<std::uint32_t> first;
  first.reserve(components.count);
  for (std::uint32_t point = 0; point < components.ofPoint.size(); ++point)
  {
    if (components.ofPoint[point] == first.size())
    {
      first.push_back(point);
    }
  }
  return first;
}

void
KeepTriangleSurfaceComponents(TriangleSurface & surface,
                              const TriangleSurfaceComponents & components,
                              const std::vector<bool> & keep)
{
  auto & triangles = surface.GetTriangles();
  triangles.erase(std::remove_if(triangles.begin(),
                                 triangles.end(),
                                 [&](const auto & triangle) { return !keep[components.ofPoint[triangle[0]]]; }),
                  triangles.end());
  surface.RemoveUnusedPoints();
}

} // namespace itk
