#ifndef rhombicBlockGrid_h
#define rhombicBlockGrid_h

#include "rhombicForEachBlock.h"

#include "itkImage.h"
#include "itkSize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rhombic
{

/** \file
 * Masks, distances and connected parts on a grid of blocks of samples. A block is given by its index, or by its offset
 * in the buffer. */

using MaskImage = itk::Image<std::uint8_t, 3>; ///< 1 for the blocks in the mask, else 0
using DistanceImage = itk::Image<float, 3>;    ///< mm
using LabelImage = itk::Image<std::uint32_t, 3>;

constexpr double ballRadius = 8.0;    ///< mm: balls of this size fit around a patient, but not into clefts of the body
constexpr double highestAir = -940.0; ///< HU: largest mean or median of air; lungs without emphysema are above it

/** The image axis nearest to an axis of the patient (0 leads to the left, 1 to the back, 2 to the head), other than
 * \a except. */
unsigned int
NearestAxis(const itk::ImageBase<3>::DirectionType & direction, unsigned int patientAxis, unsigned int except = 3);

/** An image of a grid's size and geometry, filled with zeros. */
template <typename TImage>
typename TImage::Pointer
MakeLike(const itk::ImageBase<3> & grid)
{
  const auto image = TImage::New();
  image->CopyInformation(&grid);
  image->SetRegions(grid.GetLargestPossibleRegion());
  image->Allocate(true);
  return image;
}

/** The mask of a grid's blocks for which isIn(offset) is true. */
template <typename TFunction>
MaskImage::Pointer
MakeMask(const itk::ImageBase<3> & grid, const TFunction & isIn)
{
  const auto mask = MakeLike<MaskImage>(grid);
  std::uint8_t * const values = mask->GetBufferPointer();
  const std::size_t count = mask->GetBufferedRegion().GetNumberOfPixels();
  for (std::size_t offset = 0; offset < count; ++offset)
  {
    values[offset] = isIn(offset) ? 1 : 0;
  }
  return mask;
}

/** The blocks that are not in the mask. */
inline MaskImage::Pointer
Complement(const MaskImage & mask)
{
  return MakeMask(mask, [&](std::size_t offset) { return mask.GetBufferPointer()[offset] == 0; });
}

/** Whether some blocks are in the mask, and some are not. */
bool
HasBorder(const MaskImage & mask);

/** Calls function(index, offset) for each block, in the buffer's order. */
template <typename TFunction>
void
ForEachIndex(const itk::Size<3> & size, const TFunction & function)
{
  std::size_t offset = 0;
  itk::Index<3> index;
  for (index[2] = 0; index[2] < static_cast<itk::IndexValueType>(size[2]); ++index[2])
  {
    for (index[1] = 0; index[1] < static_cast<itk::IndexValueType>(size[1]); ++index[1])
    {
      for (index[0] = 0; index[0] < static_cast<itk::IndexValueType>(size[0]); ++index[0])
      {
        function(index, offset++);
      }
    }
  }
}

/** Calls function(offset) for each of the up to six blocks that share a face with a block. */
template <typename TFunction>
void
ForEachFaceNeighbour(const itk::Size<3> & size,
                     const itk::Index<3> & index,
                     std::size_t offset,
                     const TFunction & function)
{
  std::size_t step = 1;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (index[axis] > 0)
    {
      function(offset - step);
    }
    if (index[axis] + 1 < static_cast<itk::IndexValueType>(size[axis]))
    {
      function(offset + step);
    }
    step *= size[axis];
  }
}

/** Whether a block or one of its 26 neighbours is in the mask. */
bool
IsNear(const MaskImage & mask, std::size_t offset);

/** The distance in mm of each block's centre from the nearest one in the mask: 0 in the mask, at most \a reach. */
DistanceImage::Pointer
DistanceTo(const MaskImage & mask, double reach);

/** A connected part of a mask. */
struct Component
{
  std::size_t count = 0;
  itk::Index<3> lowest; ///< corners of its bounding box
  itk::Index<3> highest;
};

/** The connected parts of a mask. */
struct Components
{
  LabelImage::Pointer labels;   ///< from 1; 0 outside
  std::vector<Component> parts; ///< by label; the first one, for the outside, is empty
};

/** Parts connected by faces, or also by edges and corners. */
Components
FindMaskComponents(const MaskImage & mask, bool isFullyConnected);

/** The mask of the components for which isIn(label) is true; the outside has label 0. */
template <typename TFunction>
MaskImage::Pointer
MaskOfParts(const Components & components, const TFunction & isIn)
{
  std::vector<bool> isLabelIn;
  for (std::size_t label = 0; label < components.parts.size(); ++label)
  {
    isLabelIn.push_back(label != 0 && isIn(label));
  }
  const std::uint32_t * const labels = components.labels->GetBufferPointer();
  return MakeMask(*components.labels, [&](std::size_t offset) { return isLabelIn[labels[offset]]; });
}

/** The mask of the components of which a block, by its index and offset, isSeed(index, offset). */
template <typename TFunction>
MaskImage::Pointer
MaskOfPartsWith(const Components & components, const TFunction & isSeed)
{
  std::vector<bool> hasSeed(components.parts.size(), false);
  const std::uint32_t * const labels = components.labels->GetBufferPointer();
  ForEachIndex(components.labels->GetBufferedRegion().GetSize(), [&](const itk::Index<3> & index, std::size_t offset) {
    hasSeed[labels[offset]] = hasSeed[labels[offset]] || (labels[offset] != 0 && isSeed(index, offset));
  });
  return MaskOfParts(components, [&](std::size_t label) { return hasSeed[label]; });
}

/** \file
 * From the samples of an image to blocks of them, and back by interpolation. Blocks at the far sides may have fewer
 * samples than others. */

/** Samples of a block along each axis. */
using BlockShape = std::array<std::size_t, 3>;

/** Summarizes the samples of each block: calls add(sums, value) for each sample, in the buffer's order, then
 * store(offset of the block, sums, number of samples). The sums begin as TSums(). Slices of blocks are worked on in
 * parallel. */
template <typename TSums, typename TImage, typename TAdd, typename TStore>
void
SumBlocks(const TImage & image,
          const BlockShape & shape,
          const itk::Size<3> & blocks,
          const TAdd & add,
          const TStore & store)
{
  const auto & size = image.GetBufferedRegion().GetSize();
  const auto beginOf = [&](unsigned int axis, std::size_t block) { return block * shape[axis]; };
  const auto endOf = [&](unsigned int axis, std::size_t block) {
    return std::min<std::size_t>((block + 1) * shape[axis], size[axis]);
  };
  ForEachInBlocks(blocks[2], 1, [&](std::size_t slice) {
    for (std::size_t row = 0; row < blocks[1]; ++row)
    {
      std::vector<TSums> sums(blocks[0]);
      for (std::size_t k = beginOf(2, slice); k < endOf(2, slice); ++k)
      {
        for (std::size_t j = beginOf(1, row); j < endOf(1, row); ++j)
        {
          const auto * const samples = image.GetBufferPointer() + size[0] * (j + size[1] * k);
          for (std::size_t column = 0; column < blocks[0]; ++column)
          {
            TSums sum = sums[column];
            const std::size_t end = endOf(0, column);
            for (std::size_t i = beginOf(0, column); i < end; ++i)
            {
              add(sum, samples[i]);
            }
            sums[column] = sum;
          }
        }
      }
      const std::size_t perColumn = (endOf(1, row) - beginOf(1, row)) * (endOf(2, slice) - beginOf(2, slice));
      for (std::size_t column = 0; column < blocks[0]; ++column)
      {
        store(column + blocks[0] * (row + blocks[1] * slice),
              sums[column],
              (endOf(0, column) - beginOf(0, column)) * perColumn);
      }
    }
  });
}

/** The blocks next to a sample along one axis, and their weights. */
template <std::size_t VCount>
struct Taps
{
  std::array<std::size_t, VCount> blocks;
  std::array<float, VCount> weights;
};

/** Linear interpolation, constant beyond the outer blocks' centres.
 * \param position in samples, from the outer face of the first one */
inline Taps<2>
LinearTaps(double position, std::size_t samplesPerBlock, std::size_t blocks)
{
  const double last = static_cast<double>(blocks - 1);
  const double block = std::clamp(position / static_cast<double>(samplesPerBlock) - 0.5, 0.0, last);
  const auto first = static_cast<std::size_t>(block);
  const auto share = static_cast<float>(block - std::floor(block));
  return { { first, std::min(first + 1, blocks - 1) }, { 1.0f - share, share } };
}

/** The weights of a quadratic B-spline, which smooths the steps of distances to masks. */
inline Taps<3>
QuadraticTaps(std::size_t sample, std::size_t samplesPerBlock, std::size_t blocks)
{
  const std::size_t block = sample / samplesPerBlock;
  const double offset =
    (static_cast<double>(sample) + 0.5) / static_cast<double>(samplesPerBlock) - static_cast<double>(block) - 0.5;
  return { { block == 0 ? 0 : block - 1, block, std::min(block + 1, blocks - 1) },
           { static_cast<float>(0.5 * (0.5 - offset) * (0.5 - offset)),
             static_cast<float>(0.75 - offset * offset),
             static_cast<float>(0.5 * (0.5 + offset) * (0.5 + offset)) } };
}

/** The values of a field of blocks at a row of samples, for each block along the row. */
template <typename TImage, std::size_t VCount>
std::vector<float>
InterpolateRow(const TImage & field, const Taps<VCount> & rows, const Taps<VCount> & slices)
{
  const auto & blocks = field.GetBufferedRegion().GetSize();
  std::vector<float> values(blocks[0], 0.0f);
  for (std::size_t k = 0; k < VCount; ++k)
  {
    for (std::size_t j = 0; j < VCount; ++j)
    {
      const float weight = slices.weights[k] * rows.weights[j];
      const auto * const row = field.GetBufferPointer() + blocks[0] * (rows.blocks[j] + blocks[1] * slices.blocks[k]);
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        values[i] += weight * static_cast<float>(row[i]);
      }
    }
  }
  return values;
}

/** The value at a sample of what InterpolateRow() returned. */
template <std::size_t VCount>
float
InterpolateInRow(const std::vector<float> & values, const Taps<VCount> & columns)
{
  float value = 0.0f;
  for (std::size_t n = 0; n < VCount; ++n)
  {
    value += columns.weights[n] * values[columns.blocks[n]];
  }
  return value;
}

} // namespace rhombic

#endif
