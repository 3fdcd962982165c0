#include "rhombicSliceOrigins.h"

namespace rhombic
{

std::vector<itk::Point<double, 3>>
SliceOriginsOf(const Scan & scan)
{
  const auto & grid = GeometryOf(scan.image);
  const auto & region = grid.GetLargestPossibleRegion();
  std::vector<itk::Point<double, 3>> origins = scan.sliceOrigins;
  for (std::size_t slice = origins.size(); slice < region.GetSize(2); ++slice)
  {
    itk::Index<3> index = region.GetIndex();
    index[2] += static_cast<itk::IndexValueType>(slice);
    origins.push_back(grid.TransformIndexToPhysicalPoint<double>(index));
  }
  return origins;
}

} // namespace rhombic
