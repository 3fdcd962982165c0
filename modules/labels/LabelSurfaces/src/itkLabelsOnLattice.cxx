#include "itkLabelsOnLattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace itk
{

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

StrongestLabels::StrongestLabels(FCCImage<LabelType> & labels, FCCLabelWeights & weights)
  : m_Labels(labels)
  , m_Weights(weights)
  , m_Largest(labels.GetLargestPossibleRegion().GetNumberOfPixels())
{
  const auto & size = labels.GetLargestPossibleRegion().GetSize();
  ForEachRow(labels.GetLargestPossibleRegion(), [&](const Index<3> &, SizeValueType offset) {
    std::fill_n(m_Largest.data() + offset, size[0], -FCCLabelWeights::Limit);
    std::fill_n(labels.GetBufferPointer() + offset, size[0], LabelType{ 0 });
  });
  weights.SetNumberOfRows(size[1] * size[2]);
}

template <typename TWeight>
void
StrongestLabels::AddWeights(const FCCImage<float> & field, LabelType label, const TWeight & weightOf)
{
  constexpr float limit = FCCLabelWeights::Limit;
  const auto & sites = field.GetBufferedRegion();
  const SizeValueType length = m_Labels.GetLargestPossibleRegion().GetSize(0);
  if (length > std::numeric_limits<std::uint16_t>::max())
  {
    itkGenericExceptionMacro("A row of the lattice has " << length << " sites, but weights have places for 65,535.");
  }
  ForEachRow(sites, [&](const Index<3> & first, SizeValueType fieldOffset) {
    const float * const values = field.GetBufferPointer() + fieldOffset;
    const auto firstSite = static_cast<SizeValueType>(m_Labels.ComputeOffset(first));
    for (SizeValueType i = 0; i < sites.GetSize(0); ++i)
    {
      const float weight = std::clamp(weightOf(values[i], firstSite + i), -limit, limit);
      if (weight > m_Largest[firstSite + i])
      {
        m_Largest[firstSite + i] = weight;
        m_Labels.GetBufferPointer()[firstSite + i] = label;
      }
      if (std::abs(weight) < limit)
      {
        m_Weights.Add(firstSite / length, { static_cast<std::uint16_t>(firstSite % length + i), label, weight });
      }
    }
  });
}

void
StrongestLabels::Add(const FCCImage<float> & field, LabelType label)
{
  this->AddWeights(field, label, [](float value, SizeValueType) { return value; });
}

void
StrongestLabels::AddZero(const FCCImage<float> & field, const BulkVector<std::uint8_t> & hasOneNeighbor)
{
  this->AddWeights(
    field, 0, [&](float value, SizeValueType site) { return hasOneNeighbor[site] != 0 ? -m_Largest[site] : value; });
}

void
StrongestLabels::SortWeights()
{
  rhombic::ForEachInBlocks(m_Weights.GetNumberOfRows(), 64, [this](std::size_t row) { m_Weights.SortRow(row); });
}

} // namespace itk
