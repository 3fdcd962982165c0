#include "rhombicScan.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{

const itk::ImageBase<3> &
GeometryOf(const ScanImage & image)
{
  return std::visit([](const auto & pointer) -> const itk::ImageBase<3> & { return *pointer; }, image);
}

std::string
PixelTypeName(const ScanImage & image)
{
  return std::visit(
    [](const auto & pointer) { return PixelTypeName<typename std::decay_t<decltype(*pointer)>::PixelType>(); }, image);
}

std::vector<double>
VoxelVolumes(const Scan & scan)
{
  const itk::ImageBase<3> & grid = GeometryOf(scan.image);
  const auto spacing = grid.GetSpacing();
  const std::size_t numberOfSlices = grid.GetLargestPossibleRegion().GetSize()[2];
  const auto axisStep = [&grid, &spacing](unsigned int axis) {
    return itk::Vector<double, 3>(grid.GetDirection().GetVnlMatrix().get_column(axis).data_block()) * spacing[axis];
  };
  const itk::Vector<double, 3> pixel = itk::CrossProduct(axisStep(0), axisStep(1)); // its length is the area of a pixel
  if (scan.sliceOrigins.empty() || numberOfSlices < 2)
  {
    return std::vector<double>(numberOfSlices, std::abs(pixel * axisStep(2)));
  }

  std::vector<double> volumes(numberOfSlices);
  const auto volumeBehind = [&](std::size_t slice) {
    return std::abs(pixel * (scan.sliceOrigins[slice + 1] - scan.sliceOrigins[slice]));
  };
  for (std::size_t slice = 0; slice < numberOfSlices; ++slice)
  {
    const double before = volumeBehind(slice > 0 ? slice - 1 : 0);
    const double behind = volumeBehind(std::min(slice, numberOfSlices - 2));
    volumes[slice] = (before + behind) / 2;
  }
  return volumes;
}

} // namespace rhombic
