#include "rhombicBodyFilling.h"

#include "rhombicLatticeBlocks.h"

#include "itkImageDuplicator.h"

namespace rhombic
{
namespace
{

constexpr double highestFoam = -880.0; // HU: mattresses of foam are below it, lungs without emphysema above

} // namespace

FCCVolume
FillBody(const FCCVolume & volume, double isovalue, double depth)
{
  return std::visit(
    [=](const auto & image) -> FCCVolume {
      const auto duplicator = itk::ImageDuplicator<std::decay_t<decltype(*image)>>::New();
      duplicator->SetInputImage(image);
      duplicator->Update();
      const auto filled = duplicator->GetOutput();
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
      return itk::SmartPointer(filled);
    },
    volume);
}

} // namespace rhombic
