#ifndef rhombicLatticeBlocks_h
#define rhombicLatticeBlocks_h

#include "rhombicBlockGrid.h"
#include "rhombicBlockSamples.h"
#include "rhombicThreshold.h"

#include "itkFCCImage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace rhombic
{

/** \file
 * A lattice volume in blocks of about 4 mm, and the air around the body in them. */

inline constexpr double gridBlockWidth = 4.0;                 // mm
inline constexpr double unitsPerIndex[3] = { 2.0, 1.0, 1.0 }; // lattice units between the samples along each axis

/** A lattice volume in blocks. */
struct LatticeBlocks
{
  BlockShape shape{};
  itk::Image<float, 3>::Pointer mean;
  MaskImage::Pointer isUniform; ///< blocks whose values are all the same
  MaskImage::Pointer around;    ///< blocks of air around the body
};

struct BlockValues
{
  double sum = 0.0;
  double lowest = std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::lowest();
};

/** Makes blocks about as wide as gridBlockWidth. Values below \a lowest count as \a lowest. */
template <typename TPixel>
LatticeBlocks
MakeBlocks(const itk::FCCImage<TPixel> & image, double lowest)
{
  LatticeBlocks blocks;
  itk::Size<3> count;
  DistanceImage::SpacingType spacing;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double step = unitsPerIndex[axis] * image.GetSpacing()[axis];
    const auto samples = static_cast<std::size_t>(std::max(1l, std::lround(gridBlockWidth / step)));
    blocks.shape[axis] = samples;
    count[axis] = (image.GetBufferedRegion().GetSize(axis) + samples - 1) / samples;
    spacing[axis] = step * static_cast<double>(samples);
  }
  blocks.mean = itk::Image<float, 3>::New();
  blocks.mean->SetRegions(count);
  blocks.mean->SetSpacing(spacing);
  blocks.mean->Allocate();
  blocks.isUniform = MakeLike<MaskImage>(*blocks.mean);
  const auto add = [=](BlockValues & values, TPixel sample) {
    const double value = std::max(static_cast<double>(sample), lowest);
    values.sum += value;
    values.lowest = std::min(values.lowest, value);
    values.highest = std::max(values.highest, value);
  };
  const auto store = [&](std::size_t block, const BlockValues & values, std::size_t samples) {
    blocks.mean->GetBufferPointer()[block] = static_cast<float>(values.sum / static_cast<double>(samples));
    blocks.isUniform->GetBufferPointer()[block] = values.lowest == values.highest ? 1 : 0;
  };
  SumBlocks<BlockValues>(image, blocks.shape, count, add, store);
  return blocks;
}

/** The blocks whose mean is inside. */
inline MaskImage::Pointer
MakeInsideMask(const LatticeBlocks & blocks, const Threshold & threshold)
{
  const float * const means = blocks.mean->GetBufferPointer();
  return MakeMask(*blocks.mean, [=](std::size_t offset) { return threshold.IsInside(means[offset]); });
}

/** The blocks of air around the body: those inside the threshold \a air, as far as they are connected to an edge of the
 * scan along the patient. For thresholds in HU (below 0), \a air's isovalue is replaced by \a highest, in HU, so that
 * lungs are no air, and parts count that reach a side between these edges where a ball of 8 mm radius has room. */
MaskImage::Pointer
FindAirAround(const LatticeBlocks & blocks,
              const Threshold & air,
              double highest,
              const itk::ImageBase<3>::DirectionType & direction);

/** Makes blocks with the mask of those of air around the body; see FindAirAround(). */
template <typename TPixel>
LatticeBlocks
FindSurroundings(const itk::FCCImage<TPixel> & image, const Threshold & air, double highest = highestAir)
{
  constexpr double lowestAir = -1100.0; // HU: lower values are padding
  const bool isHounsfield = air.insideIsBelow && air.isovalue < 0.0;
  LatticeBlocks blocks = MakeBlocks(image, isHounsfield ? lowestAir : std::numeric_limits<double>::lowest());
  blocks.around = FindAirAround(blocks, air, highest, image.GetDirection());
  return blocks;
}

/** The mean of the blocks around the body. */
double
MeanAround(const LatticeBlocks & blocks);

/** Moves the values of the masked blocks to the side of the isovalue on which the air around the body is not. A smooth
 * ramp at their border keeps the new surface there free of steps. */
template <typename TPixel>
void
MoveFromAir(itk::FCCImage<TPixel> & image, const LatticeBlocks & blocks, const MaskImage & mask, double isovalue)
{
  const auto & region = image.GetBufferedRegion();
  const auto & size = region.GetSize();
  const auto & count = mask.GetBufferedRegion().GetSize();
  // The rise of the values across the ramp; negative if the air is above the isovalue.
  constexpr double steepness = 4.0; // relative to isovalue minus mean around the body
  const double height = steepness * (isovalue - MeanAround(blocks));
  const auto tapsAlong = [&](unsigned int axis, double firstSample) {
    std::vector<Taps<2>> taps;
    for (std::size_t sample = 0; sample < size[axis]; ++sample)
    {
      taps.push_back(LinearTaps(static_cast<double>(sample) + firstSample, blocks.shape[axis], count[axis]));
    }
    return taps;
  };
  const std::array<std::vector<Taps<2>>, 2> columns{ tapsAlong(0, 0.25), tapsAlong(0, 0.75) }; // by a row's parity
  const std::vector<Taps<2>> rows = tapsAlong(1, 0.5);
  const std::vector<Taps<2>> slices = tapsAlong(2, 0.5);
  ForEachInBlocks(size[2], 1, [&](std::size_t k) {
    for (std::size_t j = 0; j < size[1]; ++j)
    {
      const std::vector<float> sharesOfRow = InterpolateRow(mask, rows[j], slices[k]);
      if (*std::max_element(sharesOfRow.begin(), sharesOfRow.end()) <= 0.0f)
      {
        continue;
      }
      const auto parity = itk::FCCLattice::Parity(region.GetIndex(1) + static_cast<itk::IndexValueType>(j),
                                                  region.GetIndex(2) + static_cast<itk::IndexValueType>(k));
      TPixel * const samples = image.GetBufferPointer() + size[0] * (j + size[1] * k);
      for (std::size_t i = 0; i < size[0]; ++i)
      {
        const float share = InterpolateInRow(sharesOfRow, columns[static_cast<std::size_t>(parity)][i]);
        if (share > 0.0f)
        {
          const double limit = std::clamp(isovalue + (static_cast<double>(share) - 0.5) * height,
                                          static_cast<double>(std::numeric_limits<TPixel>::lowest()),
                                          static_cast<double>(std::numeric_limits<TPixel>::max()));
          const auto value = static_cast<double>(samples[i]);
          samples[i] = static_cast<TPixel>(height > 0.0 ? std::max(value, limit) : std::min(value, limit));
        }
      }
    }
  });
}

} // namespace rhombic

#endif
