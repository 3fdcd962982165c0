#ifndef rhombicCoarseScan_h
#define rhombicCoarseScan_h

#include "rhombicScan.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace rhombic
{

using MaskImage = itk::Image<std::uint8_t, 3>;
using MeanImage = itk::Image<std::int16_t, 3>;
using DistanceImage = itk::Image<float, 3>;
constexpr double closedGap = 8.0;     ///< mm: what is around the patient takes balls of this radius
constexpr double highestAir = -940.0; ///< HU: a mean or median of air; lungs without emphysema are higher

using ComponentImage = itk::Image<std::uint32_t, 3>;

/** A scan in blocks of whole samples that are about 2 mm wide. Blocks at the far sides may hold fewer samples. */
struct CoarseScan
{
  std::array<std::size_t, 3> samplesPerBlock{};
  MaskImage::Pointer occupancy; ///< the share of a block's samples that are tissue, from 0: none to 255: all
  MaskImage::Pointer hardness;  ///< the share that is harder than skin
  MeanImage::Pointer mean;      ///< of a block's samples
  std::vector<itk::Vector<double, 3>> sliceOffsets; ///< from where the images say a slice is to its place; may be empty

  /** Of a block's centre, in LPS mm. */
  itk::Point<double, 3>
  PointOf(const itk::Index<3> & index) const;

  std::size_t
  NumberOfBlocks() const
  {
    return occupancy->GetBufferedRegion().GetNumberOfPixels();
  }
};

/** \a tissue and \a hard are the lowest values of what counts as such. */
CoarseScan
MakeCoarseScan(const Scan & scan, double tissue, double hard);

/** An image of a coarse scan's size and place, filled with zeros. */
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

/** A mask of those of a grid's voxels, by their number in the buffer, for which the function is true. */
template <typename TFunction>
MaskImage::Pointer
MakeMask(const itk::ImageBase<3> & grid, const TFunction & isIn)
{
  const auto mask = MakeLike<MaskImage>(grid);
  std::uint8_t * const values = mask->GetBufferPointer();
  const std::size_t count = mask->GetBufferedRegion().GetNumberOfPixels();
  for (std::size_t n = 0; n < count; ++n)
  {
    values[n] = isIn(n) ? 1 : 0;
  }
  return mask;
}

/** The distance in mm of voxels from those at the border of the mask, negative inside; the image's own sides are no
 * border. The mask must have a border. */
DistanceImage::Pointer
DistanceTo(const MaskImage & mask);

/** Whether some voxels are in the mask, and some are not. */
bool
HasBorder(const MaskImage & mask);

/** What is known about a connected part of a mask. */
struct Component
{
  std::size_t count = 0;
  itk::Index<3> lowest;
  itk::Index<3> highest;
};

/** The connected parts of a mask. */
struct Components
{
  ComponentImage::Pointer labels; ///< from 1; 0 outside
  std::vector<Component> parts;   ///< by label; the first is none
};

/** Connected by faces, or also by edges and corners. */
Components
FindComponents(const MaskImage & mask, bool isFullyConnected);

/** The space around what the distances are from: connected parts, which are to be accepted by the function, that balls
 * of the given radius in mm reach. */
struct OpenSpace
{
  Components balls;               ///< where the balls' centres can be
  std::vector<bool> reachesSides; ///< by label: a side of the scan along which the patient lies
};

/** Where balls of a radius in mm have room outside of what the distances are from. */
OpenSpace
FindOpenSpace(const DistanceImage & distance, double radius, unsigned int longAxis);

/** What balls of the radius fill whose centres are in those parts of the open space. Null if there is no such part. */
MaskImage::Pointer
FillOpenSpace(const OpenSpace & space, const std::vector<bool> & isPartIn, double radius);

/** Calls the function with each index and its place in the buffer, in the buffer's order. */
template <typename TFunction>
void
ForEachIndex(const itk::Size<3> & size, const TFunction & function)
{
  std::size_t n = 0;
  itk::Index<3> index;
  for (index[2] = 0; index[2] < static_cast<itk::IndexValueType>(size[2]); ++index[2])
  {
    for (index[1] = 0; index[1] < static_cast<itk::IndexValueType>(size[1]); ++index[1])
    {
      for (index[0] = 0; index[0] < static_cast<itk::IndexValueType>(size[0]); ++index[0])
      {
        function(index, n++);
      }
    }
  }
}

} // namespace rhombic

#endif
