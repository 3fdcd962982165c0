#include "rhombicEnclosedParts.h"

#include "rhombicCoarseScan.h"
#include "rhombicImageAxes.h"

#include "itkForEachBlock.h"
#include "itkTriangleSurfaceComponents.h"
#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rhombic
{
namespace
{

constexpr double blockWidth = 4.0;           // mm
constexpr double smallestShare = 1.0 / 50.0; // volume of the smallest part kept, relative to the largest part
constexpr double largestOpening = 0.1;       // share of a part's border open to the room; more is outside the body
constexpr double airRange = 60.0;            // HU: air around the body varies by less from its lowest value
constexpr double lowestLung = -860.0;        // HU: mean of lungs without emphysema
constexpr double lowestAir = -1100.0;        // HU: lower values are padding
constexpr double unitsPerIndex[3] = { 2.0, 1.0, 1.0 };

/** The values of a lattice in blocks of about 4 mm. */
struct LatticeBlocks
{
  std::array<std::size_t, 3> samplesPerBlock{};
  DistanceImage::Pointer mean;
  MaskImage::Pointer isUniform; ///< blocks whose values are all the same
};

/** Which blocks are inside by the threshold, but not in the body. */
struct Surroundings
{
  LatticeBlocks blocks;
  MaskImage::Pointer around; ///< the body
  MaskImage::Pointer cutOff; ///< what has to be cut off what is in the body, as no tissue lies between; else null
};

/** \class BlockFiller
 * \brief Fills a slice of blocks. */
template <typename TPixel>
class BlockFiller
{
public:
  BlockFiller(const itk::FCCImage<TPixel> & image, const LatticeBlocks & blocks, double lowest)
    : m_Image(image)
    , m_Blocks(blocks)
    , m_Lowest(lowest)
    , m_Size(image.GetBufferedRegion().GetSize())
    , m_Count(blocks.mean->GetBufferedRegion().GetSize())
  {}

  void
  Fill(std::size_t slice) const
  {
    for (std::size_t row = 0; row < m_Count[1]; ++row)
    {
      std::vector<Values> values(m_Count[0]);
      for (std::size_t k = slice * m_Blocks.samplesPerBlock[2]; k < this->EndOf(2, slice); ++k)
      {
        for (std::size_t j = row * m_Blocks.samplesPerBlock[1]; j < this->EndOf(1, row); ++j)
        {
          this->AddRow(m_Image.GetBufferPointer() + m_Size[0] * (j + m_Size[1] * k), values);
        }
      }
      const std::size_t first = m_Count[0] * (row + m_Count[1] * slice);
      for (std::size_t block = 0; block < m_Count[0]; ++block)
      {
        m_Blocks.mean->GetBufferPointer()[first + block] =
          static_cast<float>(values[block].sum / static_cast<double>(values[block].count));
        m_Blocks.isUniform->GetBufferPointer()[first + block] = values[block].lowest == values[block].highest ? 1 : 0;
      }
    }
  }

private:
  struct Values
  {
    std::size_t count = 0;
    double sum = 0.0;
    double lowest = std::numeric_limits<double>::max();
    double highest = std::numeric_limits<double>::lowest();
  };

  std::size_t
  EndOf(unsigned int axis, std::size_t block) const
  {
    return std::min<std::size_t>((block + 1) * m_Blocks.samplesPerBlock[axis], m_Size[axis]);
  }

  void
  AddRow(const TPixel * row, std::vector<Values> & values) const
  {
    for (std::size_t block = 0; block < m_Count[0]; ++block)
    {
      Values sums = values[block];
      for (std::size_t i = block * m_Blocks.samplesPerBlock[0]; i < this->EndOf(0, block); ++i)
      {
        ++sums.count;
        const double value = std::max(static_cast<double>(row[i]), m_Lowest);
        sums.sum += value;
        sums.lowest = std::min(sums.lowest, value);
        sums.highest = std::max(sums.highest, value);
      }
      values[block] = sums;
    }
  }

  const itk::FCCImage<TPixel> & m_Image;
  const LatticeBlocks & m_Blocks;
  double m_Lowest;
  itk::Size<3> m_Size;
  itk::Size<3> m_Count;
};

/** Means of blocks; values below \a lowest count as \a lowest. */
template <typename TPixel>
LatticeBlocks
MakeBlocks(const itk::FCCImage<TPixel> & image, double lowest)
{
  LatticeBlocks blocks;
  blocks.mean = DistanceImage::New();
  itk::Size<3> count;
  DistanceImage::SpacingType spacing;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double step = unitsPerIndex[axis] * image.GetSpacing()[axis];
    const auto samples = static_cast<std::size_t>(std::max(1l, std::lround(blockWidth / step)));
    blocks.samplesPerBlock[axis] = samples;
    count[axis] = (image.GetBufferedRegion().GetSize(axis) + samples - 1) / samples;
    spacing[axis] = step * static_cast<double>(samples);
  }
  blocks.mean->SetRegions(count);
  blocks.mean->SetSpacing(spacing);
  blocks.mean->Allocate();
  blocks.isUniform = MakeLike<MaskImage>(*blocks.mean);
  const BlockFiller<TPixel> filler(image, blocks, lowest);
  itk::ForEachInBlocks(count[2], 1, [&](std::size_t slice) { filler.Fill(slice); });
  return blocks;
}

/** The blocks with a mean below the limit, or at it and above. */
MaskImage::Pointer
MakeSideMask(const LatticeBlocks & blocks, bool isBelow, double limit)
{
  const float * const means = blocks.mean->GetBufferPointer();
  return MakeMask(*blocks.mean,
                  [=](std::size_t n) { return isBelow ? means[n] < limit : static_cast<double>(means[n]) >= limit; });
}

/** The connected parts of a mask that reach an edge of the scan along the patient, or, if that is asked for, a side
 * with room for a ball of the radius closedGap. */
MaskImage::Pointer
FindPartsAtSides(const MaskImage & mask, unsigned int longAxis, bool takesSides)
{
  const Components components = FindComponents(mask, false);
  const std::uint32_t * const labels = components.labels->GetBufferPointer();
  const auto & size = mask.GetBufferedRegion().GetSize();
  const auto depth = HasBorder(mask) ? DistanceTo(mask) : MakeLike<DistanceImage>(mask);
  std::vector<bool> isFound(components.parts.size(), false);
  ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t n) {
    unsigned int sides = 0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto last = static_cast<itk::IndexValueType>(size[axis]) - 1;
      sides += axis != longAxis && (index[axis] == 0 || index[axis] == last) ? 1 : 0;
    }
    const bool hasRoom = takesSides && static_cast<double>(depth->GetBufferPointer()[n]) < 0.5 * blockWidth - closedGap;
    if (labels[n] != 0 && (sides == 2 || (sides == 1 && hasRoom)))
    {
      isFound[labels[n]] = true;
    }
  });
  return MakeMask(mask, [&](std::size_t n) { return isFound[labels[n]]; });
}

/** What lies next to a connected part of a mask, in faces of blocks. */
struct Border
{
  std::size_t faces = 0;
  std::size_t open = 0;       ///< faces to air around the body, without tissue between
  std::size_t openToRoom = 0; ///< those of them that are not near padding, which was not measured
  bool isDeep = false;        ///< has a block all of whose neighbours belong to the part; clefts have none
};

/** \class OpeningFinder
 * \brief Finds the parts in the body that are open to the air around it: lungs that touch the border of a round field
 * of view, or that a nose in the scan leads to. */
class OpeningFinder
{
public:
  OpeningFinder(const LatticeBlocks & blocks, const MaskImage & around, const MaskImage & inside)
    : m_Blocks(blocks)
    , m_Around(around)
    , m_Inside(inside)
    , m_Margin(blocks.mean->GetSpacing().GetNorm())
  {}

  /** The blocks that are to be cut off; null if there is no such part. */
  MaskImage::Pointer
  Find() const
  {
    const float margin = static_cast<float>(m_Margin);
    const auto toAround = DistanceTo(m_Around);
    const float * const distances = toAround->GetBufferPointer();
    const std::uint8_t * const inside = m_Inside.GetBufferPointer();
    const auto apart = MakeMask(m_Around, [=](std::size_t n) { return inside[n] != 0 && distances[n] > margin; });
    if (!HasBorder(*apart))
    {
      return nullptr;
    }
    const Components components = FindComponents(*apart, false);
    const std::vector<Border> borders = this->MeasureBorders(components, *apart);
    const auto isOpen = [&](const Border & border) { return border.open > 0; };
    const auto isKept = [&](const Border & border) {
      return border.isDeep &&
             static_cast<double>(border.openToRoom) <= largestOpening * static_cast<double>(border.faces);
    };
    const std::uint32_t * const labels = components.labels->GetBufferPointer();
    const auto kept =
      MakeMask(*apart, [&](std::size_t n) { return isOpen(borders[labels[n]]) && isKept(borders[labels[n]]); });
    if (!HasBorder(*kept))
    {
      return nullptr;
    }
    const auto toKept = DistanceTo(*kept);
    return MakeMask(*apart, [&](std::size_t n) {
      const Border & border = borders[labels[n]];
      const bool isBeside = distances[n] <= margin && toKept->GetBufferPointer()[n] > margin;
      return m_Around.GetBufferPointer()[n] != 0 || isBeside || (isOpen(border) && !isKept(border));
    });
  }

private:
  std::vector<Border>
  MeasureBorders(const Components & components, const MaskImage & apart) const
  {
    const std::uint8_t * const uniform = m_Blocks.isUniform->GetBufferPointer();
    const auto padding =
      MakeMask(apart, [&](std::size_t n) { return m_Around.GetBufferPointer()[n] != 0 && uniform[n] != 0; });
    const DistanceImage::Pointer toPadding = HasBorder(*padding) ? DistanceTo(*padding) : nullptr;
    const auto depth = DistanceTo(apart);
    const auto & size = apart.GetBufferedRegion().GetSize();
    const itk::OffsetValueType * const steps = apart.GetOffsetTable();
    std::vector<Border> borders(components.parts.size());
    ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t n) {
      const std::uint32_t label = components.labels->GetBufferPointer()[n];
      if (label == 0)
      {
        return;
      }
      Border & border = borders[label];
      border.isDeep = border.isDeep || static_cast<double>(depth->GetBufferPointer()[n]) < -0.5 * blockWidth;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        for (const bool isForward : { false, true })
        {
          const auto last = static_cast<itk::IndexValueType>(size[axis]) - 1;
          const bool isSide = index[axis] == (isForward ? last : 0);
          const std::size_t other =
            isForward ? n + static_cast<std::size_t>(steps[axis]) : n - static_cast<std::size_t>(steps[axis]);
          if (isSide || apart.GetBufferPointer()[other] == 0)
          {
            const bool isOpen = !isSide && m_Inside.GetBufferPointer()[other] != 0;
            const bool isPadding = toPadding && toPadding->GetBufferPointer()[other] <= 2.0 * m_Margin;
            ++border.faces;
            border.open += isOpen ? 1 : 0;
            border.openToRoom += isOpen && !isPadding ? 1 : 0;
          }
        }
      }
    });
    return borders;
  }

  const LatticeBlocks & m_Blocks;
  const MaskImage & m_Around;
  const MaskImage & m_Inside;
  double m_Margin; ///< distance in mm from a block to the farthest one that touches it
};

/** The two blocks next to a place along one axis, and the share of the second one. */
struct Taps
{
  std::size_t first;
  std::size_t second;
  float share;
};

/** \param place in samples from the outer face of the first one */
Taps
TapsAt(double place, std::size_t samplesPerBlock, std::size_t count)
{
  const double last = static_cast<double>(count - 1);
  const double block = std::clamp(place / static_cast<double>(samplesPerBlock) - 0.5, 0.0, last);
  const auto first = static_cast<std::size_t>(block);
  return { first, std::min(first + 1, count - 1), static_cast<float>(block - std::floor(block)) };
}

/** \class LatticeCutter
 * \brief Lifts what is to be cut off over the isovalue, or lowers it below, by a smooth ramp, so that the surface that
 * arises where nothing was has no steps. */
template <typename TPixel>
class LatticeCutter
{
public:
  LatticeCutter(itk::FCCImage<TPixel> & image, const Surroundings & surroundings, double isovalue)
    : m_Image(image)
    , m_SamplesPerBlock(surroundings.blocks.samplesPerBlock)
    , m_CutOff(*surroundings.cutOff)
    , m_Size(image.GetBufferedRegion().GetSize())
    , m_Count(surroundings.cutOff->GetBufferedRegion().GetSize())
    , m_Isovalue(isovalue)
  {
    constexpr double steepness = 4.0; // rise of the ramp, relative to isovalue minus mean around the body
    double sum = 0.0;
    std::size_t blocks = 0;
    for (std::size_t n = 0; n < m_CutOff.GetBufferedRegion().GetNumberOfPixels(); ++n)
    {
      if (surroundings.around->GetBufferPointer()[n] != 0)
      {
        sum += static_cast<double>(surroundings.blocks.mean->GetBufferPointer()[n]);
        ++blocks;
      }
    }
    m_Height = steepness * (m_Isovalue - sum / static_cast<double>(blocks));
  }

  void
  CutSlice(std::size_t k) const
  {
    for (std::size_t j = 0; j < m_Size[1]; ++j)
    {
      const std::vector<float> shares = this->SharesOfRow(j, k);
      if (std::any_of(shares.begin(), shares.end(), [](float share) { return share > 0.0f; }))
      {
        this->CutRow(shares, j, k);
      }
    }
  }

private:
  /** Weight from 0 to 1 of each block along a row of samples: 1 is cut off. */
  std::vector<float>
  SharesOfRow(std::size_t j, std::size_t k) const
  {
    const Taps rows = TapsAt(static_cast<double>(j) + 0.5, m_SamplesPerBlock[1], m_Count[1]);
    const Taps slices = TapsAt(static_cast<double>(k) + 0.5, m_SamplesPerBlock[2], m_Count[2]);
    std::vector<float> shares(m_Count[0], 0.0f);
    for (const bool isNextSlice : { false, true })
    {
      for (const bool isNextRow : { false, true })
      {
        const std::size_t row = isNextRow ? rows.second : rows.first;
        const std::size_t slice = isNextSlice ? slices.second : slices.first;
        const float weight =
          (isNextRow ? rows.share : 1.0f - rows.share) * (isNextSlice ? slices.share : 1.0f - slices.share);
        const std::uint8_t * const blocks = m_CutOff.GetBufferPointer() + m_Count[0] * (row + m_Count[1] * slice);
        for (std::size_t block = 0; block < m_Count[0]; ++block)
        {
          shares[block] += weight * static_cast<float>(blocks[block]);
        }
      }
    }
    return shares;
  }

  void
  CutRow(const std::vector<float> & shares, std::size_t j, std::size_t k) const
  {
    const auto & index = m_Image.GetBufferedRegion().GetIndex();
    const auto parity = itk::FCCLattice::Parity(index[1] + static_cast<itk::IndexValueType>(j),
                                                index[2] + static_cast<itk::IndexValueType>(k));
    TPixel * const row = m_Image.GetBufferPointer() + m_Size[0] * (j + m_Size[1] * k);
    for (std::size_t i = 0; i < m_Size[0]; ++i)
    {
      const double place = static_cast<double>(i) + 0.25 + 0.5 * static_cast<double>(parity);
      const Taps taps = TapsAt(place, m_SamplesPerBlock[0], m_Count[0]);
      const float share = shares[taps.first] * (1.0f - taps.share) + shares[taps.second] * taps.share;
      if (share > 0.0f)
      {
        const double limit = std::clamp(m_Isovalue + (static_cast<double>(share) - 0.5) * m_Height,
                                        static_cast<double>(std::numeric_limits<TPixel>::lowest()),
                                        static_cast<double>(std::numeric_limits<TPixel>::max()));
        const auto value = static_cast<double>(row[i]);
        row[i] = static_cast<TPixel>(m_Height > 0.0 ? std::max(value, limit) : std::min(value, limit));
      }
    }
  }

  itk::FCCImage<TPixel> & m_Image;
  std::array<std::size_t, 3> m_SamplesPerBlock;
  const MaskImage & m_CutOff;
  itk::Size<3> m_Size;
  itk::Size<3> m_Count;
  double m_Isovalue;
  double m_Height; ///< rise of the values across the ramp; negative where inside is above the isovalue
};

/** What is known about a connected part of a surface. */
struct SurfacePart
{
  double millilitres = 0.0; ///< negative where another part is around it
  bool isAround = false;    ///< lies around the body
  bool isCut = false;       ///< ends at a side of the scan
};

template <typename TPixel>
std::vector<SurfacePart>
MeasureParts(const itk::TriangleSurface & surface,
             const itk::TriangleSurfaceComponents & components,
             const itk::FCCImage<TPixel> & image,
             const Surroundings & surroundings)
{
  const unsigned int longAxis = NearestAxis(image.GetDirection(), 2);
  const auto & samplesPerBlock = surroundings.blocks.samplesPerBlock;
  const auto & count = surroundings.around->GetBufferedRegion().GetSize();
  const auto & region = image.GetLargestPossibleRegion();
  constexpr double near =
    1.25; // lattice units: the scan's border, where surfaces end, is less than one from the extent's

  std::vector<SurfacePart> parts(components.count);
  for (std::size_t n = 0; n < components.ofPoint.size(); ++n)
  {
    const auto & p = surface.GetPoints()[n];
    itk::Point<double, 3> point;
    std::copy(p.begin(), p.end(), point.Begin());
    const auto coordinates = image.TransformPhysicalPointToLattice(point);
    SurfacePart & part = parts[components.ofPoint[n]];
    itk::Index<3> block;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double begin = unitsPerIndex[axis] * static_cast<double>(region.GetIndex(axis)) - 0.5;
      const double length = unitsPerIndex[axis] * static_cast<double>(region.GetSize(axis));
      const double place = coordinates[axis] - begin;
      part.isCut = part.isCut || (axis != longAxis && (place < near || place > length - near));
      const double blocks = place / (unitsPerIndex[axis] * static_cast<double>(samplesPerBlock[axis]));
      block[axis] = static_cast<itk::IndexValueType>(std::clamp(blocks, 0.0, static_cast<double>(count[axis]) - 1.0));
    }
    part.isAround = part.isAround || (!surroundings.cutOff && surroundings.around->GetPixel(block) != 0);
  }
  const auto volumes = itk::ComputeComponentVolumes(surface, components);
  for (std::size_t n = 0; n < parts.size(); ++n)
  {
    parts[n].millilitres = volumes[n] / 1000.0;
  }
  return parts;
}

/** Values below this may be air around the body, in HU. Scans that were clipped at a value above -940 HU, or whose air
 * is calibrated to one, have their lowest values there. */
double
HighestAirAround(const DistanceImage & means, double isovalue)
{
  const float * const begin = means.GetBufferPointer();
  const double lowest = *std::min_element(begin, begin + means.GetBufferedRegion().GetNumberOfPixels());
  return std::min(isovalue, std::max(highestAir, std::min(lowest + airRange, lowestLung)));
}

Surroundings
FindSurroundings(const FCCVolume & volume, const Threshold & threshold)
{
  const double isovalue = threshold.isovalue;
  const bool isBelow = threshold.insideIsBelow;
  const bool isHounsfield = isBelow && isovalue < 0.0;
  Surroundings found;
  const double lowest = isHounsfield ? lowestAir : std::numeric_limits<double>::lowest();
  found.blocks = std::visit([=](const auto & image) { return MakeBlocks(*image, lowest); }, volume);
  const auto direction = std::visit([](const auto & image) { return image->GetDirection(); }, volume);
  const auto air =
    MakeSideMask(found.blocks, isBelow, isHounsfield ? HighestAirAround(*found.blocks.mean, isovalue) : isovalue);
  found.around = FindPartsAtSides(*air, NearestAxis(direction, 2), isHounsfield);
  if (HasBorder(*found.around))
  {
    const auto inside = MakeSideMask(found.blocks, isBelow, isovalue);
    found.cutOff = OpeningFinder(found.blocks, *found.around, *inside).Find();
  }
  return found;
}

/** A copy of the volume in which what is to be cut off is on the other side of the isovalue. */
FCCVolume
CutOff(const FCCVolume & volume, const Surroundings & surroundings, double isovalue)
{
  return std::visit(
    [&](const auto & image) -> FCCVolume {
      using ImageType = typename std::decay_t<decltype(*image)>;
      const auto cut = ImageType::New();
      cut->CopyInformation(image);
      cut->SetRegions(image->GetBufferedRegion());
      cut->Allocate();
      const auto & region = image->GetBufferedRegion();
      std::copy_n(image->GetBufferPointer(), region.GetNumberOfPixels(), cut->GetBufferPointer());
      const LatticeCutter<typename ImageType::PixelType> cutter(*cut, surroundings, isovalue);
      itk::ForEachInBlocks(region.GetSize(2), 1, [&](std::size_t slice) { cutter.CutSlice(slice); });
      return cut;
    },
    volume);
}

/** Keeps the parts of a surface that are in the body, and tells what it leaves out. */
EnclosedParts
KeepParts(itk::TriangleSurface & surface, const FCCVolume & volume, const Surroundings & surroundings)
{
  const auto components = itk::FindComponents(surface);
  const auto parts =
    std::visit([&](const auto & image) { return MeasureParts(surface, components, *image, surroundings); }, volume);
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
  itk::KeepComponents(surface, components, keep);
  return enclosed;
}

} // namespace

EnclosedParts
KeepEnclosedParts(itk::TriangleSurface::Pointer & surface,
                  const FCCVolume & volume,
                  const Threshold & threshold,
                  const SurfaceExtractor & extract)
{
  const Surroundings surroundings = FindSurroundings(volume, threshold);
  if (!surroundings.cutOff)
  {
    return KeepParts(*surface, volume, surroundings);
  }
  const double whole = itk::ComputeVolume(*surface);
  surface = extract(CutOff(volume, surroundings, threshold.isovalue));
  const double kept = itk::ComputeVolume(*surface);
  EnclosedParts parts = KeepParts(*surface, volume, surroundings);
  parts.aroundBody = (whole - kept) / 1000.0;
  return parts;
}

} // namespace rhombic
