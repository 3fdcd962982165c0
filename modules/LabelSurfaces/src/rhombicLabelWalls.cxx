#include "rhombicLabelWalls.h"

#include "rhombicFailure.h"
#include "rhombicLabelChoice.h"
#include "rhombicLabelPieces.h"
#include "rhombicMemoryBudget.h"
#include "rhombicObserveProgress.h"
#include "rhombicWording.h"

#include "itkFCCLabelSurfaceFilter.h"
#include "itkForEachBlock.h"
#include "itkLabelWallsEditing.h"
#include "itkLabelsToFCCFilter.h"
#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace rhombic
{
namespace
{

using LabelImage = itk::LabelsToFCCFilter::InputImageType;

/** The values of labels, and at their place in the list, from 1, their numbers. */
template <typename TPixel>
std::uint16_t
NumberOf(TPixel value, const std::vector<std::int32_t> & values)
{
  const auto found = std::lower_bound(values.begin(), values.end(), static_cast<std::int32_t>(value));
  return found != values.end() && *found == static_cast<std::int32_t>(value)
           ? static_cast<std::uint16_t>(found - values.begin() + 1)
           : 0;
}

/** The numbers of the labels, from 1, at the voxels around them; 0 at all others. */
LabelImage::Pointer
NumberLabels(const ScanImage & image, const std::vector<LabelSummary> & labels)
{
  std::vector<std::int32_t> values;
  for (const LabelSummary & summary : labels)
  {
    values.push_back(summary.label.value);
  }
  const auto numbers = LabelImage::New();
  const auto number = [&](const auto & voxels) {
    const auto & region = voxels->GetBufferedRegion();
    const auto * const from = voxels->GetBufferPointer();
    numbers->CopyInformation(voxels);
    numbers->SetRegions(region);
    numbers->Allocate();
    itk::ForEachInBlocks(region.GetSize(1) * region.GetSize(2), 64, [&](std::size_t row) {
      const std::size_t first = row * region.GetSize(0);
      for (std::size_t n = first; n < first + region.GetSize(0); ++n)
      {
        const bool isSame = n > first && from[n] == from[n - 1];
        numbers->GetBufferPointer()[n] = isSame ? numbers->GetBufferPointer()[n - 1] : NumberOf(from[n], values);
      }
    });
  };
  std::visit(number, image);
  return numbers;
}

itk::LabelsToFCCFilter::Pointer
MakeFilter(const LabelImage & labels, const Scan & scan, double density)
{
  const auto filter = itk::LabelsToFCCFilter::New();
  filter->SetInput(&labels);
  filter->SetDensity(density);
  filter->SetSliceOrigins(scan.sliceOrigins);
  return filter;
}

/** Bytes for labels and fields, for weights, and for walls. */
std::uintmax_t
EstimateMemory(const LabelImage & labels, itk::LabelsToFCCFilter & filter, double density)
{
  constexpr double bytesPerSite = 6.0;
  constexpr double bytesPerVoxel = 22.0;
  constexpr double bytesPerChange = 350.0; // of label along x: weights within 3 voxels, and triangles
  filter.UpdateOutputInformation();
  const auto sites = static_cast<double>(filter.GetOutput()->GetLargestPossibleRegion().GetNumberOfPixels());
  const auto voxels = labels.GetBufferedRegion().GetNumberOfPixels();
  const std::uint16_t * const begin = labels.GetBufferPointer();
  double changes = 0.0;
  for (std::size_t n = 1; n < voxels; ++n)
  {
    changes += begin[n] != begin[n - 1] ? 1.0 : 0.0;
  }
  return static_cast<std::uintmax_t>(sites * bytesPerSite + static_cast<double>(voxels) * bytesPerVoxel +
                                     changes * bytesPerChange * std::max(1.0, density));
}

/** Sets unit normals: the mean of the triangles' at each point, by their areas. */
void
SetNormals(itk::TriangleSurface & surface)
{
  const auto & points = surface.GetPoints();
  auto & normals = surface.GetNormals();
  normals.assign(points.size(), {});
  for (const auto & triangle : surface.GetTriangles())
  {
    std::array<std::array<float, 3>, 2> sides;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      sides[0][axis] = points[triangle[1]][axis] - points[triangle[0]][axis];
      sides[1][axis] = points[triangle[2]][axis] - points[triangle[0]][axis];
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const unsigned int next = (axis + 1) % 3;
      const unsigned int last = (axis + 2) % 3;
      const float component = sides[0][next] * sides[1][last] - sides[0][last] * sides[1][next];
      for (const std::uint32_t point : triangle)
      {
        normals[point][axis] += component;
      }
    }
  }
  for (auto & normal : normals)
  {
    const float length = std::hypot(normal[0], normal[1], normal[2]);
    normal = length > 0.0f ? std::array{ normal[0] / length, normal[1] / length, normal[2] / length }
                           : std::array{ 0.0f, 0.0f, 1.0f };
  }
}

/** Sets the labels of a mesh, with the volumes and pieces of their walls. */
void
DescribeLabels(const LabelMap & map, const std::vector<LabelSummary> & labels, LabelMesh & mesh, const Events & events)
{
  const auto boxes = FindLabelBoxes(map.scan.image);
  mesh.labels.resize(labels.size());
  for (std::size_t n = 0; n < labels.size(); ++n)
  {
    LabelSurface & label = mesh.labels[n];
    label = DescribeLabel(labels[n]);
    label.sharesWalls = true;
    label.scene.label = label.value;
    const LabelPieces pieces(map.scan.image, label.value, boxes.at(label.value));
    label.pieces = pieces.GetNumberOfPieces();
    const auto surface = mesh.walls->ExtractLabel(static_cast<itk::LabelWalls::LabelType>(n + 1));
    const auto volumes = itk::ComputeComponentVolumes(*surface, itk::FindComponents(*surface));
    label.surfaceMillilitres = std::accumulate(volumes.begin(), volumes.end(), 0.0) / CubicMillimetresPerMl;
    label.surfacePieces = static_cast<std::size_t>(
      std::count_if(volumes.begin(), volumes.end(), [](double volume) { return volume > 0.0; }));
    label.isTorn = label.surfacePieces > label.pieces && label.surfacePieces > pieces.CountFaceConnectedPieces();
    NoteShortcomings(label, events);
  }
}

} // namespace

LabelMesh
LabelsToWalls(const LabelMap & map, const LabelSurfaceSettings & settings, const Events & events)
{
  constexpr double smoothing = 0.3; // largest move of a point, in voxels
  CheckLabelDensity(settings.density);
  const std::vector<LabelSummary> labels = ChooseLabels(map, settings.labels);
  if (labels.size() > std::numeric_limits<std::uint16_t>::max())
  {
    throw Failure(FailureKind::Unreadable, "Walls can have 65,535 labels; name those to show.");
  }
  const LabelImage::Pointer numbers = NumberLabels(map.scan.image, labels);
  const auto toLattice = MakeFilter(*numbers, map.scan, settings.density);
  RequireMemory(EstimateMemory(*numbers, *toLattice, settings.density),
                settings.maximumMemory,
                "The walls between labels",
                "use a coarser lattice, or crop the label map");
  ObserveProgress(*toLattice, "extracting labels", events);
  toLattice->Update();
  const auto extract = itk::FCCLabelSurfaceFilter::New();
  extract->SetInput(toLattice->GetOutput());
  extract->SetWeights(toLattice->GetWeights());
  extract->Update();
  LabelMesh mesh;
  mesh.walls = extract->GetOutput();
  mesh.walls->DisconnectPipeline();
  itk::TriangleSurfaceSmoothingSettings relaxation;
  const auto & spacing = numbers->GetSpacing();
  relaxation.maximumMove = smoothing * std::cbrt(spacing[0] * spacing[1] * spacing[2]);
  itk::RelaxWalls(*mesh.walls, relaxation, toLattice->GetVoxelVolumes());
  DescribeLabels(map, labels, mesh, events);
  events.Progress("extracting labels", 1.0);
  return mesh;
}

Refinement
RefineWalls(itk::LabelWalls & walls, const SurfaceFinish & finish, double spacing, const Events & events)
{
  const RefinementFunctions functions{
    [&walls](auto &, const auto & settings) { return itk::RelaxWalls(walls, settings); },
    [&walls](auto &, const auto & settings) { return itk::SimplifyWalls(walls, settings); },
    [&walls](auto &) { return -itk::ComputeVolume(*walls.ExtractLabel(0)); }
  };
  return RefineBy(functions, walls, finish, spacing, "walls of labels", events);
}

void
ExtractSurfaces(LabelMesh & mesh)
{
  itk::ForEachOnThreads(mesh.labels.size(), [&](std::size_t n) {
    const auto surface = mesh.walls->ExtractLabel(static_cast<itk::LabelWalls::LabelType>(n + 1));
    SetNormals(*surface);
    mesh.labels[n].scene.surface = surface;
  });
}

} // namespace rhombic
