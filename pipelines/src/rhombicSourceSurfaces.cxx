#include "rhombicSourceSurfaces.h"

#include "rhombicFailure.h"
#include "rhombicFewerTriangles.h"
#include "rhombicMeasureTable.h"

#include "itkFCCScanBorder.h"
#include "itkTriangleSurfaceIntersections.h"
#include "itkTriangleSurfaceForRendering.h"
#include "itkTriangleSurfaceSmoothing.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <utility>

namespace rhombic
{
namespace
{

/** The volume inside the scan's isosurface, estimated from the lattice. Nothing if only some parts of it are kept, if
 * the lattice samples another field than the scan or has few sites, or if the uncertainty is half the volume or more.
 */
std::optional<IsosurfaceVolume>
EstimateIsosurface(const LoadedSource & loaded,
                   const SurfaceRequest & request,
                   double area,
                   const LatticeSettings & settings)
{
  constexpr double fewestSites = 0.7; // per sample of the scan
  const bool isFieldOfScan = loaded.scan && !settings.nested && settings.denoising.kind == Denoising::Kind::None;
  if (!isFieldOfScan || request.parts != SurfaceRequest::Parts::All)
  {
    return std::nullopt;
  }
  const auto countOf = [](const itk::ImageBase<3> & image) {
    return static_cast<double>(image.GetLargestPossibleRegion().GetNumberOfPixels());
  };
  const double sites = std::visit([&](const auto & image) { return countOf(*image); }, loaded.lattice);
  if (sites < fewestSites * countOf(GeometryOf(loaded.scan->image)))
  {
    return std::nullopt;
  }
  const auto estimate =
    EstimateIsosurfaceVolume(loaded.lattice, request.GetThreshold(), area, loaded.grid.GetPointer());
  return estimate.uncertainty < 0.5 * estimate.volume ? std::optional(estimate) : std::nullopt;
}

void
AddIsosurfaces(const SurfaceMaking & making,
               const LoadedSource & loaded,
               bool computesNormals,
               std::vector<MeshedSurface> & surfaces)
{
  const auto lattice = itk::ImageBase<3>::New();
  std::visit([&lattice](const auto & image) { lattice->CopyInformation(image); }, loaded.lattice);
  auto extracted = LatticeToSurfaces(loaded.lattice,
                                     loaded.requests,
                                     making.selection.mode,
                                     making.events,
                                     loaded.grid,
                                     computesNormals,
                                     making.viewing);
  for (std::size_t n = 0; n < extracted.size(); ++n)
  {
    MeshedSurface & surface = surfaces.emplace_back();
    surface.enclosed = extracted[n].enclosed;
    surface.whole = extracted[n].whole;
    surface.scene = std::move(extracted[n]);
    surface.request = loaded.requests[n];
    surface.mode = making.selection.mode;
    surface.lattice = lattice;
    surface.grid = loaded.grid;
    surface.extracted = surface.whole
                          ? ExtractedSize{ surface.whole->volume, surface.whole->area, surface.whole->triangles }
                          : MeasureExtracted(*surface.scene.surface);
    if (making.use == SurfaceUse::Files)
    {
      surface.isosurface = EstimateIsosurface(loaded, *surface.request, surface.extracted->area, making.source.lattice);
    }
  }
}

/** Of each layer of labels, how many layers have fewer millilitres: a lesion is seen on the organ that it is in. */
std::vector<std::size_t>
RankLayers(const LabelMesh & mesh)
{
  std::vector<double> volumes(mesh.walls.size());
  for (const LabelSurface & label : mesh.labels)
  {
    volumes[label.layer] += label.voxelMillilitres;
  }
  std::vector<std::size_t> ranks;
  std::transform(volumes.begin(), volumes.end(), std::back_inserter(ranks), [&volumes](double volume) {
    return std::count_if(volumes.begin(), volumes.end(), [volume](double other) { return other < volume; });
  });
  return ranks;
}

void
AddLabels(const SurfaceMaking & making, const LoadedSource & loaded, std::vector<MeshedSurface> & surfaces)
{
  const bool isForFiles = making.use == SurfaceUse::Files;
  const LatticeSettings & lattice = making.source.lattice;
  if (isForFiles && lattice.denoising.kind != Denoising::Kind::None)
  {
    making.events.Note("labels have no noise: --denoise is not for them");
  }
  SurfaceFinish smoothing;
  smoothing.smoothing = making.finish.smoothing;
  LabelMesh mesh = LabelsToWalls(
    *loaded.labels,
    { making.selection.labels->labels, lattice.density, lattice.maximumMemory, making.part, making.checkLabels },
    making.events);
  const bool isMeasured =
    isForFiles || smoothing.smoothing.IsNothing(); // else the surfaces would be extracted for it alone
  std::vector<std::optional<ExtractedSize>> extracted(mesh.labels.size());
  if (isMeasured)
  {
    ExtractSurfaces(mesh);
    std::transform(mesh.labels.begin(), mesh.labels.end(), extracted.begin(), [](const LabelSurface & label) {
      return MeasureExtracted(*label.scene.surface);
    });
  }
  const double spacing = MeanSpacingOf(GeometryOf(loaded.labels->scan.image));
  const std::vector<Refinement> refinements =
    RefineWalls(mesh, isForFiles ? making.finish : smoothing, spacing, making.events);
  if (!isMeasured || refinements.front().smoothing || refinements.front().simplification)
  {
    ExtractSurfaces(mesh);
  }
  const auto & edges = GeometryOf(loaded.labels->scan.image).GetSpacing();
  const double shortest = std::min({ edges[0], edges[1], edges[2] });
  std::vector<SceneSurface> forDrawing;
  if (!isForFiles && !making.part)
  {
    constexpr double unseen = 0.05; // of a voxel's shortest edge: in pictures half a pixel and less
    ForEachOnThreads(mesh.labels.size(), [&mesh](std::size_t n) {
      const auto shaded = itk::TriangleSurface::New();
      shaded->Graft(mesh.labels[n].scene.surface);
      SmoothTriangleSurfaceNormals(*shaded);
      mesh.labels[n].scene.surface = shaded;
    });
    for (const LabelSurface & label : mesh.labels)
    {
      forDrawing.push_back(label.scene);
    }
    forDrawing = InFewerTriangles(forDrawing, unseen * shortest);
  }
  const std::vector<std::size_t> ranks = RankLayers(mesh);
  for (std::size_t n = 0; n < mesh.labels.size(); ++n)
  {
    MeshedSurface & surface = surfaces.emplace_back();
    if (!forDrawing.empty())
    {
      surface.forDrawing = forDrawing[n].surface;
    }
    surface.scene = std::exchange(mesh.labels[n].scene, {});
    surface.label = std::move(mesh.labels[n]);
    surface.scene.layer = ranks[surface.label->layer];
    surface.scene.layerGap = 0.25 * shortest; // as far as smoothing moves walls of cubic voxels apart
    surface.extracted = extracted[n];
    surface.refinement = isForFiles ? refinements[surface.label->layer] : Refinement();
  }
}

/** The triangles of an isosurface that may cross; nothing if all may. In modes Tetrahedra and Fine points lie on the
 * edges of tetrahedra, but for those near the walls, which were moved. */
std::optional<itk::CrossingCandidates>
FindCandidates(const MeshedSurface & surface)
{
  using Mode = itk::FCCIsosurfaceMode;
  if (surface.mode != Mode::Tetrahedra && surface.mode != Mode::Fine)
  {
    return std::nullopt;
  }
  constexpr double widthOfTetrahedron = 2.0; // spacings
  const auto & spacing = surface.lattice->GetSpacing();
  const auto [smallest, largest] = std::minmax_element(spacing.Begin(), spacing.End());
  itk::CrossingCandidates candidates;
  candidates.longestEdge = itk::FindLongestRoundedEdge(*surface.scene.surface, *smallest, *largest);
  if (surface.grid)
  {
    candidates.triangles =
      itk::FindTrianglesNearFCCWalls(*surface.scene.surface, *surface.grid, 1.5 * widthOfTetrahedron * *largest);
  }
  return candidates;
}

} // namespace

std::vector<MeshedSurface>
ExtractSource(const SurfaceMaking & making, const LoadedSource & loaded, bool computesNormals)
{
  std::vector<MeshedSurface> surfaces;
  if (!loaded.requests.empty())
  {
    AddIsosurfaces(making, loaded, computesNormals, surfaces);
  }
  if (loaded.labels)
  {
    AddLabels(making, loaded, surfaces);
  }
  return surfaces;
}

bool
FinishSurface(const SurfaceMaking & making, MeshedSurface & surface)
{
  if (surface.label && surface.label->isPart)
  {
    return true;
  }
  const std::string & name = surface.scene.name;
  const SurfaceFinish finish = surface.request ? CombineFinish(surface.request->finish, making.finish) : making.finish;
  const auto finished = itk::TriangleSurface::New();
  finished->Graft(surface.scene.surface);
  surface.scene.surface = finished;
  finished->GetTriangles().shrink_to_fit(); // extraction may leave room for more
  surface.parts = RemoveParts(*finished, finish, name, making.events);
  if (finished->GetNumberOfTriangles() == 0)
  {
    making.events.Note(name + ": left out, as all its parts are below --min-volume");
    return false;
  }
  if (making.use == SurfaceUse::Files && surface.request)
  {
    surface.refinement =
      RefineSurface(*finished, finish, MeanSpacingOf(*surface.lattice), name, making.events, FindCandidates(surface));
  }
  if (making.use == SurfaceUse::Pictures)
  {
    if (surface.request && !finish.smoothing.IsNothing())
    {
      itk::TriangleSurfaceSmoothingSettings settings;
      settings.maximumMove = finish.smoothing.FindLargestMove(MeanSpacingOf(*surface.lattice));
      SmoothTriangleSurface(*finished, settings);
    }
    if (!surface.forDrawing && !surface.whole) // whose normals are smooth already
    {
      itk::SmoothTriangleSurfaceNormals(*finished);
    }
  }
  return true;
}

void
FinishSurfaces(const SurfaceMaking & making, std::vector<MeshedSurface> & surfaces)
{
  std::vector<MeshedSurface> finished;
  for (MeshedSurface & surface : surfaces)
  {
    if (FinishSurface(making, surface))
    {
      finished.push_back(std::move(surface));
    }
  }
  surfaces.swap(finished);
  if (surfaces.empty())
  {
    throw Failure(FailureKind::Empty, "Nothing is left: all parts are below --min-volume; lower it.");
  }
}

} // namespace rhombic
