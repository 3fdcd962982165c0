#include "itkTriangleSurfaceTopology.h"

#include "itkTriangleSurfaceComponents.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>

namespace itk
{
namespace
{

using PointId = std::uint32_t;

/** One side of a triangle: from -> to is the direction in which the triangle runs along it. */
struct HalfEdge
{
  PointId from;
  PointId to;

  PointId
  Low() const
  {
    return std::min(from, to);
  }
  PointId
  High() const
  {
    return std::max(from, to);
  }
};

std::vector<HalfEdge>
SortedHalfEdges(const TriangleSurface::TrianglesContainer & triangles)
{
  std::vector<HalfEdge> edges;
  edges.reserve(3 * triangles.size());
  for (const auto & triangle : triangles)
  {
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      edges.push_back({ triangle[corner], triangle[(corner + 1) % 3] });
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge & a, const HalfEdge & b) {
    return a.Low() != b.Low() ? a.Low() < b.Low() : a.High() < b.High();
  });
  return edges;
}

/** Counts edges by their number of triangles and their direction; returns the number of distinct edges. */
SizeValueType
CountEdges(const std::vector<HalfEdge> & edges, TriangleSurfaceTopology & topology)
{
  SizeValueType distinct = 0;
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end)
  {
    const HalfEdge & first = edges[begin];
    for (end = begin + 1; end < edges.size() && edges[end].Low() == first.Low() && edges[end].High() == first.High();)
    {
      ++end;
    }
    ++distinct;
    switch (end - begin)
    {
      case 1:
        ++topology.boundaryEdges;
        break;
      case 2:
        topology.misorientedEdges += edges[begin + 1].from == first.from ? 1 : 0;
        break;
      default:
        ++topology.nonManifoldEdges;
    }
  }
  return distinct;
}

/** The links of one point are the triangle sides opposite to it. The point is manifold when they form a single path
 * (on a boundary) or a single cycle. */
bool
IsOneFan(std::vector<HalfEdge> & links)
{
  std::sort(links.begin(), links.end(), [](const HalfEdge & a, const HalfEdge & b) { return a.from < b.from; });
  const auto leaving = [&links](PointId point) {
    return std::lower_bound(
      links.begin(), links.end(), point, [](const HalfEdge & link, PointId value) { return link.from < value; });
  };
  std::vector<PointId> arrivals;
  arrivals.reserve(links.size());
  for (std::size_t i = 0; i < links.size(); ++i)
  {
    if (i > 0 && links[i].from == links[i - 1].from)
    {
      return false;
    }
    arrivals.push_back(links[i].to);
  }
  std::sort(arrivals.begin(), arrivals.end());

  PointId start = links.front().from;
  for (const HalfEdge & link : links)
  {
    if (!std::binary_search(arrivals.begin(), arrivals.end(), link.from))
    {
      start = link.from; // the beginning of a path on the boundary
      break;
    }
  }
  std::size_t visited = 0;
  PointId point = start;
  for (auto link = leaving(point); link != links.end() && link->from == point && visited < links.size();
       link = leaving(point))
  {
    ++visited;
    point = link->to;
    if (point == start)
    {
      break;
    }
  }
  return visited == links.size();
}

void
CountFans(const TriangleSurface & surface, TriangleSurfaceTopology & topology)
{
  const auto & triangles = surface.GetTriangles();
  std::vector<std::uint64_t> begin(surface.GetNumberOfPoints() + 1, 0);
  for (const auto & triangle : triangles)
  {
    for (const PointId point : triangle)
    {
      ++begin[point + 1];
    }
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<HalfEdge> links(3 * triangles.size());
  auto next = begin;
  for (const auto & triangle : triangles)
  {
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      links[next[triangle[corner]]++] = { triangle[(corner + 1) % 3], triangle[(corner + 2) % 3] };
    }
  }
  std::vector<HalfEdge> fan;
  for (std::size_t point = 0; point + 1 < begin.size(); ++point)
  {
    if (begin[point] == begin[point + 1])
    {
      ++topology.unusedPoints;
      continue;
    }
    fan.assign(links.begin() + static_cast<std::ptrdiff_t>(begin[point]),
               links.begin() + static_cast<std::ptrdiff_t>(begin[point + 1]));
    topology.nonManifoldPoints += IsOneFan(fan) ? 0 : 1;
  }
}

bool
IsDegenerate(const TriangleSurface & surface, const TriangleSurface::TriangleType & triangle)
{
  const auto & a = surface.GetPoints()[triangle[0]];
  const auto & b = surface.GetPoints()[triangle[1]];
  const auto & c = surface.GetPoints()[triangle[2]];
  const double u[3] = { double(b[0]) - a[0], double(b[1]) - a[1], double(b[2]) - a[2] };
  const double v[3] = { double(c[0]) - a[0], double(c[1]) - a[1], double(c[2]) - a[2] };
  const double normal[3] = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
  const bool hasArea = normal[0] != 0.0 || normal[1] != 0.0 || normal[2] != 0.0;
  const bool isFinite = std::isfinite(normal[0]) && std::isfinite(normal[1]) && std::isfinite(normal[2]);
  return !(hasArea && isFinite); // a repeated point or position has no area either
}

} // namespace

TriangleSurfaceTopology
ComputeTopology(const TriangleSurface & surface)
{
  TriangleSurfaceTopology topology;
  const auto & triangles = surface.GetTriangles();
  topology.degenerateTriangles = static_cast<SizeValueType>(std::count_if(
    triangles.begin(), triangles.end(), [&surface](const auto & triangle) { return IsDegenerate(surface, triangle); }));
  const SizeValueType edges = CountEdges(SortedHalfEdges(triangles), topology);
  CountFans(surface, topology);
  topology.components = FindComponents(surface).count;
  topology.eulerCharacteristic =
    static_cast<OffsetValueType>(surface.GetNumberOfPoints() - topology.unusedPoints + triangles.size()) -
    static_cast<OffsetValueType>(edges);
  return topology;
}

std::ostream &
operator<<(std::ostream & os, const TriangleSurfaceTopology & topology)
{
  return os << topology.components << " components, Euler characteristic " << topology.eulerCharacteristic << ", "
            << topology.boundaryEdges << " boundary edges, " << topology.nonManifoldEdges << " non-manifold edges, "
            << topology.misorientedEdges << " misoriented edges, " << topology.nonManifoldPoints
            << " non-manifold points, " << topology.unusedPoints << " unused points, " << topology.degenerateTriangles
            << " degenerate triangles";
}

} // namespace itk
