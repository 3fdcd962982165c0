#include "itkLabelsOnLattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace itk
{
namespace
{

/** The number of a site's row in a lattice, as FCCLabelWeights counts rows. */
SizeValueType
GetRowNumber(const Index<3> & site, const ImageRegion<3> & lattice)
{
  return static_cast<SizeValueType>(site[2] - lattice.GetIndex(2)) * lattice.GetSize(1) +
         static_cast<SizeValueType>(site[1] - lattice.GetIndex(1));
}

} // namespace

std::array<SizeValueType, 3>
DivideVoxels(const Vector<double, 3> & spacing)
{
  constexpr double longest = 1.5;
  const double shortest = std::min({ spacing[0], spacing[1], spacing[2] });
  std::array<SizeValueType, 3> parts;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double length = spacing[axis] / shortest;
    parts[axis] = length > longest ? static_cast<SizeValueType>(std::lround(length)) : 1;
  }
  return parts;
}

void
AddLabelWeights(const FCCImage<float> & field,
                FCCLabelWeights::LabelType label,
                FCCImage<FCCLabelWeights::LabelType> & labels,
                std::vector<float> & largest,
                FCCLabelWeights & weights)
{
  constexpr float limit = FCCLabelWeights::Limit;
  const auto & sites = field.GetBufferedRegion();
  const SizeValueType length = labels.GetLargestPossibleRegion().GetSize(0);
  if (length > std::numeric_limits<std::uint16_t>::max())
  {
    itkGenericExceptionMacro("A row of the lattice has " << length << " sites, but weights have places for 65,535.");
  }
  ForEachRow(sites, [&](const Index<3> & first, SizeValueType fieldOffset) {
    const SizeValueType row = GetRowNumber(first, labels.GetLargestPossibleRegion());
    const float * const values = field.GetBufferPointer() + fieldOffset;
    const OffsetValueType offset = labels.ComputeOffset(first);
    FCCLabelWeights::LabelType * const rowLabels = labels.GetBufferPointer() + offset;
    float * const rowLargest = largest.data() + offset;
    for (SizeValueType i = 0; i < sites.GetSize(0); ++i)
    {
      const float weight = std::clamp(values[i], -limit, limit);
      if (weight > rowLargest[i])
      {
        rowLargest[i] = weight;
        rowLabels[i] = label;
      }
      if (std::abs(weight) < limit)
      {
        weights.Add(row, { static_cast<std::uint16_t>(static_cast<SizeValueType>(first[0]) + i), label, weight });
      }
    }
  });
}

void
SortWeights(const ImageRegion<3> & lattice, FCCLabelWeights & weights)
{
  rhombic::ForEachInBlocks(lattice.GetSize(1) * lattice.GetSize(2), 64, [&](std::size_t row) { weights.SortRow(row); });
}

} // namespace itk
