#include "rhombicLabelNumbers.h"
#include "rhombicLabelSurfaces.h"

#include <algorithm>
#include <iterator>

namespace rhombic
{
namespace
{

/** The voxels of a label so far: the sums of their indices, and the ends of the box around them. */
struct Voxels
{
  std::size_t count = 0;
  itk::Index<3> sums{};
  itk::Index<3> lowest{};
  itk::Index<3> highest{};
};

/** Adds the voxels [begin, end) of a row along x.
 * \param row the index of the row's voxel 0 */
void
AddRun(const itk::Index<3> & row, std::size_t begin, std::size_t end, Voxels & voxels)
{
  const auto length = static_cast<itk::IndexValueType>(end - begin);
  itk::Index<3> first = row;
  first[0] += static_cast<itk::IndexValueType>(begin);
  itk::Index<3> last = first;
  last[0] += length - 1;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    voxels.lowest[axis] = voxels.count == 0 ? first[axis] : std::min(voxels.lowest[axis], first[axis]);
    voxels.highest[axis] = voxels.count == 0 ? last[axis] : std::max(voxels.highest[axis], last[axis]);
    voxels.sums[axis] += length * (first[axis] + last[axis]) / 2;
  }
  voxels.count += end - begin;
}

} // namespace

std::vector<LabelVoxels>
FindLabelVoxels(const LabelMap & map, const std::vector<std::string> & labels)
{
  const std::vector<LabelSummary> chosen = ChooseLabels(map, labels);
  std::vector<Voxels> voxels(chosen.size());
  for (const ScanImage & layer : LayersOf(map.scan))
  {
    const NumberImage::Pointer numbers = NumberLabels(layer, chosen);
    const itk::ImageRegion<3> & region = numbers->GetBufferedRegion();
    for (std::size_t row = 0; row < region.GetSize(1) * region.GetSize(2); ++row)
    {
      const std::size_t first = row * region.GetSize(0);
      const itk::Index<3> index = numbers->ComputeIndex(static_cast<itk::OffsetValueType>(first));
      const auto add = [&](std::uint16_t number, std::size_t begin, std::size_t end) {
        if (number != 0)
        {
          AddRun(index, begin, end, voxels[number - 1U]);
        }
      };
      ForEachRun(numbers->GetBufferPointer() + first, region.GetSize(0), add);
    }
  }
  std::vector<LabelVoxels> found(chosen.size());
  for (std::size_t n = 0; n < found.size(); ++n)
  {
    found[n].name = chosen[n].label.name;
    found[n].count = voxels[n].count;
    found[n].region.SetIndex(voxels[n].lowest);
    found[n].region.SetUpperIndex(voxels[n].highest);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      found[n].centroid[axis] = static_cast<double>(voxels[n].sums[axis]) / static_cast<double>(voxels[n].count);
    }
  }
  return found;
}

} // namespace rhombic
