#include "rhombicBlockGrid.h"

#include "itkConnectedComponentImageFilter.h"

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
DistanceTo(const MaskImage & mask, double reach)
{
  const auto & size = mask.GetBufferedRegion().GetSize();
  const std::size_t count = mask.GetBufferedRegion().GetNumberOfPixels();
  const auto farthest = static_cast<float>(reach * reach);
  const auto distance = MakeLike<DistanceImage>(mask);
  float * const squares = distance->GetBufferPointer();
  const std::uint8_t * const isIn = mask.GetBufferPointer();
  std::transform(isIn, isIn + count, squares, [=](std::uint8_t value) { return value != 0 ? 0.0f : farthest; });
  std::vector<float> before(count);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    std::copy_n(squares, count, before.begin());
    const double width = mask.GetSpacing()[axis];
    const auto step = static_cast<std::ptrdiff_t>(mask.GetOffsetTable()[axis]);
    const auto steps = static_cast<std::ptrdiff_t>(reach / width);
    const auto length = static_cast<std::ptrdiff_t>(size[0]);
    ForEachInBlocks(size[1] * size[2], 32, [&](std::size_t row) {
      float * const least = squares + row * size[0];
      const auto place = static_cast<std::ptrdiff_t>(axis == 1 ? row % size[1] : row / size[1]); // of the row
      for (std::ptrdiff_t apart = -steps; apart <= steps; ++apart)
      {
        const bool isInGrid = place + apart >= 0 && place + apart < static_cast<std::ptrdiff_t>(size[axis]);
        if (axis != 0 && !isInGrid)
        {
          continue;
        }
        const float * const values = before.data() + row * size[0] + apart * step;
        const double millimetres = static_cast<double>(apart) * width;
        const auto square = static_cast<float>(millimetres * millimetres);
        const std::ptrdiff_t first = axis == 0 ? std::max<std::ptrdiff_t>(-apart, 0) : 0;
        const std::ptrdiff_t end = axis == 0 ? length - std::max<std::ptrdiff_t>(apart, 0) : length;
        for (std::ptrdiff_t n = first; n < end; ++n)
        {
          least[n] = std::min(least[n], values[n] + square);
        }
      }
    });
  }
  std::transform(squares, squares + count, squares, [](float square) { return std::sqrt(square); });
  return distance;
}

Components
FindMaskComponents(const MaskImage & mask, bool isFullyConnected)
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

} // namespace rhombic
