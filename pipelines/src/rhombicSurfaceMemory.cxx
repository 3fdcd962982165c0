#include "rhombicSurfaceMemory.h"

#include "rhombicMemoryBudget.h"
#include "rhombicSurfaceIO.h"

#include <algorithm>
#include <string>
#include <vector>

namespace rhombic
{
namespace
{

TemporaryStore
SurfaceStore(const MeshEstimate & mesh, const ScanSource & source)
{
  return { source.read.temporaryFolder,
           "Cannot make surfaces of " + DescribeTriangles(mesh.triangles) + ": their arrays" };
}

TemporaryStore
LabelStore(const ScanSource & source)
{
  return { source.read.temporaryFolder, "Cannot make surfaces of labels: their arrays" };
}

/** Whether surfaces are coloured by those of a label map, which are made in memory. */
bool
AreColouredByLabels(const SurfaceWork & work)
{
  return work.colourBy && work.colourBy->kind == ColourBy::Kind::Distance && !IsSurfacePath(work.colourBy->file);
}

/** Throws Failure(Memory) for a volume that is too large. */
ColourBytes
CountColours(const SurfaceWork & work)
{
  return work.colourBy ? CountColourBytes(WithinMemory(*work.colourBy, work.source)) : ColourBytes();
}

/** Whether surfaces are drawn as they are extracted. */
bool
AreAllDrawn(const SurfaceWork & work)
{
  const auto keepsAll = [](const SurfaceFinish & finish) {
    return finish.minimumVolume == 0.0 && !finish.keepsLargestPart && !finish.fillsCavities;
  };
  const std::vector<SurfaceRequest> & requests = work.surfaces.requests;
  return work.source.lattice.denoising.kind == Denoising::Kind::None && keepsAll(work.finish) &&
         std::all_of(requests.begin(), requests.end(), [&keepsAll](const SurfaceRequest & request) {
           return keepsAll(request.finish);
         });
}

void
NoteFiles(const std::string & what,
          double triangles,
          std::uintmax_t bytes,
          const ScanSource & source,
          const Events & events)
{
  events.Note(what + ", " + DescribeTriangles(triangles) + ", are put into temporary files of some " +
              DescribeBytes(bytes) + " in " + TemporaryStore{ source.read.temporaryFolder, {} }.FindFolder().string() +
              ", as they do not fit into the memory that is allowed");
}

} // namespace

std::uintmax_t
AllowedBytes(const ScanSource & source)
{
  constexpr std::uintmax_t small = std::uintmax_t{ 4 } << 20;
  const std::uintmax_t most = source.lattice.maximumMemory;
  return std::max(MemoryAllowance(most > 0 ? most : FreeMemory()), small);
}

MeshSteps
FindSteps(const SurfaceWork & work)
{
  MeshSteps steps;
  for (const SurfaceRequest & request : work.surfaces.requests)
  {
    const SurfaceFinish finish = CombineFinish(request.finish, work.finish);
    steps.smooths = steps.smooths || !finish.smoothing.IsNothing();
    steps.simplifies = steps.simplifies || finish.Simplifies();
  }
  steps.colours = work.colourBy.has_value();
  steps.audits = work.audits;
  return steps;
}

void
FitIntoMemory(MeshEstimate & mesh, const SurfaceWork & work)
{
  CountSteps(FindSteps(work), mesh);
  const std::uintmax_t allowed = AllowedBytes(work.source);
  const bool fits = mesh.bytes.afterwards <= allowed;
  const bool leavesHalf = mesh.bytes.besideSlab - mesh.bits <= allowed / 2; // to slabs
  if ((fits && leavesHalf) || !MayBeInSlabs(work.surfaces.requests) || AreColouredByLabels(work))
  {
    return;
  }
  const TemporaryStore store = SurfaceStore(mesh, work.source);
  const ColourBytes colours = CountColours(work);
  MeshEstimate inFiles = mesh;
  inFiles.bytes.afterwards += colours.others;
  PutIntoTemporaryFiles(inFiles);
  if (!fits && work.source.lattice.denoising.kind == Denoising::Kind::None)
  {
    RequireRoom(store, inFiles.temporaryBytes);
  }
  if (FindObstacle(store, inFiles.temporaryBytes).empty())
  {
    mesh = inFiles;
    mesh.bytes.afterwards += colours.voxels;
  }
}

bool
FitIntoMemory(LabelWork & labels, const SurfaceWork & work)
{
  MeshEstimate walls;
  walls.triangles = labels.triangles;
  CountSteps({ !work.finish.smoothing.IsNothing(), work.finish.Simplifies(), work.colourBy.has_value(), true }, walls);
  labels.bytes = std::max(labels.bytes, walls.bytes.afterwards);
  const std::uintmax_t limit = work.source.lattice.maximumMemory;
  if (labels.bytes <= MemoryAllowance(limit) || labels.isOfProbabilities || AreColouredByLabels(work))
  {
    RequireMemory(labels, limit);
    return false;
  }
  labels.bytes += CountColours(work).others;
  RequireRoom(LabelStore(work.source), labels.bytes);
  return true;
}

ColourBy
WithinMemory(ColourBy by, const ScanSource & source)
{
  by.maximumMemory = AllowedBytes(source) / 2;
  by.temporaryFolder = source.read.temporaryFolder;
  return by;
}

std::uintmax_t
FitDrawn(MeshEstimate & mesh, const SurfaceWork & work, const CountDrawing & countDrawing)
{
  FitIntoMemory(mesh, work);
  const std::uintmax_t allowed = AllowedBytes(work.source);
  if (work.source.lattice.denoising.kind == Denoising::Kind::None && mesh.bytes.afterwards > allowed)
  {
    RequireMemory(mesh.bytes.afterwards,
                  work.source.lattice.maximumMemory > 0 ? work.source.lattice.maximumMemory : allowed,
                  "Drawing surfaces of " + DescribeTriangles(mesh.triangles),
                  "use a coarser lattice with a smaller --density, another threshold or a part of the scan");
  }
  constexpr double atLeast = 0.85; // of the estimate, which gyroids are below
  const bool areReduced = mesh.kept < mesh.triangles;
  const double least = AreAllDrawn(work) && !areReduced ? atLeast * mesh.kept : 0.0;
  return countDrawing ? countDrawing({ least, mesh.kept }) : 0;
}

std::uintmax_t
FitDrawn(LabelWork & labels, const SurfaceWork & work, const CountDrawing & countDrawing, bool & isInFiles)
{
  const double ofWalls = AreAllDrawn(work) ? 0.8 : 2.0; // both sides of walls, in fewer triangles or all; measured
  isInFiles = FitIntoMemory(labels, work);
  return countDrawing ? countDrawing({ 0.0, ofWalls * labels.triangles }) : 0; // flat walls have few triangles
}

std::string
DoubtDrawing(std::uintmax_t bytes, const ScanSource & source)
{
  const std::uintmax_t allowed = MemoryAllowance(source.lattice.maximumMemory);
  return bytes <= allowed ? ""
                          : ", more than the " + DescribeBytes(allowed) +
                              " that are allowed, so that the picture may be refused once the surfaces are made";
}

void
SurfacesInFiles::Put(const MeshEstimate & mesh, const ScanSource & source, const Events & events)
{
  if (mesh.temporaryBytes > 0)
  {
    m_Files.emplace(SurfaceStore(mesh, source));
    NoteFiles("the surfaces", mesh.triangles, mesh.temporaryBytes, source, events);
  }
}

void
SurfacesInFiles::Put(const LabelWork & labels, const ScanSource & source, const Events & events)
{
  m_Files.emplace(LabelStore(source));
  NoteFiles("labels and their surfaces", labels.triangles, labels.bytes, source, events);
}

} // namespace rhombic
