#include "rhombicBlockGrid.h"

#include "itkConnectedComponentImageFilter.h"
#include "itkSignedMaurerDistanceMapImageFilter.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{

unsigned int
NearestAxis(const itk::ImageBase<3>::DirectionType & direction, unsigned int patientAxis, unsigned int except)
{
  unsigned int nearest = except == 0 ? 1 : 0;
  for (unsigned int axis = nearest + 1; axis < 3; ++axis)
  {
    if (axis != except && std::abs(direction[patientAxis][axis]) > std::abs(direction[patientAxis][nearest]))
    {
      nearest = axis;
    }
  }
  return nearest;
}

bool
HasBorder(const MaskImage & mask)
{
  const std::uint8_t * const begin = mask.GetBufferPointer();
  const std::uint8_t * const end = begin + mask.GetBufferedRegion().GetNumberOfPixels();
  return std::find(begin, end, 0) != end && std::find(begin, end, 1) != end;
}

bool
IsNear(const MaskImage & mask, std::size_t offset)
{
  const itk::Index<3> index = mask.ComputeIndex(static_cast<itk::OffsetValueType>(offset));
  const auto & size = mask.GetBufferedRegion().GetSize();
  itk::Index<3> begin;
  itk::Index<3> end;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    begin[axis] = std::max<itk::IndexValueType>(index[axis] - 1, 0);
    end[axis] = std::min<itk::IndexValueType>(index[axis] + 2, static_cast<itk::IndexValueType>(size[axis]));
  }
  for (itk::IndexValueType k = begin[2]; k < end[2]; ++k)
  {
    for (itk::IndexValueType j = begin[1]; j < end[1]; ++j)
    {
      const std::uint8_t * const row = mask.GetBufferPointer() + mask.ComputeOffset({ { 0, j, k } });
      if (std::find(row + begin[0], row + end[0], 1) != row + end[0])
      {
        return true;
      }
    }
  }
  return false;
}

DistanceImage::Pointer
DistanceTo(const MaskImage & mask)
{
  const auto filter = itk::SignedMaurerDistanceMapImageFilter<MaskImage, DistanceImage>::New();
  filter->SetInput(&mask);
  filter->SetSquaredDistance(false);
  filter->SetUseImageSpacing(true);
  filter->SetInsideIsPositive(false);
  filter->Update();
  return filter->GetOutput();
}

Components
FindComponents(const MaskImage & mask, bool isFullyConnected)
{
  const auto filter = itk::ConnectedComponentImageFilter<MaskImage, LabelImage>::New();
  filter->SetInput(&mask);
  filter->SetFullyConnected(isFullyConnected);
  filter->Update();
  Components components{ filter->GetOutput(), {} };
  components.parts.resize(filter->GetObjectCount() + 1);
  ForEachIndex(mask.GetBufferedRegion().GetSize(), [&](const itk::Index<3> & index, std::size_t offset) {
    if (const std::uint32_t label = components.labels->GetBufferPointer()[offset])
    {
      Component & part = components.parts[label];
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        part.lowest[axis] = part.count == 0 ? index[axis] : std::min(part.lowest[axis], index[axis]);
        part.highest[axis] = part.count == 0 ? index[axis] : std::max(part.highest[axis], index[axis]);
      }
      ++part.count;
    }
  });
  return components;
}

OpenSpace
FindOpenSpace(const DistanceImage & distance, unsigned int longAxis)
{
  const float * const distances = distance.GetBufferPointer();
  const auto centres =
    MakeMask(distance, [=](std::size_t offset) { return static_cast<double>(distances[offset]) > ballRadius; });
  OpenSpace space{ FindComponents(*centres, false), {} };
  const auto & size = distance.GetBufferedRegion().GetSize();
  for (const Component & part : space.centres.parts)
  {
    bool reaches = false;
    for (unsigned int axis = 0; axis < 3 && part.count > 0; ++axis)
    {
      const auto end = static_cast<itk::IndexValueType>(size[axis]);
      reaches = reaches || (axis != longAxis && (part.lowest[axis] == 0 || part.highest[axis] + 1 == end));
    }
    space.reachesSides.push_back(reaches);
  }
  return space;
}

MaskImage::Pointer
FillOpenSpace(const OpenSpace & space, const std::vector<bool> & isPartIn)
{
  const auto centres = MaskOfParts(space.centres, [&](std::size_t label) { return isPartIn[label]; });
  if (!HasBorder(*centres))
  {
    return nullptr;
  }
  const auto distance = DistanceTo(*centres);
  const float * const distances = distance->GetBufferPointer();
  return MakeMask(*distance, [=](std::size_t offset) { return static_cast<double>(distances[offset]) <= ballRadius; });
}

} // namespace rhombic
