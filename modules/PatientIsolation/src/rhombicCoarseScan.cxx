#include "rhombicCoarseScan.h"

#include "itkConnectedComponentImageFilter.h"
#include "itkForEachBlock.h"
#include "itkSignedMaurerDistanceMapImageFilter.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

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

/** What has been seen of a block's samples. */
template <typename TPixel>
struct BlockSums
{
  using SumType = std::conditional_t<std::is_integral_v<TPixel>, std::int64_t, double>;
  std::uint32_t tissue = 0;
  std::uint32_t hard = 0;
  SumType sum = 0;
};

/** Adds one row of samples to its blocks. Samples that are no number count as 0. */
template <typename TPixel>
void
AddRow(const TPixel * row,
       std::size_t size,
       std::size_t samplesPerBlock,
       float tissue,
       float hard,
       std::vector<BlockSums<TPixel>> & blocks)
{
  for (std::size_t block = 0; block < blocks.size(); ++block)
  {
    const Range range = RangeOf(block, samplesPerBlock, size);
    for (std::size_t i = range.begin; i < range.end; ++i)
    {
      const auto value = static_cast<float>(row[i]);
      blocks[block].tissue += value >= tissue ? 1 : 0;
      blocks[block].hard += value >= hard ? 1 : 0;
      blocks[block].sum += std::isfinite(value) ? row[i] : TPixel{ 0 };
    }
  }
}

/** A share of a block's samples out of 255, rounded up, so that one sample is more than none. */
std::uint8_t
ShareOf(std::size_t count, std::size_t samples)
{
  return static_cast<std::uint8_t>((count * 255 + samples - 1) / samples);
}

template <typename TPixel>
void
FillSlice(const itk::Image<TPixel, 3> & image, float tissue, float hard, std::size_t slice, CoarseScan & coarse)
{
  const auto size = image.GetBufferedRegion().GetSize();
  const auto blocks = coarse.occupancy->GetBufferedRegion().GetSize();
  const auto & samplesPerBlock = coarse.samplesPerBlock;
  const Range slices = RangeOf(slice, samplesPerBlock[2], size[2]);
  for (std::size_t row = 0; row < blocks[1]; ++row)
  {
    const Range rows = RangeOf(row, samplesPerBlock[1], size[1]);
    std::vector<BlockSums<TPixel>> sums(blocks[0]);
    for (std::size_t k = slices.begin; k < slices.end; ++k)
    {
      for (std::size_t j = rows.begin; j < rows.end; ++j)
      {
        AddRow(image.GetBufferPointer() + size[0] * (j + size[1] * k), size[0], samplesPerBlock[0], tissue, hard, sums);
      }
    }
    for (std::size_t block = 0; block < blocks[0]; ++block)
    {
      const Range columns = RangeOf(block, samplesPerBlock[0], size[0]);
      const std::size_t samples = (columns.end - columns.begin) * (rows.end - rows.begin) * (slices.end - slices.begin);
      const std::size_t n = block + blocks[0] * (row + blocks[1] * slice);
      const double mean = static_cast<double>(sums[block].sum) / static_cast<double>(samples);
      coarse.occupancy->GetBufferPointer()[n] = ShareOf(sums[block].tissue, samples);
      coarse.hardness->GetBufferPointer()[n] = ShareOf(sums[block].hard, samples);
      coarse.mean->GetBufferPointer()[n] = static_cast<std::int16_t>(std::lround(std::clamp(mean, -32768.0, 32767.0)));
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
MakeCoarseScan(const Scan & scan, double tissue, double hard)
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
  coarse.hardness = MakeLike<MaskImage>(*coarse.occupancy);
  coarse.mean = MakeLike<MeanImage>(*coarse.occupancy);
  for (std::size_t slice = 0; slice < scan.sliceOrigins.size(); ++slice)
  {
    itk::Point<double, 3> even;
    geometry.TransformIndexToPhysicalPoint({ { 0, 0, static_cast<itk::IndexValueType>(slice) } }, even);
    coarse.sliceOffsets.push_back(scan.sliceOrigins[slice] - even);
  }
  std::visit(
    [&](const auto & image) {
      itk::ForEachInBlocks(blocks[2], 1, [&](std::size_t slice) {
        FillSlice(*image, static_cast<float>(tissue), static_cast<float>(hard), slice, coarse);
      });
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

OpenSpace
FindOpenSpace(const DistanceImage & distance, double radius, unsigned int longAxis)
{
  const float * const distances = distance.GetBufferPointer();
  const auto centres = MakeMask(distance, [=](std::size_t n) { return static_cast<double>(distances[n]) > radius; });
  OpenSpace space{ FindComponents(*centres, false), {} };
  const auto size = distance.GetBufferedRegion().GetSize();
  for (const Component & part : space.balls.parts)
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
FillOpenSpace(const OpenSpace & space, const std::vector<bool> & isPartIn, double radius)
{
  const std::uint32_t * const labels = space.balls.labels->GetBufferPointer();
  const auto centres = MakeMask(*space.balls.labels, [&](std::size_t n) { return isPartIn[labels[n]]; });
  if (!HasBorder(*centres))
  {
    return nullptr;
  }
  const auto distance = DistanceTo(*centres);
  return MakeMask(*distance,
                  [&](std::size_t n) { return static_cast<double>(distance->GetBufferPointer()[n]) <= radius; });
}

} // namespace rhombic
