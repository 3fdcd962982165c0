#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkUnfoldedPoints.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "detail/itkTrianglesOfPoints.h"
#include "itkUnfoldedPoints.h"

#include <cmath>

#ifndef itkUnfoldedPoints_FanRows
#define itkUnfoldedPoints_FanRows
namespace itk
{

/** The triangles at a point, in any order: their other corners, counter-clockwise first next, then last. */
struct FanRows
{
  static constexpr std::size_t Most = 24; ///< points with more triangles count as folded
  static constexpr std::size_t Lanes = 8;

  alignas(32) std::array<std::array<float, Most>, 3> next; ///< relative to the point
  alignas(32) std::array<std::array<float, Most>, 3> last;
  alignas(32) std::array<std::uint32_t, Most> nextIds;
  alignas(32) std::array<std::uint32_t, Most> lastIds;
  std::size_t size = 0; ///< behind these, coordinates are 0 up to whole vectors
};

} // namespace itk
#endif

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

/** Whether each next corner of one triangle is the last one of just one other. */
HWY_ATTR bool
IsClosed(const FanRows & fan)
{
  const hn::CappedTag<std::uint32_t, FanRows::Lanes> ids;
  std::uint32_t matched = 0;
  for (std::size_t n = 0; n < fan.size; ++n)
  {
    const auto next = hn::Set(ids, fan.nextIds[n]);
    std::uint32_t equal = 0;
    for (std::size_t begin = 0; begin < fan.size; begin += hn::Lanes(ids))
    {
      std::uint8_t bits[8]{};
      hn::StoreMaskBits(
        ids, hn::And(next == hn::Load(ids, fan.lastIds.data() + begin), hn::FirstN(ids, fan.size - begin)), bits);
      equal |= std::uint32_t{ bits[0] } << begin;
    }
    if (equal == 0 || (equal & (equal - 1)) != 0)
    {
      return false;
    }
    matched |= equal;
  }
  return matched == (std::uint32_t{ 1 } << fan.size) - 1;
}

HWY_ATTR bool
IsUnfolded(const FanRows & fan)
{
  const hn::CappedTag<float, FanRows::Lanes> d;
  const auto zero = hn::Zero(d);
  auto sumX = zero, sumY = zero, sumZ = zero;
  for (std::size_t begin = 0; begin < fan.size; begin += hn::Lanes(d))
  {
    const auto next = [&](int axis) HWY_ATTR { return hn::Load(d, fan.next[axis].data() + begin); };
    const auto last = [&](int axis) HWY_ATTR { return hn::Load(d, fan.last[axis].data() + begin); };
    sumX = sumX + (next(1) * last(2) - next(2) * last(1));
    sumY = sumY + (next(2) * last(0) - next(0) * last(2));
    sumZ = sumZ + (next(0) * last(1) - next(1) * last(0));
  }
  const float normal[3] = { hn::GetLane(hn::SumOfLanes(d, sumX)),
                            hn::GetLane(hn::SumOfLanes(d, sumY)),
                            hn::GetLane(hn::SumOfLanes(d, sumZ)) };
  int axis = 0;
  for (int other = 1; other < 3; ++other)
  {
    axis = std::abs(normal[other]) > std::abs(normal[axis]) ? other : axis;
  }
  // Moved along the normal into the plane across the axis, a spoke keeps its length within a factor of 2.
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto perU = hn::Set(d, normal[u] / normal[axis]), perV = hn::Set(d, normal[v] / normal[axis]);
  const auto sense = hn::Set(d, normal[axis] > 0.0f ? 1.0f : -1.0f);
  const auto rounding = hn::Set(d, 4e-6f); // of a product of two coordinates, over the spokes' lengths; generous
  const auto least = hn::Set(d, 1e-30f);   // far above what cannot be told from 0
  std::size_t turns = 0;
  for (std::size_t begin = 0; begin < fan.size; begin += hn::Lanes(d))
  {
    const auto next = [&](int along) HWY_ATTR { return hn::Load(d, fan.next[along].data() + begin); };
    const auto last = [&](int along) HWY_ATTR { return hn::Load(d, fan.last[along].data() + begin); };
    const auto nextU = next(u) - perU * next(axis), nextV = next(v) - perV * next(axis);
    const auto lastU = last(u) - perU * last(axis), lastV = last(v) - perV * last(axis);
    const auto lengths = (hn::Abs(next(0)) + hn::Abs(next(1)) + hn::Abs(next(2))) *
                         (hn::Abs(last(0)) + hn::Abs(last(1)) + hn::Abs(last(2)));
    const auto isSameSide = sense * (nextU * lastV - nextV * lastU) > hn::Max(rounding * lengths, least);
    const auto isTriangle = hn::FirstN(d, fan.size - begin);
    if (!hn::AllTrue(d, hn::Or(isSameSide, hn::Not(isTriangle))))
    {
      return false;
    }
    turns += hn::CountTrue(d, hn::And(isTriangle, hn::And(nextV < zero, lastV >= zero)));
  }
  return turns == 1 && IsClosed(fan);
}

} // namespace HWY_NAMESPACE
} // namespace itk
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace itk
{

HWY_EXPORT(IsUnfolded);

bool
IsUnfoldedPoint(const TriangleSurface & surface, const TrianglesOfPoints & fans, std::uint32_t point)
{
  const std::size_t size = fans.GetNumberOfTriangles(point);
  if (size < 3 || size > FanRows::Most)
  {
    return false;
  }
  const auto & points = surface.GetPoints();
  const auto centre = points[point];
  FanRows fan;
  fans.VisitNeighbours(point, [&](std::uint32_t next, std::uint32_t last) {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      fan.next[axis][fan.size] = points[next][axis] - centre[axis];
      fan.last[axis][fan.size] = points[last][axis] - centre[axis];
    }
    fan.nextIds[fan.size] = next;
    fan.lastIds[fan.size] = last;
    ++fan.size;
  });
  for (std::size_t n = size; n % FanRows::Lanes != 0; ++n)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      fan.next[axis][n] = fan.last[axis][n] = 0.0f;
    }
  }
  return HWY_DYNAMIC_DISPATCH(IsUnfolded)(fan);
}

} // namespace itk

#endif
