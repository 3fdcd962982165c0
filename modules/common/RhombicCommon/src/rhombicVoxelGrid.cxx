#include "rhombicVoxelGrid.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{

itk::Vector<double, 3>
StepAlong(const itk::ImageBase<3> & grid, unsigned int axis)
{
  return itk::Vector<double, 3>(grid.GetDirection().GetVnlMatrix().get_column(axis).data_block()) *
         grid.GetSpacing()[axis];
}

double
MeanSpacingOf(const itk::ImageBase<3> & grid)
{
  const auto & spacing = grid.GetSpacing();
  return std::cbrt(spacing[0] * spacing[1] * spacing[2]);
}

std::vector<double>
VoxelVolumesOf(const itk::ImageBase<3> & grid, const std::vector<itk::Point<double, 3>> & sliceOrigins)
{
  const std::size_t numberOfSlices = grid.GetLargestPossibleRegion().GetSize()[2];
  const itk::Vector<double, 3> pixel =
    itk::CrossProduct(StepAlong(grid, 0), StepAlong(grid, 1)); // its norm is the area
  if (sliceOrigins.empty() || numberOfSlices < 2)
  {
    return std::vector<double>(numberOfSlices, std::abs(pixel * StepAlong(grid, 2)));
  }
  std::vector<double> volumes(numberOfSlices);
  const auto volumeBehind = [&](std::size_t slice) {
    return std::abs(pixel * (sliceOrigins[slice + 1] - sliceOrigins[slice]));
  };
  for (std::size_t slice = 0; slice < numberOfSlices; ++slice)
  {
    const double before = volumeBehind(slice > 0 ? slice - 1 : 0);
    const double behind = volumeBehind(std::min(slice, numberOfSlices - 2));
    volumes[slice] = (before + behind) / 2;
  }
  return volumes;
}

double
DistanceFromEvenSlices(const std::vector<itk::Point<double, 3>> & sliceOrigins)
{
  double largest = 0;
  for (std::size_t slice = 1; slice < sliceOrigins.size(); ++slice)
  {
    const auto steps = static_cast<double>(sliceOrigins.size() - 1);
    const itk::Vector<double, 3> step = (sliceOrigins.back() - sliceOrigins.front()) / steps;
    const itk::Vector<double, 3> actual = sliceOrigins[slice] - sliceOrigins.front();
    largest = std::max(largest, (actual - step * static_cast<double>(slice)).GetNorm());
  }
  return largest;
}

double
EvenSliceTolerance(double step)
{
  constexpr double millimetres = 0.01;
  return std::min(millimetres, 0.1 * step);
}

} // namespace rhombic
