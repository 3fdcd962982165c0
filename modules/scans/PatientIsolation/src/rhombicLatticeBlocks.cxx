#include "rhombicLatticeBlocks.h"

namespace rhombic
{
namespace
{

/** The connected parts of a mask that reach an edge of the scan along the patient, or, if \a takesSides, one of the
 * four sides between these edges where a ball of radius ballRadius has room. */
MaskImage::Pointer
FindPartsAtSides(const MaskImage & mask, unsigned int longAxis, bool takesSides)
{
  const Components components = FindTriangleSurfaceComponents(mask, false);
  const std::uint32_t * const labels = components.labels->GetBufferPointer();
  const auto & size = mask.GetBufferedRegion().GetSize();
  constexpr double room = ballRadius + 0.5 * gridBlockWidth; // to the centre of the nearest block outside the mask
  const auto depth = DistanceTo(*Complement(mask), 2.0 * room);
  std::vector<bool> isFound(components.parts.size(), false);
  ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t offset) {
    unsigned int sides = 0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto last = static_cast<itk::IndexValueType>(size[axis]) - 1;
      sides += axis != longAxis && (index[axis] == 0 || index[axis] == last) ? 1 : 0;
    }
    const bool hasRoom = takesSides && static_cast<double>(depth->GetBufferPointer()[offset]) > room;
    if (sides == 2 || (sides == 1 && hasRoom))
    {
      isFound[labels[offset]] = true;
    }
  });
  return MaskOfParts(components, [&](std::size_t label) { return isFound[label]; });
}

/** The limit, in HU, below which values may be air around the body. It is higher for scans whose lowest values are
 * high, because they were clipped or their air was calibrated to a higher value. */
double
HighestAirAround(const LatticeBlocks & blocks, double isovalue, double highest)
{
  constexpr double airRange = 60.0;     // HU: air around the body varies by less from its lowest value
  constexpr double lowestLung = -860.0; // HU: mean of lungs without emphysema
  const float * const begin = blocks.mean->GetBufferPointer();
  const double lowest = *std::min_element(begin, begin + blocks.mean->GetBufferedRegion().GetNumberOfPixels());
  return std::min(isovalue, std::max(highest, std::min(lowest + airRange, lowestLung)));
}

} // namespace

MaskImage::Pointer
FindAirAround(const LatticeBlocks & blocks,
              const Threshold & air,
              double highest,
              const itk::ImageBase<3>::DirectionType & direction)
{
  const bool isHounsfield = air.insideIsBelow && air.isovalue < 0.0;
  Threshold limit = air;
  limit.isovalue = isHounsfield ? HighestAirAround(blocks, air.isovalue, highest) : air.isovalue;
  return FindPartsAtSides(*MakeInsideMask(blocks, limit), NearestAxis(direction, 2), isHounsfield);
}

/** The mean of the blocks around the body. */
double
MeanAround(const LatticeBlocks & blocks)
{
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t offset = 0; offset < blocks.around->GetBufferedRegion().GetNumberOfPixels(); ++offset)
  {
    if (blocks.around->GetBufferPointer()[offset] != 0)
    {
      sum += static_cast<double>(blocks.mean->GetBufferPointer()[offset]);
      ++count;
    }
  }
  return sum / static_cast<double>(count);
}

} // namespace rhombic
