#ifndef rhombicBlockGrid_h
#define rhombicBlockGrid_h

#include "itkImage.h"

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
FindTriangleSurfaceComponents(const MaskImage & mask, bool isFullyConnected);

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

} // namespace rhombic

#endif
