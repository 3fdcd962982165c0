#include "itkPointStrata.h"

#include "itkForEachBlock.h"

namespace itk
{
namespace
{

using PointId = std::uint32_t;

/** The sides opposite to a point in its triangles, {next, last}, ascending. */
using Link = std::vector<std::array<PointId, 2>>;

/** The number of sides on the paths from one neighbour to another, or back to itself; 0 if a path ends elsewhere. Each
 * neighbour in between is the first of one side and the last of another. */
std::size_t
CountSides(const Link & link, PointId from, PointId to)
{
  const auto find = [&link](PointId next) {
    return std::lower_bound(link.begin(), link.end(), Link::value_type{ next, 0 });
  };
  std::size_t sides = 0;
  for (auto first = find(from); first != link.end() && first->front() == from; ++first)
  {
    PointId last = first->back();
    for (++sides; last != to; ++sides)
    {
      if (last == from)
      {
        return 0;
      }
      last = find(last)->back();
    }
  }
  return sides;
}

/** The stratum of a point; of a point of a curve, with its neighbours there. */
Stratum
FindStratum(const TrianglesOfPoints & fans, SizeValueType point, std::array<PointId, 2> & onCurve)
{
  Link link;
  fans.VisitNeighbours(point, [&link](PointId next, PointId last) { link.push_back({ next, last }); });
  std::sort(link.begin(), link.end());
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
    const bool isSheet = end - begin == 2 && begin->back() == 0 && std::prev(end)->back() == 1;
    if (!isSheet && (end - begin < 3 || curves == onCurve.size()))
    {
      return Stratum::Fixed;
    }
    if (!isSheet)
    {
      onCurve[curves++] = begin->front();
    }
    begin = end;
  }
  if (curves == 0)
  {
    const bool isSheet = !link.empty() && CountSides(link, link[0][0], link[0][0]) == link.size();
    return isSheet ? Stratum::Sheet : Stratum::Fixed;
  }
  const auto & [a, b] = onCurve;
  const bool isCurve = curves == 2 && CountSides(link, a, b) + CountSides(link, b, a) == link.size();
  return isCurve ? Stratum::Curve : Stratum::Fixed;
}

} // namespace

PointStrata
FindStrata(const TriangleSurface & surface, const TrianglesOfPoints & fans)
{
  constexpr SizeValueType BlockSize = 4096;
  PointStrata found;
  found.strata.resize(surface.GetNumberOfPoints());
  std::array<PointId, 2> onCurve{};
  ForEachInBlocks(found.strata.size(), BlockSize, [&](SizeValueType point) {
    std::array<PointId, 2> neighbours{};
    found.strata[point] = FindStratum(fans, point, neighbours);
  });
  for (PointId point = 0; point < found.strata.size(); ++point)
  {
    if (found.strata[point] == Stratum::Curve)
    {
      FindStratum(fans, point, onCurve);
      found.curves.push_back({ point, onCurve });
    }
  }
  return found;
}

} // namespace itk
