#include "itkPointStrata.h"

#include "itkForEachBlock.h"

namespace itk
{
namespace
{

using PointId = std::uint32_t;

/** The stratum of a point; of a point of a curve, with its neighbours there. */
Stratum
FindStratum(const TrianglesOfPoints & fans, SizeValueType point, std::array<PointId, 2> & onCurve)
{
  std::vector<PointId> following;
  std::vector<PointId> preceding;
  fans.VisitNeighbours(point, [&](PointId next, PointId last) {
    following.push_back(next);
    preceding.push_back(last);
  });
  std::sort(following.begin(), following.end());
  std::sort(preceding.begin(), preceding.end());
  if (!following.empty() && following == preceding &&
      std::adjacent_find(following.begin(), following.end()) == following.end())
  {
    return Stratum::Sheet;
  }
  std::vector<PointId> neighbours(2 * following.size());
  std::merge(following.begin(), following.end(), preceding.begin(), preceding.end(), neighbours.begin());
  std::size_t curves = 0;
  for (auto begin = neighbours.begin(); begin != neighbours.end();)
  {
    const auto end = std::upper_bound(begin, neighbours.end(), *begin);
    const bool isSheet = end - begin == 2 && std::binary_search(following.begin(), following.end(), *begin) &&
                         std::binary_search(preceding.begin(), preceding.end(), *begin);
    if (!isSheet && (end - begin < 3 || curves == onCurve.size()))
    {
      return Stratum::Fixed;
    }
    if (!isSheet)
    {
      onCurve[curves++] = *begin;
    }
    begin = end;
  }
  return curves == onCurve.size() ? Stratum::Curve : Stratum::Fixed;
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
