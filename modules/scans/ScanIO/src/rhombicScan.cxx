#include "rhombicScan.h"

#include "rhombicVolumeRefusal.h"
#include "rhombicVoxelGrid.h"
#include "rhombicWording.h"

#include <algorithm>
#include <iterator>

namespace rhombic
{

const itk::ImageBase<3> &
GeometryOf(const ScanImage & image)
{
  return std::visit([](const auto & pointer) -> const itk::ImageBase<3> & { return *pointer; }, image);
}

std::vector<ScanImage>
LayersOf(const Scan & scan)
{
  std::vector<ScanImage> layers{ scan.image };
  layers.insert(layers.end(), scan.furtherLayers.begin(), scan.furtherLayers.end());
  return layers;
}

std::string
PixelTypeName(const ScanImage & image)
{
  return std::visit(
    [](const auto & pointer) { return PixelTypeName<typename std::decay_t<decltype(*pointer)>::PixelType>(); }, image);
}

itk::IOComponentEnum
ComponentTypeOf(const ScanImage & image)
{
  using Component = itk::IOComponentEnum;
  constexpr Component types[] = {
    Component::UCHAR, Component::SHORT, Component::USHORT, Component::INT, Component::FLOAT
  };
  static_assert(std::variant_size_v<ScanImage> == std::size(types), "One for each of the pixel types");
  const bool isNull = std::visit([](const auto & pointer) { return pointer.IsNull(); }, image);
  return isNull ? Component::UNKNOWNCOMPONENTTYPE : types[image.index()];
}

Scan
WithoutVoxels(const Scan & scan)
{
  Scan description = scan;
  description.furtherLayers.clear();
  std::visit(
    [](auto & pointer) {
      const auto frame = std::decay_t<decltype(pointer)>::ObjectType::New();
      frame->CopyInformation(pointer);
      frame->SetMetaDataDictionary(pointer->GetMetaDataDictionary());
      pointer = frame;
    },
    description.image);
  return description;
}

bool
IsSlanted(const Scan & scan)
{
  return !scan.sliceOrigins.empty() || !itk::AreAxesPerpendicular(GeometryOf(scan.image).GetDirection());
}

itk::SlicePlacement
PlacementOf(const Scan & scan)
{
  FailIf(ComponentTypeOf(scan.image) == itk::IOComponentEnum::UNKNOWNCOMPONENTTYPE,
         FailureKind::Usage,
         "The places of a scan's slices are not known before it is read; call UpdateOutputInformation() of its "
         "reader first.");
  if (scan.sliceOrigins.empty())
  {
    return {};
  }
  const auto grid = itk::ImageBase<3>::New();
  grid->CopyInformation(&GeometryOf(scan.image));
  return { scan.sliceOrigins, grid.GetPointer() };
}

void
AttachPlacement(const Scan & scan)
{
  if (!scan.sliceOrigins.empty())
  {
    std::visit([&scan](const auto & image) { itk::SetSlicePlacement(*image, PlacementOf(scan)); }, scan.image);
  }
}

std::map<std::string, std::string>
SummarizeScan(const Scan & scan)
{
  const auto chosen =
    std::find_if(scan.series.begin(), scan.series.end(), [](const SeriesSummary & series) { return series.chosen; });
  return { { "ScanFormat", scan.format },
           { "ScanModality", scan.modality },
           { "ScanEncoding", scan.encoding },
           { "ScanScaling", scan.scaling },
           { "ScanSeries", chosen == scan.series.end() ? "" : chosen->id },
           { "ScanFrame", std::to_string(scan.frame) },
           { "ScanTiltDegrees", FormatNumber(scan.stack ? scan.stack->tiltDegrees : 0.0) },
           { "ScanIsOriented", scan.isOriented ? "yes" : "no" } };
}

std::vector<double>
VoxelVolumes(const Scan & scan)
{
  return VoxelVolumesOf(GeometryOf(scan.image), scan.sliceOrigins);
}

} // namespace rhombic
