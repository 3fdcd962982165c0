#include "rhombicComparedSide.h"

#include "rhombicFailure.h"
#include "rhombicSourceSurfaces.h"
#include "rhombicSurfaceIO.h"
#include "rhombicVoxelSurface.h"

#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace rhombic
{
namespace
{

void
TakeLabels(LabelMap map, ComparedSide & side)
{
  for (const LabelSummary & summary : map.labels)
  {
    const Label & label = summary.label;
    const auto bytes = FindAnatomicalColour(label.name).value_or(label.colour);
    Colour colour{};
    std::transform(bytes.begin(), bytes.end(), colour.begin(), [](std::uint8_t channel) { return channel / 255.0; });
    side.labels.push_back({ label.name, label.value, label.name != "label " + std::to_string(label.value), colour });
  }
  side.moments = ComputeLabelMoments(map.scan);
  side.map = std::move(map);
}

void
LoadLabelMap(const ScanSource & source, const std::filesystem::path & table, const Events & events, ComparedSide & side)
{
  SourceVolume volume = LoadVolume(source, events);
  auto * const scan = std::get_if<Scan>(&volume);
  if (scan == nullptr || !IsLabelMap(*scan))
  {
    throw Failure(FailureKind::Unreadable,
                  source.path.string() +
                    " is no label map; compare scans by an isosurface, as -t 250.5, and surface files with "
                    "--surfaces.");
  }
  std::vector<LabelSummary> labels = FindLabels(*scan, { { source.path }, table });
  side.isSingle = table.empty() && IsMask(labels);
  TakeLabels({ std::move(*scan), std::move(labels) }, side);
}

/** A map whose voxels are 1 where a scan's values are inside of an isosurface, else 0. */
Scan
MakeMask(const Scan & scan, const Threshold & threshold)
{
  Scan mask = WithoutVoxels(scan);
  using MaskImage = CartesianImage<std::uint8_t>;
  const auto image = MaskImage::New();
  image->CopyInformation(&GeometryOf(scan.image));
  image->SetRegions(GeometryOf(scan.image).GetLargestPossibleRegion());
  image->Allocate();
  std::visit(
    [&](const auto & values) {
      const auto * const begin = values->GetBufferPointer();
      std::transform(begin,
                     begin + values->GetBufferedRegion().GetNumberOfPixels(),
                     image->GetBufferPointer(),
                     [&](auto value) { return threshold.IsInside(static_cast<double>(value)) ? 1 : 0; });
    },
    scan.image);
  mask.image = image;
  return mask;
}

void
LoadIsosurface(const ScanSource & source, const SurfaceRequest & request, const Events & events, ComparedSide & side)
{
  SurfaceSelection selection;
  selection.requests = { request };
  selection.removesTable = false;
  SourceVolume volume = LoadVolume(source, events);
  if (!std::holds_alternative<Scan>(volume))
  {
    throw Failure(FailureKind::Usage,
                  source.path.string() + " is a lattice volume; compare scans, or surface files with --surfaces.");
  }
  const LoadedSource loaded = LoadSource(source, selection, std::move(volume), events);
  const SurfaceFinish finish;
  const auto made = ExtractSource({ source, selection, finish, SurfaceUse::Pictures, events }, loaded, false);
  side.surfaces = { made.front().scene.surface };
  side.labels = { { "surface", 1, false } };
  side.isSingle = true;
  Scan mask = MakeMask(*loaded.scan, loaded.requests.front().GetThreshold());
  side.moments = ComputeLabelMoments(mask);
  side.map = LabelMap{ std::move(mask), {} };
}

/** The surface of a solid, turned if it faces inwards. Notes say so, and that a surface is open. Throws
 * Failure(Unreadable) for positions that are not finite. */
itk::TriangleSurface::ConstPointer
CheckSolid(const SceneSurface & item, const std::filesystem::path & path, const Events & events)
{
  const double volume = ComputeTriangleSurfaceVolume(*item.surface);
  if (!std::isfinite(volume))
  {
    throw Failure(FailureKind::Unreadable,
                  path.string() + ": a position of the surface " + item.name + " is no number; export it anew.");
  }
  if (ComputeTriangleSurfaceTopology(*item.surface).boundaryEdges > 0)
  {
    events.Note("warning: the surface " + item.name + " is open, so that its volume and its inside are not defined");
  }
  if (volume >= 0.0)
  {
    return item.surface;
  }
  events.Note("warning: the surface " + item.name + " faces inwards; it was turned");
  const auto turned = itk::TriangleSurface::New();
  turned->Graft(item.surface);
  for (auto & triangle : turned->GetTriangles())
  {
    std::swap(triangle[1], triangle[2]);
  }
  return turned;
}

void
LoadSurfaces(const std::filesystem::path & path, const Events & events, ComparedSide & side)
{
  for (const SceneSurface & surface : ReadSurfaces(path))
  {
    side.labels.push_back({ surface.name, 0, true, surface.colour });
    side.surfaces.push_back(CheckSolid(surface, path, events));
  }
  side.isSingle = side.labels.size() == 1;
}

} // namespace

ComparedSide
LoadSide(const CompareLabelsSettings & settings, bool isSecond, const Events & events)
{
  const ScanSource & source = isSecond ? settings.second : settings.first;
  ComparedSide side;
  side.file = source.path.string();
  events.Progress(isSecond ? "reading B" : "reading A", 0.0);
  switch (settings.kind)
  {
    case ComparedKind::Labels:
      LoadLabelMap(source, isSecond ? settings.secondTable : settings.firstTable, events, side);
      break;
    case ComparedKind::Surfaces:
      LoadSurfaces(source.path, events, side);
      break;
    case ComparedKind::Isosurfaces:
      LoadIsosurface(source, settings.isosurface, events, side);
      break;
  }
  return side;
}

void
ExtractSide(const CompareLabelsSettings & settings,
            const std::vector<std::size_t> & chosen,
            const Events & events,
            ComparedSide & side)
{
  if (settings.kind != ComparedKind::Labels || chosen.empty())
  {
    return;
  }
  if (settings.takesVoxelSurfaces)
  {
    side.surfaces.resize(side.labels.size());
    for (const std::size_t label : chosen)
    {
      const int value = side.labels[label].value;
      side.surfaces[label] = ExtractVoxelSurface(side.map->scan, value, side.moments.at(value).region);
    }
    return;
  }
  LabelSurfaceSettings making;
  making.density = settings.first.lattice.density;
  making.maximumMemory = settings.first.lattice.maximumMemory;
  for (const ComparedLabel & label : side.labels) // all, as walls depend on the labels beside them
  {
    if (side.moments.count(label.value) > 0)
    {
      making.labels.push_back(std::to_string(label.value));
    }
  }
  side.mesh = LabelsToWalls(*side.map, making, events);
}

itk::TriangleSurface::ConstPointer
ComparedSide::GetSurface(std::size_t label) const
{
  if (!mesh)
  {
    return surfaces[label];
  }
  const auto made = std::find_if(mesh->labels.begin(), mesh->labels.end(), [&](const LabelSurface & candidate) {
    return candidate.value == labels[label].value;
  });
  return ExtractSurface(*mesh, static_cast<std::size_t>(made - mesh->labels.begin())).GetPointer();
}

std::vector<itk::Point<double, 3>>
FindCorners(const ComparedSide & side)
{
  std::vector<itk::Point<double, 3>> corners;
  if (side.map)
  {
    const auto & grid = GeometryOf(side.map->scan.image);
    const auto & region = grid.GetLargestPossibleRegion();
    for (unsigned int corner = 0; corner < 8; ++corner)
    {
      itk::ContinuousIndex<double, 3> index;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const bool isHigh = (corner >> axis & 1u) != 0;
        index[axis] =
          static_cast<double>(isHigh ? region.GetUpperIndex()[axis] : region.GetIndex(axis)) + (isHigh ? 0.5 : -0.5);
      }
      corners.push_back(grid.TransformContinuousIndexToPhysicalPoint<double, double>(index));
    }
    return corners;
  }
  for (const auto & surface : side.surfaces)
  {
    const std::array<double, 6> bounds = surface->GetBounds();
    for (unsigned int corner = 0; corner < 8; ++corner)
    {
      const std::array<double, 3> position{ bounds[corner & 1u],
                                            bounds[2 + (corner >> 1 & 1u)],
                                            bounds[4 + (corner >> 2 & 1u)] };
      corners.emplace_back(position.data());
    }
  }
  return corners;
}

} // namespace rhombic
