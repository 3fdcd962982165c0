#include "rhombicCoarseScan.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace rhombic
{
namespace
{

constexpr double blockWidth = 2.0; // mm

template <typename TPixel>
struct BlockSums
{
  using SumType = std::conditional_t<std::is_integral_v<TPixel>, std::int64_t, double>;
  std::uint32_t tissue = 0;
  std::uint32_t hard = 0;
  SumType values = 0; // samples that are not a number count as 0
};

/** A share of a block's samples out of 255, rounded up, so that one sample is more than none. */
std::uint8_t
ShareOf(std::size_t count, std::size_t samples)
{
  return static_cast<std::uint8_t>((count * 255 + samples - 1) / samples);
}

template <typename TPixel>
void
FillBlocks(const itk::Image<TPixel, 3> & image, float tissue, float hard, CoarseScan & coarse)
{
  using Sums = BlockSums<TPixel>;
  const auto add = [=](Sums & sums, TPixel sample) {
    const auto value = static_cast<float>(sample);
    sums.tissue += value >= tissue ? 1 : 0;
    sums.hard += value >= hard ? 1 : 0;
    sums.values += std::isfinite(value) ? sample : TPixel{ 0 };
  };
  const auto store = [&](std::size_t block, const Sums & sums, std::size_t samples) {
    const double mean = static_cast<double>(sums.values) / static_cast<double>(samples);
    coarse.occupancy->GetBufferPointer()[block] = ShareOf(sums.tissue, samples);
    coarse.hardness->GetBufferPointer()[block] = ShareOf(sums.hard, samples);
    coarse.mean->GetBufferPointer()[block] =
      static_cast<std::int16_t>(std::lround(std::clamp(mean, -32768.0, 32767.0)));
  };
  SumBlocks<Sums>(image, coarse.shape, coarse.occupancy->GetBufferedRegion().GetSize(), add, store);
}

} // namespace

itk::Point<double, 3>
CoarseScan::PointOf(const itk::Index<3> & index) const
{
  itk::Point<double, 3> point;
  occupancy->TransformIndexToPhysicalPoint(index, point);
  return sliceOffsets.empty() ? point : point + sliceOffsets[static_cast<std::size_t>(index[2])];
}

double
CoarseScan::Millilitres(std::size_t blocks) const
{
  const auto & spacing = occupancy->GetSpacing();
  return static_cast<double>(blocks) * (spacing[0] * spacing[1] * spacing[2] / 1000.0);
}

CoarseScan
MakeCoarseScan(const Scan & scan, double tissue, double hard)
{
  const auto & geometry = GeometryOf(scan.image);
  const auto size = geometry.GetLargestPossibleRegion().GetSize();
  CoarseScan coarse;
  coarse.longAxis = NearestAxis(geometry.GetDirection(), 2);
  auto spacing = geometry.GetSpacing();
  itk::Size<3> blocks;
  itk::ContinuousIndex<double, 3> first;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const bool isWhole = axis == 2 && !scan.sliceOrigins.empty(); // blocks of uneven stacks have one slice
    const auto samples = isWhole ? 1l : std::max(1l, std::lround(blockWidth / spacing[axis]));
    coarse.shape[axis] = static_cast<std::size_t>(samples);
    first[axis] = 0.5 * static_cast<double>(samples - 1);
    blocks[axis] = (size[axis] + coarse.shape[axis] - 1) / coarse.shape[axis];
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
  coarse.mean = MakeLike<itk::Image<std::int16_t, 3>>(*coarse.occupancy);
  for (std::size_t slice = 0; slice < scan.sliceOrigins.size(); ++slice)
  {
    itk::Point<double, 3> even;
    geometry.TransformIndexToPhysicalPoint({ { 0, 0, static_cast<itk::IndexValueType>(slice) } }, even);
    coarse.sliceOffsets.push_back(scan.sliceOrigins[slice] - even);
  }
  std::visit(
    [&](const auto & image) { FillBlocks(*image, static_cast<float>(tissue), static_cast<float>(hard), coarse); },
    scan.image);
  return coarse;
}

} // namespace rhombic
