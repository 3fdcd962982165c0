#include "rhombicLabelSurfaces.h"

#include "rhombicFailure.h"
#include "rhombicLabelNumbers.h"
#include "rhombicMemoryBudget.h"
#include "rhombicEvents.h"
#include "rhombicVoxelGrid.h"
#include "rhombicWording.h"

#include "detail/itkPositionArithmetic.h"
#include "itkFCCLabelSurfaceFilter.h"
#include "rhombicForEachBlock.h"
#include "itkBulkImage.h"
#include "itkImageAlgorithm.h"
#include "itkLabelWallsEditing.h"
#include "itkLabelsToFCCFilter.h"
#include "itkProbabilitiesToFCCFilter.h"
#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace rhombic
{
namespace
{

using LabelImage = NumberImage;

/** Throws Failure(Usage) for a density that is not above 0 and at most 64. */
void
CheckLabelDensity(double density)
{
  if (!(density > 0.0) || !(density <= 64.0))
  {
    throw Failure(FailureKind::Usage,
                  "The density of labels' lattices must be above 0 and at most 64 sites per voxel, not " +
                    std::to_string(density) + "; the default is " + FormatFixed(itk::FCCLattice::DefaultDensity, 2) +
                    ".");
  }
}

/** The label's name, colour, opacity and voxels, without a surface. */
LabelSurface
DescribeLabel(const LabelSummary & summary)
{
  LabelSurface described;
  described.value = summary.label.value;
  described.numberOfVoxels = summary.numberOfVoxels;
  described.voxelMillilitres = summary.millilitres;
  described.scene.name = summary.label.name;
  described.scene.label = summary.label.value;
  for (unsigned int channel = 0; channel < 3; ++channel)
  {
    described.scene.colour[channel] = summary.label.colour[channel] / 255.0;
  }
  described.scene.opacity = summary.label.opacity > 0.0 ? summary.label.opacity : 1.0;
  return described;
}

LabelImage::Pointer
Crop(const LabelImage & image, const itk::ImageRegion<3> & box)
{
  const auto cropped = LabelImage::New();
  cropped->CopyInformation(&image);
  cropped->SetOrigin(image.TransformIndexToPhysicalPoint<double>(box.GetIndex()));
  cropped->SetRegions(box.GetSize());
  itk::AllocateInBulk(*cropped);
  itk::ImageAlgorithm::Copy(&image, cropped.GetPointer(), box, cropped->GetBufferedRegion());
  return cropped;
}

/** How the walls of a label map are smoothed: no point leaves the ellipsoid around it whose half axes are the edges of
 * a voxel, as far as a border that is drawn by hand on thick slices may be off. Borders in nearly cubic voxels fit to
 * each other in all three directions, and move by less. The thicker slices are beside a pixel, the longer are the waves
 * that are noise. */
itk::TriangleSurfaceSmoothingSettings
RelaxationByVoxels(const itk::ImageBase<3> & grid)
{
  constexpr double shareOfCubes = 0.3; // of an edge
  constexpr double iterationsOfCubes = 6.0;
  constexpr double iterationsOfThickSlices = 40.0;
  constexpr double thick = 3.0; // times a pixel
  const auto & spacing = grid.GetSpacing();
  const auto [shortest, longest] = std::minmax({ spacing[0], spacing[1], spacing[2] });
  const double thickness = std::min(1.0, (longest / shortest - 1.0) / (thick - 1.0)); // 0: a cube
  const double share = shareOfCubes + (1.0 - shareOfCubes) * thickness;
  itk::TriangleSurfaceSmoothingSettings settings;
  auto & edges = settings.halfAxes.emplace();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto step = StepAlong(grid, axis);
    edges[axis] = { share * step[0], share * step[1], share * step[2] };
  }
  settings.iterations =
    static_cast<unsigned int>(iterationsOfCubes + (iterationsOfThickSlices - iterationsOfCubes) * thickness);
  settings.maximumMove = share * longest;
  return settings;
}

/** How the walls of probabilities are smoothed, which are near the truth already. */
itk::TriangleSurfaceSmoothingSettings
RelaxationByProbabilities(const itk::ImageBase<3> & grid)
{
  itk::TriangleSurfaceSmoothingSettings settings;
  settings.iterations = 10;
  settings.maximumMove = 0.3 * MeanSpacingOf(grid);
  return settings;
}

/** The walls between labels on a lattice, smoothed. The filter with the lattice and its weights, which take far more
 * memory than the walls, is freed before.
 * \param volumes of labels, which smoothing keeps; or empty */
template <typename TFilter>
itk::LabelWalls::Pointer
ExtractWalls(itk::SmartPointer<TFilter> toLattice,
             const itk::TriangleSurfaceSmoothingSettings & relaxation,
             const std::vector<double> & volumes)
{
  toLattice->ReleaseDataFlagOn();
  auto extract = itk::FCCLabelSurfaceFilter::New();
  extract->SetInput(toLattice->GetOutput());
  extract->SetWeights(toLattice->GetWeights());
  GiveBackFreedMemory();
  extract->Update();
  itk::LabelWalls::Pointer walls = extract->GetOutput();
  walls->DisconnectPipeline();
  extract = nullptr;
  toLattice = nullptr;
  itk::RelaxLabelWalls(*walls, relaxation, volumes);
  return walls;
}

/** The walls between labels by their voxels.
 * \param numbers of the labels' pieces, which keep their volumes as labels do: a part of the scan's grid */
itk::LabelWalls::Pointer
WallsOfVoxels(const LabelImage & numbers,
              const LabelPieces & pieces,
              const Scan & scan,
              const LabelSurfaceSettings & settings,
              const Events & events)
{
  auto toLattice = itk::LabelsToFCCFilter::New();
  toLattice->SetInput(&numbers);
  toLattice->SetDensity(settings.density);
  toLattice->SetScan(scan);
  toLattice->SetGroups(pieces.labels);
  ObserveProgress(*toLattice, "extracting labels", events);
  toLattice->Update();
  const std::vector<double> volumes = toLattice->GetVoxelVolumes();
  itk::LabelWalls::Pointer walls = ExtractWalls(std::move(toLattice), RelaxationByVoxels(numbers), volumes);
  walls->MergeLabels(pieces.labels);
  return walls;
}

/** The walls between labels by their probabilities. */
itk::LabelWalls::Pointer
WallsOfProbabilities(const LabelMap & map,
                     const std::vector<LabelSummary> & labels,
                     const LabelSurfaceSettings & settings,
                     const Events & events)
{
  auto toLattice = itk::ProbabilitiesToFCCFilter::New();
  for (std::size_t n = 0; n < map.probabilities.size(); ++n)
  {
    toLattice->SetInput(static_cast<unsigned int>(n), map.probabilities[n]);
  }
  toLattice->SetDensity(settings.density);
  ObserveProgress(*toLattice, "extracting labels", events);
  toLattice->Update();
  itk::LabelWalls::Pointer walls =
    ExtractWalls(std::move(toLattice), RelaxationByProbabilities(*map.probabilities.front()), {});
  std::vector<std::uint16_t> chosen(map.probabilities.size() + 1);
  for (std::size_t n = 0; n < labels.size(); ++n)
  {
    chosen[static_cast<std::size_t>(labels[n].label.value)] = static_cast<std::uint16_t>(n + 1);
  }
  walls->MergeLabels(chosen);
  return walls;
}

/** Sets unit normals: the mean of the triangles' at each point, by their angles there and their quality. Slivers, as
 * they occur where three labels meet, count little: which way they face says nothing of the surface. */
void
SetNormals(itk::TriangleSurface & surface)
{
  itk::BulkVector<itk::PositionType> sums(surface.GetNumberOfPoints(), itk::PositionType{});
  for (const auto & triangle : surface.GetTriangles())
  {
    const itk::CornersType corners = itk::CornersOf(surface, triangle);
    const itk::PositionType normal = itk::AreaVector(corners);
    const double twiceArea = itk::Length(normal);
    const double quality = itk::ComputeTriangleQuality(corners[0], corners[1], corners[2]);
    for (unsigned int corner = 0; corner < 3 && twiceArea > 0.0; ++corner)
    {
      const itk::PositionType & here = corners[corner];
      const double cosine =
        Dot(Subtract(corners[(corner + 1) % 3], here), Subtract(corners[(corner + 2) % 3], here)); // times both sides
      sums[triangle[corner]] =
        Along(sums[triangle[corner]], normal, quality * std::atan2(twiceArea, cosine) / twiceArea);
    }
  }
  for (const itk::PositionType & sum : sums)
  {
    const double length = itk::Length(sum);
    surface.GetNormals().push_back(
      itk::ToPoint(length > 0.0 ? itk::Scaled(sum, 1.0 / length) : itk::PositionType{ 0.0, 0.0, 1.0 }));
  }
}

/** Sets the volumes and pieces of the labels of the last layer, as far as it has all of their walls. */
void
MeasureLabels(const LabelPieces & pieces, bool isPart, LabelMesh & mesh)
{
  ForEachOnThreads(mesh.labels.size(), [&](std::size_t n) {
    if (pieces.counts[n + 1] == 0)
    {
      return;
    }
    LabelSurface & label = mesh.labels[n];
    label.layer = mesh.walls.size() - 1;
    label.isPart = isPart;
    if (isPart)
    {
      return;
    }
    const auto surface = mesh.walls.back()->ExtractLabel(static_cast<itk::LabelWalls::LabelType>(n + 1));
    const auto volumes =
      itk::ComputeTriangleSurfaceComponentVolumes(*surface, itk::FindTriangleSurfaceComponents(*surface));
    label.surfaceMillilitres = std::accumulate(volumes.begin(), volumes.end(), 0.0) / CubicMillimetresPerMl;
    label.surfacePieces = static_cast<std::size_t>(
      std::count_if(volumes.begin(), volumes.end(), [](double volume) { return volume > 0.0; }));
    label.pieces = pieces.counts[n + 1];
    label.isTorn = label.surfacePieces > label.pieces && label.surfacePieces > pieces.countsByFace[n + 1];
  });
}

bool
HasLabels(const LabelImage & numbers)
{
  const std::uint16_t * const begin = numbers.GetBufferPointer();
  const std::uint16_t * const end = begin + numbers.GetBufferedRegion().GetNumberOfPixels();
  return std::any_of(begin, end, [](std::uint16_t number) { return number != 0; });
}

/** The voxels of a box of a map that have an effect on the walls in a part of the map, or null if no label is there. */
LabelImage::Pointer
CropToPart(const LabelImage & numbers, const itk::ImageRegion<3> & box, const itk::ImageRegion<3> & part)
{
  itk::ImageRegion<3> near = part;
  near.PadByRadius(MarginOfPart(numbers));
  if (!near.Crop(box))
  {
    return nullptr;
  }
  near.SetIndex(numbers.GetBufferedRegion().GetIndex() + (near.GetIndex() - box.GetIndex()));
  const LabelImage::Pointer cropped = Crop(numbers, near);
  return HasLabels(*cropped) ? cropped : nullptr;
}

/** Adds the walls of the labels in one layer, if it has any of them. */
void
AddLayer(const LabelMap & map,
         const ScanImage & layer,
         const std::vector<LabelSummary> & labels,
         const LabelSurfaceSettings & settings,
         const Events & events,
         LabelMesh & mesh)
{
  LabelImage::Pointer numbers = NumberLabels(layer, labels);
  if (!map.scan.furtherLayers.empty() && !HasLabels(*numbers))
  {
    return;
  }
  itk::ImageRegion<3> box = RegionOfLabels({ numbers });
  box.PadByRadius(BoxMargin);
  box.Crop(numbers->GetBufferedRegion());
  numbers = Crop(*numbers, box);
  const LabelPieces pieces = NumberPieces(*numbers, labels.size() + 1);
  const bool isPart = settings.part && map.probabilities.empty();
  const LabelImage::Pointer needed = isPart ? CropToPart(*numbers, box, *settings.part) : numbers;
  mesh.walls.push_back(!needed                     ? itk::LabelWalls::New()
                       : map.probabilities.empty() ? WallsOfVoxels(*needed, pieces, map.scan, settings, events)
                                                   : WallsOfProbabilities(map, labels, settings, events));
  MeasureLabels(pieces, isPart, mesh);
}

/** Notes a torn surface, and a volume that differs by more than 1 %. */
void
NoteShortcomings(const LabelSurface & made, const Events & events)
{
  if (made.isTorn || made.surfacePieces < made.pieces)
  {
    events.Note(made.scene.name + ": " + Count(made.pieces, "piece") + " became " + std::to_string(made.surfacePieces) +
                "; parts of it are hardly wider than a voxel");
  }
  constexpr double notable = 0.01;
  if (std::abs(made.GetVolumeDifference()) > notable)
  {
    events.Note(made.scene.name + ": the surface's volume differs by " +
                FormatFixed(100.0 * made.GetVolumeDifference(), 1) + " % from that of its voxels");
  }
}

} // namespace

void
RequireMemory(const LabelWork & work, std::uintmax_t maximumMemory)
{
  RequireMemory(work.bytes, maximumMemory, "The walls between labels", "use a coarser lattice, or crop the label map");
}

LabelMesh
LabelsToWalls(const LabelMap & map, const LabelSurfaceSettings & settings, const Events & events)
{
  CheckLabelDensity(settings.density);
  const std::vector<LabelSummary> labels = ChooseLabels(map, settings.labels);
  if (labels.size() > std::numeric_limits<std::uint16_t>::max())
  {
    throw Failure(FailureKind::Unreadable, "Walls can have 65,535 labels; name those to show.");
  }
  const LabelWork work = EstimateLabelWork(map, settings);
  settings.check ? settings.check(work) : RequireMemory(work, settings.maximumMemory);
  LabelMesh mesh;
  std::transform(labels.begin(), labels.end(), std::back_inserter(mesh.labels), DescribeLabel);
  for (const ScanImage & layer : LayersOf(map.scan))
  {
    AddLayer(map, layer, labels, settings, events, mesh);
  }
  for (const LabelSurface & label : mesh.labels)
  {
    if (map.probabilities.empty() && !label.isPart) // else there are no volumes and pieces to keep
    {
      NoteShortcomings(label, events);
    }
  }
  events.Progress("extracting labels", 1.0);
  return mesh;
}

std::vector<Refinement>
RefineWalls(LabelMesh & mesh, const SurfaceFinish & finish, double spacing, const Events & events)
{
  std::size_t triangles = 0;
  for (const auto & walls : mesh.walls)
  {
    triangles += walls->GetNumberOfTriangles();
  }
  std::vector<Refinement> refinements;
  for (const auto & layer : mesh.walls)
  {
    itk::LabelWalls & walls = *layer;
    const RefinementFunctions functions{ [&walls](auto &, auto settings, const auto & report) {
                                          settings.iterations = 80; // as far as the largest move allows
                                          return itk::RelaxLabelWalls(walls, settings, {}, report);
                                        },
                                         [&walls](auto &, const auto & settings, const auto & report) {
                                           return itk::SimplifyLabelWalls(walls, settings, report);
                                         },
                                         [&walls](auto &) {
                                           return -itk::ComputeTriangleSurfaceVolume(*walls.ExtractLabel(0));
                                         } };
    SurfaceFinish share = finish;
    if (finish.maximumTriangles > 0)
    {
      const std::size_t part = finish.maximumTriangles * walls.GetNumberOfTriangles() / triangles;
      share.maximumTriangles = std::max<std::size_t>(1, part);
    }
    const std::string place = " in layer " + std::to_string(1 + refinements.size());
    const std::string name = "walls of labels" + (mesh.walls.size() > 1 ? place : "");
    refinements.push_back(RefineBy(functions, walls, share, spacing, name, events));
  }
  return refinements;
}

itk::TriangleSurface::Pointer
ExtractSurface(const LabelMesh & mesh, std::size_t label)
{
  const itk::LabelWalls & walls = *mesh.walls[mesh.labels[label].layer];
  const auto surface = walls.ExtractLabel(static_cast<itk::LabelWalls::LabelType>(label + 1));
  SetNormals(*surface);
  return surface;
}

void
ExtractSurfaces(LabelMesh & mesh)
{
  ForEachOnThreads(mesh.labels.size(),
                   [&](std::size_t label) { mesh.labels[label].scene.surface = ExtractSurface(mesh, label); });
}

} // namespace rhombic
