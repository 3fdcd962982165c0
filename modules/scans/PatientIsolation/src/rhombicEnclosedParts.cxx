#include "rhombicEnclosedParts.h"

#include "rhombicBlockGrid.h"

#include "itkFCCImage.h"
#include "itkImageDuplicator.h"
#include "itkTriangleSurfaceTopology.h"
#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace rhombic
{
namespace
{

constexpr double gridBlockWidth = 4.0;                 // mm
constexpr double unitsPerIndex[3] = { 2.0, 1.0, 1.0 }; // lattice units between the samples along each axis

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
MaskImage::Pointer
MakeInsideMask(const LatticeBlocks & blocks, const Threshold & threshold)
{
  const float * const means = blocks.mean->GetBufferPointer();
  return MakeMask(*blocks.mean, [=](std::size_t offset) { return threshold.IsInside(means[offset]); });
}

/** The connected parts of a mask that reach an edge of the scan along the patient, or, if \a takesSides, one of the
 * four sides between these edges where a ball of radius ballRadius has room. */
MaskImage::Pointer
FindPartsAtSides(const MaskImage & mask, unsigned int longAxis, bool takesSides)
{
  const auto & size = mask.GetBufferedRegion().GetSize();
  constexpr double room = ballRadius + 0.5 * gridBlockWidth; // to the centre of the nearest block outside the mask
  const auto depth = DistanceTo(*Complement(mask), 2.0 * room);
  return MaskOfPartsWith(FindMaskComponents(mask, false), [&](const itk::Index<3> & index, std::size_t offset) {
    unsigned int sides = 0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto last = static_cast<itk::IndexValueType>(size[axis]) - 1;
      sides += axis != longAxis && (index[axis] == 0 || index[axis] == last) ? 1 : 0;
    }
    const bool hasRoom = takesSides && static_cast<double>(depth->GetBufferPointer()[offset]) > room;
    return sides == 2 || (sides == 1 && hasRoom);
  });
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

/** The blocks of air around the body: those inside the threshold \a air, as far as they are connected to an edge of the
 * scan along the patient. For thresholds in HU (below 0), \a air's isovalue is replaced by \a highest, in HU, so that
 * lungs are no air, and parts count that reach a side between these edges where a ball of 8 mm radius has room. */
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

constexpr double smallestShare = 1.0 / 50.0; // volume of the smallest part kept, relative to the largest part
constexpr double largestOpening = 0.1;       // largest share of a body part's faces next to air around the body
constexpr double nearSide = 1.25; // lattice units: surfaces end at the scan's border, less than one from the extent's

template <typename TImage>
typename TImage::Pointer
CopyOf(const TImage & image)
{
  const auto duplicator = itk::ImageDuplicator<TImage>::New();
  duplicator->SetInputImage(&image);
  duplicator->Update();
  return duplicator->GetOutput();
}

/** The border of a connected part of a mask, counted in faces of blocks. */
struct Border
{
  std::size_t faces = 0;
  std::size_t open = 0;       ///< faces next to air around the body
  std::size_t openToRoom = 0; ///< open faces that are not near padding: next to air that was measured
  bool isDeep = false;        ///< whether all neighbours of a block belong to the part; not so in clefts

  /** Whether the part belongs to the body, but is open to the air around it. */
  bool
  IsOpenLung() const
  {
    return open > 0 && isDeep && static_cast<double>(openToRoom) <= largestOpening * static_cast<double>(faces);
  }
};

/** Measures the borders of the components of the mask \a apart.
 * \param margin distance in mm from a block to the farthest one that touches it */
std::vector<Border>
MeasureBorders(const Components & components,
               const MaskImage & apart,
               const MaskImage & inside,
               const LatticeBlocks & blocks,
               double margin)
{
  const std::uint8_t * const isAround = blocks.around->GetBufferPointer();
  const std::uint8_t * const isUniform = blocks.isUniform->GetBufferPointer();
  const auto padding =
    MakeMask(apart, [=](std::size_t offset) { return isAround[offset] != 0 && isUniform[offset] != 0; });
  const auto toPadding = DistanceTo(*padding, 3.0 * margin);
  const auto notApart = Complement(apart);
  const auto & size = apart.GetBufferedRegion().GetSize();
  std::vector<Border> borders(components.parts.size());
  ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t offset) {
    const std::uint32_t label = components.labels->GetBufferPointer()[offset];
    if (label == 0)
    {
      return;
    }
    Border & border = borders[label];
    border.isDeep = border.isDeep || !IsNear(*notApart, offset);
    border.faces += 6;
    ForEachFaceNeighbour(size, index, offset, [&](std::size_t neighbour) {
      if (apart.GetBufferPointer()[neighbour] != 0)
      {
        --border.faces;
      }
      else if (inside.GetBufferPointer()[neighbour] != 0)
      {
        const bool isPadding = toPadding->GetBufferPointer()[neighbour] <= 2.0 * margin;
        ++border.open;
        border.openToRoom += isPadding ? 0 : 1;
      }
    });
  });
  return borders;
}

/** Finds parts in the body that are open to the air around it: lungs that touch the border of a round field of view, or
 * are connected with it through the nose. Returns the blocks to cut off; null if there is no such part. */
MaskImage::Pointer
FindCutOff(const LatticeBlocks & blocks, const MaskImage & inside)
{
  const double margin = inside.GetSpacing().GetNorm();
  const auto marginAsFloat = static_cast<float>(margin);
  const auto toAround = DistanceTo(*blocks.around, 2.0 * margin);
  const float * const distances = toAround->GetBufferPointer();
  const std::uint8_t * const isInside = inside.GetBufferPointer();
  const auto apart =
    MakeMask(inside, [=](std::size_t offset) { return isInside[offset] != 0 && distances[offset] > marginAsFloat; });
  if (!HasBorder(*apart))
  {
    return nullptr;
  }
  const Components components = FindMaskComponents(*apart, false);
  const std::vector<Border> borders = MeasureBorders(components, *apart, inside, blocks, margin);
  const auto lungs = MaskOfParts(components, [&](std::size_t label) { return borders[label].IsOpenLung(); });
  if (!HasBorder(*lungs))
  {
    return nullptr;
  }
  const auto toLungs = DistanceTo(*lungs, 2.0 * margin);
  const std::uint32_t * const labels = components.labels->GetBufferPointer();
  return MakeMask(inside, [&](std::size_t offset) {
    const Border & border = borders[labels[offset]];
    const bool isAround = blocks.around->GetBufferPointer()[offset] != 0;
    const bool isBeside = distances[offset] <= marginAsFloat && toLungs->GetBufferPointer()[offset] > marginAsFloat;
    return isAround || isBeside || (border.open > 0 && !border.IsOpenLung());
  });
}

/** A connected part of a surface. */
struct SurfacePart
{
  double millilitres = 0.0; ///< volume; negative for cavities of other parts
  bool isAround = false;    ///< lies around the body
  bool isCut = false;       ///< ends at a side of the scan
};

template <typename TPixel>
std::vector<SurfacePart>
MeasureParts(const itk::TriangleSurface & surface,
             const itk::TriangleSurfaceComponents & components,
             const itk::FCCImage<TPixel> & image,
             const LatticeBlocks & blocks,
             bool isCutOff)
{
  const unsigned int longAxis = NearestAxis(image.GetDirection(), 2);
  const auto & count = blocks.around->GetBufferedRegion().GetSize();
  const auto & region = image.GetLargestPossibleRegion();
  std::vector<SurfacePart> parts(components.count);
  for (std::size_t n = 0; n < components.ofPoint.size(); ++n)
  {
    const auto & p = surface.GetPoints()[n];
    itk::Point<double, 3> point;
    std::copy(p.begin(), p.end(), point.Begin());
    const auto coordinates = image.TransformPhysicalPointToLattice(point);
    SurfacePart & part = parts[components.ofPoint[n]];
    itk::Index<3> index;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double begin = unitsPerIndex[axis] * static_cast<double>(region.GetIndex(axis)) - 0.5;
      const double length = unitsPerIndex[axis] * static_cast<double>(region.GetSize(axis));
      const double position = coordinates[axis] - begin;
      part.isCut = part.isCut || (axis != longAxis && (position < nearSide || position > length - nearSide));
      const double block = position / (unitsPerIndex[axis] * static_cast<double>(blocks.shape[axis]));
      index[axis] = static_cast<itk::IndexValueType>(std::clamp(block, 0.0, static_cast<double>(count[axis]) - 1.0));
    }
    part.isAround = part.isAround || (!isCutOff && blocks.around->GetPixel(index) != 0);
  }
  const auto volumes = itk::ComputeTriangleSurfaceComponentVolumes(surface, components);
  for (std::size_t n = 0; n < parts.size(); ++n)
  {
    parts[n].millilitres = volumes[n] / 1000.0;
  }
  return parts;
}

/** Keeps the parts that are in the body, and returns the volumes left out.
 * \param isCutOff whether the surface was extracted without the air around the body */
template <typename TPixel>
EnclosedParts
KeepParts(itk::TriangleSurface & surface,
          const itk::FCCImage<TPixel> & image,
          const LatticeBlocks & blocks,
          bool isCutOff)
{
  const auto components = itk::FindTriangleSurfaceComponents(surface);
  const auto parts = MeasureParts(surface, components, image, blocks, isCutOff);
  double largest = 0.0;
  for (const SurfacePart & part : parts)
  {
    largest = part.isAround ? largest : std::max(largest, part.millilitres);
  }
  EnclosedParts enclosed;
  std::vector<bool> keep;
  for (const SurfacePart & part : parts)
  {
    const bool isEnclosed = !part.isAround && part.millilitres > 0.0;
    const bool isSmall = part.millilitres < smallestShare * largest;
    keep.push_back(isEnclosed && !isSmall);
    enclosed.aroundBody += part.isAround ? part.millilitres : 0.0;
    enclosed.numberOfSmall += isEnclosed && isSmall ? 1 : 0;
    enclosed.small += isEnclosed && isSmall ? part.millilitres : 0.0;
    enclosed.numberCutBySides += keep.back() && part.isCut ? 1 : 0;
  }
  itk::KeepTriangleSurfaceComponents(surface, components, keep);
  return enclosed;
}

constexpr double highestFoam = -880.0; // HU: mattresses of foam are below it, lungs without emphysema above

} // namespace

EnclosedParts
KeepEnclosedParts(itk::TriangleSurface::Pointer & surface,
                  const FCCVolume & volume,
                  const Threshold & threshold,
                  const SurfaceExtractor & extract)
{
  return std::visit(
    [&](const auto & image) {
      const LatticeBlocks blocks = FindSurroundings(*image, threshold);
      const auto cutOff =
        HasBorder(*blocks.around) ? FindCutOff(blocks, *MakeInsideMask(blocks, threshold)) : MaskImage::Pointer();
      if (!cutOff)
      {
        return KeepParts(*surface, *image, blocks, false);
      }
      const auto opened = CopyOf(*image);
      MoveFromAir(*opened, blocks, *cutOff, threshold.isovalue);
      const double whole = itk::ComputeTriangleSurfaceVolume(*surface);
      surface = extract(opened);
      const double kept = itk::ComputeTriangleSurfaceVolume(*surface);
      EnclosedParts parts = KeepParts(*surface, *image, blocks, true);
      parts.aroundBody = (whole - kept) / 1000.0;
      return parts;
    },
    volume);
}

FCCVolume
FillBody(const FCCVolume & volume, double isovalue, double depth)
{
  return std::visit(
    [=](const auto & image) -> FCCVolume {
      const auto filled = CopyOf(*image);
      const LatticeBlocks blocks = FindSurroundings(*image, { isovalue, true }, highestFoam);
      if (HasBorder(*blocks.around))
      {
        // Blocks are filled up to half a block beside the mask.
        const auto toAround = DistanceTo(*blocks.around, 2.0 * depth);
        const float * const distances = toAround->GetBufferPointer();
        const auto deepest = static_cast<float>(depth + 0.5 * gridBlockWidth);
        const auto deep = MakeMask(*toAround, [=](std::size_t offset) { return distances[offset] > deepest; });
        MoveFromAir(*filled, blocks, *deep, isovalue);
      }
      return filled;
    },
    volume);
}

} // namespace rhombic
