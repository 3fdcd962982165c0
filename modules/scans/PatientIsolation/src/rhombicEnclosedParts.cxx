#include "rhombicEnclosedParts.h"

#include "rhombicLatticeBlocks.h"

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

constexpr double smallestShare = 1.0 / 50.0; // volume of the smallest part kept, relative to the largest part
constexpr double largestOpening = 0.1;       // largest share of a body part's faces next to air around the body
constexpr double nearSide = 1.25; // lattice units: surfaces end at the scan's border, less than one from the extent's

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
  const Components components = FindTriangleSurfaceComponents(*apart, false);
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
      const auto duplicator = itk::ImageDuplicator<std::decay_t<decltype(*image)>>::New();
      duplicator->SetInputImage(image);
      duplicator->Update();
      MoveFromAir(*duplicator->GetOutput(), blocks, *cutOff, threshold.isovalue);
      const double whole = itk::ComputeTriangleSurfaceVolume(*surface);
      surface = extract(itk::SmartPointer(duplicator->GetOutput()));
      const double kept = itk::ComputeTriangleSurfaceVolume(*surface);
      EnclosedParts parts = KeepParts(*surface, *image, blocks, true);
      parts.aroundBody = (whole - kept) / 1000.0;
      return parts;
    },
    volume);
}

} // namespace rhombic
