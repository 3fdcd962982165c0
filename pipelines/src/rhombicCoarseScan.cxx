#include "rhombicCoarseScan.h"

#include "itkConnectedComponentImageFilter.h"
#include "itkMultiThreaderBase.h"
#include "itkSignedMaurerDistanceMapImageFilter.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

constexpr double blockWidth = 2.0; // mm

/** Of the samples of a scan along one axis, those of one block. */
struct Range
{
  std::size_t begin;
  std::size_t end;
};

Range
RangeOf(std::size_t block, std::size_t samplesPerBlock, std::size_t size)
{
  return { block * samplesPerBlock, std::min((block + 1) * samplesPerBlock, size) };
}

/** Adds one row of samples to the sums of its blocks. Samples that are no number count as not there. */
template <typename TPixel>
void
AddRow(const TPixel * row,
       std::size_t size,
       std::size_t samplesPerBlock,
       double threshold,
       std::vector<std::uint32_t> & occupied,
       std::vector<double> & sums)
{
  for (std::size_t block = 0; block * samplesPerBlock < size; ++block)
  {
    const Range range = RangeOf(block, samplesPerBlock, size);
    std::uint32_t count = 0;
    double sum = 0.0;
    for (std::size_t i = range.begin; i < range.end; ++i)
    {
      const auto value = static_cast<double>(row[i]);
      count += value >= threshold ? 1 : 0;
      sum += std::isfinite(value) ? value : 0.0;
    }
    occupied[block] += count;
    sums[block] += sum;
  }
}

template <typename TPixel>
void
FillSlice(const itk::Image<TPixel, 3> & image, double threshold, std::size_t slice, CoarseScan & coarse)
{
  const auto size = image.GetBufferedRegion().GetSize();
  const auto blocks = coarse.occupancy->GetBufferedRegion().GetSize();
  const Range slices = RangeOf(slice, coarse.samplesPerBlock[2], size[2]);
  for (std::size_t row = 0; row < blocks[1]; ++row)
  {
    const Range rows = RangeOf(row, coarse.samplesPerBlock[1], size[1]);
    std::vector<std::uint32_t> occupied(blocks[0], 0);
    std::vector<double> sums(blocks[0], 0.0);
    for (std::size_t k = slices.begin; k < slices.end; ++k)
    {
      for (std::size_t j = rows.begin; j < rows.end; ++j)
      {
        const TPixel * const samples = image.GetBufferPointer() + size[0] * (j + size[1] * k);
        AddRow(samples, size[0], coarse.samplesPerBlock[0], threshold, occupied, sums);
      }
    }
    const std::size_t first = blocks[0] * (row + blocks[1] * slice);
    for (std::size_t block = 0; block < blocks[0]; ++block)
    {
      const Range columns = RangeOf(block, coarse.samplesPerBlock[0], size[0]);
      const std::size_t samples = (columns.end - columns.begin) * (rows.end - rows.begin) * (slices.end - slices.begin);
      // Rounded up, so that one sample is more than none.
      coarse.occupancy->GetBufferPointer()[first + block] =
        static_cast<std::uint8_t>((occupied[block] * std::size_t{ 255 } + samples - 1) / samples);
      const double mean = std::clamp(sums[block] / static_cast<double>(samples), -32768.0, 32767.0);
      coarse.mean->GetBufferPointer()[first + block] = static_cast<std::int16_t>(std::lround(mean));
    }
  }
}

} // namespace

itk::Point<double, 3>
CoarseScan::PointOf(const itk::Index<3> & index) const
{
  itk::Point<double, 3> point;
  occupancy->TransformIndexToPhysicalPoint(index, point);
  return sliceOffsets.empty() ? point : point + sliceOffsets[static_cast<std::size_t>(index[2])];
}

CoarseScan
MakeCoarseScan(const Scan & scan, double threshold)
{
  const auto & geometry = GeometryOf(scan.image);
  const auto size = geometry.GetLargestPossibleRegion().GetSize();
  CoarseScan coarse;
  auto spacing = geometry.GetSpacing();
  itk::Size<3> blocks;
  itk::ContinuousIndex<double, 3> first;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const bool isWhole = axis == 2 && !scan.sliceOrigins.empty();
    const auto samples = isWhole ? 1l : std::max(1l, std::lround(blockWidth / spacing[axis]));
    coarse.samplesPerBlock[axis] = static_cast<std::size_t>(samples);
    first[axis] = 0.5 * static_cast<double>(samples - 1);
    blocks[axis] = (size[axis] + coarse.samplesPerBlock[axis] - 1) / coarse.samplesPerBlock[axis];
    spacing[axis] *= static_cast<double>(samples);
  }
  itk::Point<double, 3> origin;
  geometry.TransformContinuousIndexToPhysicalPoint(first, origin);
  coarse.occupancy = MaskImage::New();
  coarse.occupancy->SetOrigin(origin);
  coarse.occupancy->SetSpacing(spacing);
  coarse.occupancy->SetDirection(geometry.GetDirection());
  coarse.occupancy->SetRegions(blocks);
  coarse.occupancy->Allocate();
  coarse.mean = MakeLike<MeanImage>(*coarse.occupancy);
  for (std::size_t slice = 0; slice < scan.sliceOrigins.size(); ++slice)
  {
    itk::Point<double, 3> even;
    geometry.TransformIndexToPhysicalPoint({ { 0, 0, static_cast<itk::IndexValueType>(slice) } }, even);
    coarse.sliceOffsets.push_back(scan.sliceOrigins[slice] - even);
  }
  std::visit(
    [&](const auto & image) {
      itk::MultiThreaderBase::New()->ParallelizeArray(
        0, blocks[2], [&](itk::SizeValueType slice) { FillSlice(*image, threshold, slice, coarse); }, nullptr);
    },
    scan.image);
  return coarse;
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

bool
HasBorder(const MaskImage & mask)
{
  const std::uint8_t * const begin = mask.GetBufferPointer();
  const std::uint8_t * const end = begin + mask.GetBufferedRegion().GetNumberOfPixels();
  return std::find(begin, end, 0) != end && std::find(begin, end, 1) != end;
}

Components
FindComponents(const MaskImage & mask, bool isFullyConnected)
{
  const auto filter = itk::ConnectedComponentImageFilter<MaskImage, ComponentImage>::New();
  filter->SetInput(&mask);
  filter->SetFullyConnected(isFullyConnected);
  filter->Update();
  Components components{ filter->GetOutput(), {} };
  components.parts.resize(filter->GetObjectCount() + 1);
  ForEachIndex(mask.GetBufferedRegion().GetSize(), [&](const itk::Index<3> & index, std::size_t n) {
    if (const std::uint32_t label = components.labels->GetBufferPointer()[n])
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
