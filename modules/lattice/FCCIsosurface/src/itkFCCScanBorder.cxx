#include "itkFCCScanBorder.h"

#include "rhombicForEachBlock.h"

#include <algorithm>
#include <array>

namespace itk
{
namespace
{

constexpr std::size_t PointsOfBlock = 16384;

/** One end of an axis of the scan, in samples. */
struct AxisEnd
{
  double sample;    ///< outermost sample
  double direction; ///< outwards: -1 or 1
  double wall;      ///< distance of the lattice's end from the outermost sample
};

using AxisEnds = std::array<AxisEnd, 2>;

std::array<AxisEnds, 3>
FindAxisEnds(const ImageBase<3> & scan, const Point<double, 3> & lowCorner, const Point<double, 3> & highCorner)
{
  const auto low = scan.TransformPhysicalPointToContinuousIndex<double>(lowCorner);
  const auto high = scan.TransformPhysicalPointToContinuousIndex<double>(highCorner);
  const auto & region = scan.GetLargestPossibleRegion();
  std::array<AxisEnds, 3> ends{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto first = static_cast<double>(region.GetIndex(axis));
    const double last = first + static_cast<double>(region.GetSize(axis)) - 1.0;
    ends[axis] = { AxisEnd{ first, -1.0, first - low[axis] }, AxisEnd{ last, 1.0, high[axis] - last } };
  }
  return ends;
}

} // namespace

void
MoveFCCWallsToBorder(TriangleSurface & surface,
                     const ImageBase<3> & scan,
                     const Point<double, 3> & lowCorner,
                     const Point<double, 3> & highCorner)
{
  constexpr double halfVoxel = 0.5;
  const auto ends = FindAxisEnds(scan, lowCorner, highCorner);
  const auto & spacing = scan.GetSpacing();
  auto & points = surface.GetPoints();
  rhombic::ForEachInBlocks(points.size(), PointsOfBlock, [&](std::size_t id) {
    auto & point = points[id];
    Point<double, 3> position;
    std::copy(point.begin(), point.end(), position.Begin());
    const auto index = scan.TransformPhysicalPointToContinuousIndex<double>(position);
    Vector<double, 3> move(0.0);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      for (const AxisEnd & end : ends[axis])
      {
        const double beyond = (index[axis] - end.sample) * end.direction;
        if (beyond > 0.0 && end.wall > 0.0)
        {
          move[axis] = end.direction * beyond * (halfVoxel / end.wall - 1.0) * spacing[axis];
        }
      }
    }
    if (move != Vector<double, 3>(0.0))
    {
      const Point<double, 3> moved = position + scan.GetDirection() * move;
      std::copy(moved.Begin(), moved.End(), point.begin());
    }
  });
  surface.Modified();
}

std::vector<std::uint32_t>
FindTrianglesNearFCCWalls(const TriangleSurface & surface, const ImageBase<3> & scan, double margin)
{
  const auto & region = scan.GetLargestPossibleRegion();
  const auto isNear = [&](std::uint32_t id) {
    Point<double, 3> position;
    const auto & point = surface.GetPoints()[id];
    std::copy(point.begin(), point.end(), position.Begin());
    const auto index = scan.TransformPhysicalPointToContinuousIndex<double>(position);
    bool isInside = true;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double samples = margin / scan.GetSpacing()[axis];
      const auto first = static_cast<double>(region.GetIndex(axis));
      const double last = first + static_cast<double>(region.GetSize(axis)) - 1.0;
      isInside &= index[axis] >= first + samples && index[axis] <= last - samples;
    }
    return !isInside;
  };
  std::vector<std::uint8_t> areNear(surface.GetNumberOfPoints());
  rhombic::ForEachInBlocks(
    areNear.size(), PointsOfBlock, [&](std::size_t id) { areNear[id] = isNear(static_cast<std::uint32_t>(id)); });
  std::vector<std::uint32_t> found;
  for (std::uint32_t triangle = 0; triangle < surface.GetNumberOfTriangles(); ++triangle)
  {
    const auto & [a, b, c] = surface.GetTriangles()[triangle];
    if (areNear[a] != 0 || areNear[b] != 0 || areNear[c] != 0)
    {
      found.push_back(triangle);
    }
  }
  return found;
}

} // namespace itk
