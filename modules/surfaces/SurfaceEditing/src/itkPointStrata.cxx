#include "detail/itkPointStrata.h"

#include "rhombicForEachBlock.h"

namespace itk
{
namespace
{

using PointId = std::uint32_t;

/** The sides opposite to a point in its triangles, {next, last}, ascending. */
using Link = std::vector<std::array<PointId, 2>>;

/** The first side of a link, sorted, from a neighbour on. */
Link::const_iterator
FindSide(const Link & link, PointId next)
{
  return std::lower_bound(link.begin(), link.end(), Link::value_type{ next, 0 });
}

/** Whether the sides of a link, sorted, are one closed path. */
bool
IsCycle(const Link & link)
{
  auto side = link.begin();
  for (std::size_t sides = 1; sides <= link.size(); ++sides)
  {
    const PointId last = side->back();
    side = FindSide(link, last);
    if (side == link.end() || side->front() != last)
    {
      return false;
    }
    if (side == link.begin())
    {
      return sides == link.size();
    }
  }
  return false;
}

/** The number of sides on the paths from one neighbour to another; 0 if a path ends elsewhere. Each neighbour in
 * between is the first of one side and the last of another. */
std::size_t
CountSides(const Link & link, PointId from, PointId to)
{
  std::size_t sides = 0;
  for (auto first = FindSide(link, from); first != link.end() && first->front() == from; ++first)
  {
    PointId last = first->back();
    for (++sides; last != to; ++sides)
    {
      if (last == from)
      {
        return 0;
      }
      last = FindSide(link, last)->back();
    }
  }
  return sides;
}

/** Whether a point whose link is no cycle lies on a curve; if so, with its neighbours there. */
bool
IsOnCurve(const Link & link, std::array<PointId, 2> & onCurve)
{
  std::vector<std::array<PointId, 2>> neighbours; // and 1 if it is the last of a side
  for (const auto & [next, last] : link)
  {
    neighbours.push_back({ next, 0 });
    neighbours.push_back({ last, 1 });
  }
  std::sort(neighbours.begin(), neighbours.end());
  std::size_t curves = 0;
  for (auto begin = neighbours.begin(); begin != neighbours.end();)
  {
    const auto end =
      std::find_if(begin, neighbours.end(), [begin](const auto & other) { return other.front() != begin->front(); });
    const bool isInSheet = end - begin == 2 && begin->back() == 0 && std::prev(end)->back() == 1;
    if (!isInSheet && (end - begin < 3 || curves == onCurve.size()))
    {
      return false;
    }
    if (!isInSheet)
    {
      onCurve[curves++] = begin->front();
    }
    begin = end;
  }
  const auto & [a, b] = onCurve;
  return curves == 2 && CountSides(link, a, b) + CountSides(link, b, a) == link.size();
}

} // namespace

PointStrata
FindStrata(const TriangleSurface & surface, const TrianglesOfPoints & fans)
{
  constexpr SizeValueType blockSize = 4096;
  PointStrata found;
  found.strata.resize(surface.GetNumberOfPoints());
  std::vector<std::vector<CurvePoint>> curves(found.strata.size() / blockSize + 1);
  rhombic::ForEachBlock(found.strata.size(), blockSize, [&](SizeValueType begin, SizeValueType end) {
    Link link;
    for (SizeValueType point = begin; point < end; ++point)
    {
      link.clear();
      fans.VisitNeighbours(point, [&link](PointId next, PointId last) { link.push_back({ next, last }); });
      std::sort(link.begin(), link.end());
      CurvePoint curve{ static_cast<PointId>(point), {} };
      found.strata[point] = IsCycle(link)                       ? Stratum::Sheet
                            : IsOnCurve(link, curve.neighbours) ? Stratum::Curve
                                                                : Stratum::Fixed;
      if (found.strata[point] == Stratum::Curve)
      {
        curves[begin / blockSize].push_back(curve);
      }
    }
  });
  for (const auto & ofBlock : curves)
  {
    found.curves.insert(found.curves.end(), ofBlock.begin(), ofBlock.end());
  }
  return found;
}

} // namespace itk
