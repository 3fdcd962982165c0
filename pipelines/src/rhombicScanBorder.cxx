#include "rhombicScanBorder.h"

#include <algorithm>
#include <array>

namespace rhombic
{
namespace
{

using PointType = itk::Point<double, 3>;

/** One end of an axis of the scan, in samples. */
struct End
{
  double sample;   ///< the outermost one
  double outwards; ///< -1 or 1
  double wall;     ///< how far from it the lattice ends
};

/** The outer corner of the lattice's extent (see itk::FCCImage), at its low or its high end. */
template <typename TPixel>
PointType
CornerOf(const itk::FCCImage<TPixel> & lattice, bool isHigh)
{
  constexpr double unitsPerIndex[3] = { 2.0, 1.0, 1.0 };
  const auto & region = lattice.GetLargestPossibleRegion();
  std::array<double, 3> corner{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto places =
      static_cast<double>(region.GetIndex(axis)) + (isHigh ? static_cast<double>(region.GetSize(axis)) : 0.0);
    corner[axis] = unitsPerIndex[axis] * places - 0.5;
  }
  return lattice.template TransformLatticeToPhysicalPoint<double>(corner);
}

std::array<std::array<End, 2>, 3>
FindEnds(const itk::ImageBase<3> & scan, const FCCVolume & lattice)
{
  const auto indexOf = [&](bool isHigh) {
    const auto corner = std::visit([isHigh](const auto & image) { return CornerOf(*image, isHigh); }, lattice);
    return scan.TransformPhysicalPointToContinuousIndex<double>(corner);
  };
  const auto low = indexOf(false);
  const auto high = indexOf(true);
  const auto & region = scan.GetLargestPossibleRegion();
  std::array<std::array<End, 2>, 3> ends{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto first = static_cast<double>(region.GetIndex(axis));
    const double last = first + static_cast<double>(region.GetSize(axis)) - 1.0;
    ends[axis] = { End{ first, -1.0, first - low[axis] }, End{ last, 1.0, high[axis] - last } };
  }
  return ends;
}

} // namespace

void
MoveWallsToBorder(itk::TriangleSurface & surface, const itk::ImageBase<3> & scan, const FCCVolume & lattice)
{
  constexpr double voxel = 0.5; // how far it reaches beyond its sample
  const auto ends = FindEnds(scan, lattice);
  const auto & spacing = scan.GetSpacing();
  for (auto & point : surface.GetPoints())
  {
    PointType place;
    std::copy(point.begin(), point.end(), place.Begin());
    const auto index = scan.TransformPhysicalPointToContinuousIndex<double>(place);
    itk::Vector<double, 3> move(0.0);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      for (const End & end : ends[axis])
      {
        const double beyond = (index[axis] - end.sample) * end.outwards;
        if (beyond > 0.0 && end.wall > 0.0)
        {
          move[axis] = end.outwards * beyond * (voxel / end.wall - 1.0) * spacing[axis];
        }
      }
    }
    if (move != itk::Vector<double, 3>(0.0))
    {
      const PointType moved = place + scan.GetDirection() * move;
      std::copy(moved.Begin(), moved.End(), point.begin());
    }
  }
  surface.Modified();
}

} // namespace rhombic
