#include "rhombicMemoryPlan.h"

#include "rhombicIntensities.h"
#include "rhombicMemoryBudget.h"
#include "rhombicPatientAxes.h"
#include "rhombicWording.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** A scan of which only headers were read, and where its voxels will be. */
struct UnreadSource
{
  UnreadScan file;
  VoxelPlace place = VoxelPlace::Memory;

  std::uintmax_t
  CountBytes() const
  {
    const auto count = [](const auto & image) {
      return image->GetLargestPossibleRegion().GetNumberOfPixels() *
             sizeof(typename std::decay_t<decltype(*image)>::PixelType);
    };
    return std::visit(count, file.scan.image);
  }

  std::uintmax_t
  CountInMemory() const
  {
    return place == VoxelPlace::Memory ? this->CountBytes() : 0;
  }
};

UnreadSource
OpenSource(const ScanSource & source)
{
  UnreadSource unread;
  unread.file = OpenScan(source.path, source.read);
  if (source.check)
  {
    source.check(unread.file.scan);
  }
  if (unread.file.findPlace)
  {
    unread.place = unread.file.findPlace();
  }
  else
  {
    RequireMemory(unread.CountBytes(), source.read.maximumMemory, "Reading " + source.path.string());
  }
  return unread;
}

std::string
DescribePlace(const UnreadSource & unread, const ScanReadOptions & options)
{
  const std::string bytes = DescribeBytes(unread.CountBytes());
  switch (unread.place)
  {
    case VoxelPlace::File:
      return bytes + ", which stay in their file and are read where they are needed";
    case VoxelPlace::TemporaryFile:
      return bytes + ", which are put into a temporary file in " +
             TemporaryStore{ options.temporaryFolder, {} }.FindFolder().string();
    default:
      return bytes + " in memory";
  }
}

/** Pairs of slices of a scan, one after the other; null where it can't be read in part. */
ScanImage
ReadSlicePairs(const UnreadScan & file, const std::vector<std::size_t> & pairs)
{
  return std::visit(
    [&](const auto & unread) -> ScanImage {
      using Image = typename std::decay_t<decltype(*unread)>;
      const bool canBeRead = file.native && file.native->areReadInPart && file.scan.numberOfFrames == 1 &&
                             file.native->type == ComponentTypeOf(file.scan.image);
      typename Image::Pointer sample;
      if (canBeRead)
      {
        itk::ImageRegion<3> region = unread->GetLargestPossibleRegion();
        itk::Size<3> size = region.GetSize();
        const std::size_t ofPair = std::min<std::size_t>(size[2], 2);
        size[2] = ofPair * pairs.size();
        sample = Image::New();
        sample->SetSpacing(unread->GetSpacing());
        sample->SetRegions(size);
        sample->Allocate();
        region.SetSize(2, ofPair);
        for (std::size_t n = 0; n < pairs.size(); ++n)
        {
          region.SetIndex(2, static_cast<itk::IndexValueType>(pairs[n]));
          file.native->read(region, sample->GetBufferPointer() + n * ofPair * size[0] * size[1]);
        }
      }
      return sample;
    },
    file.scan.image);
}

/** The lattice of a source, planned. */
LatticePlan
PlanLattice(const UnreadSource & unread,
            const LatticeSettings & settings,
            LatticeStream & stream,
            const Events & events)
{
  stream.scanBytes = settings.maximumMemory > 0 ? unread.CountInMemory() : 0;
  stream.onlyPlans = true;
  ScanToLattice(OrderAlongPatient(unread.file.scan, settings.maximumMemory), settings, events, &stream);
  return stream.plan;
}

/** "some 12 minutes". */
std::string
DescribeTime(double seconds)
{
  return seconds < 90.0     ? "some " + Count(static_cast<std::uintmax_t>(std::ceil(seconds)), "second")
         : seconds < 5400.0 ? "some " + FormatFixed(seconds / 60.0, 0) + " minutes"
                            : "some " + FormatFixed(seconds / 3600.0, 1) + " hours";
}

/** Estimated from what a thread does in a second (pipelines/README.md).
 * \param passes over the lattice */
double
EstimateSeconds(const UnreadSource & unread, const LatticePlan & plan, double passes, double triangles, bool simplifies)
{
  constexpr double voxelsAtFirst = 60e6;                  // that are read and put onto the lattice
  constexpr double voxelsAgain = 150e6;                   // the same by a further pass
  const double trianglesMade = simplifies ? 0.05e6 : 1e6; // extracted, untangled, finished, written and checked
  const auto voxels =
    static_cast<double>(GeometryOf(unread.file.scan.image).GetLargestPossibleRegion().GetNumberOfPixels());
  const double again = plan.slabs > 1 ? passes - 1.0 : 0.0;
  const double threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  return (voxels / voxelsAtFirst + again * voxels / voxelsAgain + triangles / trianglesMade) / threads;
}

std::string
DescribeLattice(const LatticePlan & plan, unsigned int passes)
{
  const std::string bytes = DescribeBytes(plan.latticeBytes);
  return plan.slabs == 1 ? bytes + " in memory"
                         : bytes + ", in " + Count(plan.slabs, "slab") + " of " + Count(plan.planesOfSlab, "plane") +
                             (passes > 1 ? ", made again for each of " : ", in ") + Count(passes, "pass", "passes");
}

std::string
DescribeMemory(std::uintmax_t bytes, std::uintmax_t limit)
{
  return "some " + DescribeBytes(bytes) + " of the " + DescribeBytes(MemoryAllowance(limit)) +
         " that are allowed for volumes";
}

std::string
DescribeDrawing(std::uintmax_t bytes, const ScanSource & source)
{
  return bytes > 0 ? ", then " + DescribeBytes(bytes) + " to draw them" + DoubtDrawing(bytes, source) : "";
}

std::string
DescribeUnwritten(const std::filesystem::path & output)
{
  return "dry run       " + output.string() + " was not made\n";
}

/** The plan of what is made of a lattice volume, which is read whole. */
std::string
PlanLatticeVolume(const ScanSource & source, const std::filesystem::path & output)
{
  const std::uintmax_t bytes = std::filesystem::file_size(source.path);
  return "lattice       " + DescribeBytes(bytes) + " in memory\nmemory        " +
         DescribeMemory(bytes, source.lattice.maximumMemory) + '\n' + DescribeUnwritten(output);
}

/** Bytes of a triangle in a file, with its share of the points; 0 where they depend on the surface. */
double
BytesOfTriangle(const std::filesystem::path & path)
{
  static const std::map<std::string, double> bytes{
    { ".stl", 50.0 }, { ".ply", 27.0 }, { ".obj", 75.0 }, { ".glb", 24.0 }, { ".vtp", 37.0 }
  };
  const auto found = bytes.find(LowerCase(path.extension().string()));
  return found == bytes.end() ? 0.0 : found->second;
}

/** How surfaces of a scan are planned. */
struct SurfacePlanning
{
  const ScanSource & source;
  const SurfaceSelection & surfaces;
  const fs::path & output;
  std::function<std::uintmax_t(MeshEstimate & mesh)> check; ///< returns the bytes to draw surfaces, as the next
  std::function<std::uintmax_t(LabelWork & labels, bool & isInFiles)> checkLabels;
  FindPart findPart; ///< empty: all
  bool isMeasured;   ///< whether the volume that isosurfaces enclose is estimated from the lattice
  bool simplifies;
};

/** How often the lattice is made in slabs: by extraction, of what is above and of what is below isovalues, and for the
 * volume that each isosurface encloses. */
unsigned int
CountPasses(const SurfacePlanning & planning)
{
  const std::vector<SurfaceRequest> & requests = planning.surfaces.requests;
  const auto isBelow = [](const SurfaceRequest & request) { return request.insideIsBelow; };
  const auto below = std::count_if(requests.begin(), requests.end(), isBelow);
  const unsigned int sides = (below > 0 ? 1 : 0) + (below < static_cast<std::ptrdiff_t>(requests.size()) ? 1 : 0);
  const unsigned int ofSide = planning.surfaces.mode == itk::FCCIsosurfaceMode::Lean ? 3 : 2;
  const bool isEnclosed = planning.isMeasured && planning.source.lattice.denoising.kind == Denoising::Kind::None;
  return sides * ofSide + (isEnclosed ? static_cast<unsigned int>(requests.size()) : 0);
}

/** The requests whose isovalues are numbers, or follow from some slices. */
std::vector<SurfaceRequest>
FindRequests(const std::vector<SurfaceRequest> & requests, const ScanImage & slices)
{
  const bool isRead = std::visit([](const auto & image) { return image.IsNotNull(); }, slices);
  const bool needsOtsu =
    std::any_of(requests.begin(), requests.end(), [](const SurfaceRequest & request) { return !request.isovalue; });
  if (isRead && needsOtsu)
  {
    return ResolveIsovalues(requests, ComputeIntensities(slices));
  }
  return isRead ? requests : std::vector<SurfaceRequest>();
}

std::string
DescribeTemporary(std::uintmax_t bytes, const ScanSource & source)
{
  return bytes == 0 ? ""
                    : "; while they are made, " + DescribeBytes(bytes) + " in temporary files in " +
                        TemporaryStore{ source.read.temporaryFolder, {} }.FindFolder().string();
}

std::string
DescribeSurfaces(const SurfacePlanning & planning, double triangles, std::uintmax_t temporaryBytes)
{
  const double bytes = triangles * BytesOfTriangle(planning.output);
  return "surfaces      " + DescribeTriangles(triangles) +
         (bytes > 0.0 ? ", " + DescribeBytes(static_cast<std::uintmax_t>(bytes)) + " in " + planning.output.string()
                      : "") +
         DescribeTemporary(temporaryBytes, planning.source) + '\n';
}

/** What labels take, in bytes. */
struct LabelPlan
{
  LabelWork work;
  std::uintmax_t inMemory = 0;
  std::uintmax_t inFiles = 0;
  std::uintmax_t drawing = 0;
};

/** \param loaded has the labels */
LabelPlan
PlanWork(const SurfacePlanning & planning, const LoadedSource & loaded)
{
  LabelSurfaceSettings settings;
  settings.labels = planning.surfaces.labels->labels;
  settings.density = planning.source.lattice.density;
  settings.part = planning.findPart ? planning.findPart(loaded) : std::nullopt;
  LabelPlan plan;
  plan.work = EstimateLabelWork(*loaded.labels, settings);
  bool isInFiles = false;
  plan.drawing = planning.checkLabels(plan.work, isInFiles);
  (isInFiles ? plan.inFiles : plan.inMemory) = plan.work.bytes;
  return plan;
}

/** The plan of surfaces of a label map, of which the voxels are read, unless they have to be put into a temporary file.
 */
std::string
PlanLabels(const SurfacePlanning & planning, const UnreadSource & unread)
{
  const ScanSource & source = planning.source;
  std::string text = "voxels        " + DescribePlace(unread, source.read) + '\n';
  LabelPlan plan;
  if (unread.place == VoxelPlace::TemporaryFile)
  {
    text += "surfaces      not known before the voxels are read\n";
  }
  else
  {
    plan = PlanWork(planning, LoadSource(source, planning.surfaces, std::nullopt, {}));
    text += DescribeSurfaces(planning, plan.work.triangles, plan.inFiles);
  }
  return text + "memory        " + DescribeMemory(unread.CountInMemory() + plan.inMemory, source.read.maximumMemory) +
         DescribeDrawing(plan.drawing, source) + '\n' + DescribeUnwritten(planning.output);
}

/** The plan of labels beside a scan, whose map is read. */
LabelPlan
PlanLabelsBeside(const SurfacePlanning & planning, const UnreadSource & unread)
{
  const ScanSource & source = planning.source;
  LoadedSource loaded;
  loaded.scan = unread.file.scan;
  loaded.requests = planning.surfaces.requests;
  loaded.labels = ReadLabelMap(planning.surfaces.labels->source, source.read, unread.file.scan, source.path);
  ApplySceneRules(planning.surfaces.rules, loaded.requests, &*loaded.labels);
  if (loaded.labels->labels.empty() && loaded.requests.empty())
  {
    RefuseEmptyMap(planning.surfaces.labels->source);
  }
  return loaded.labels->labels.empty() ? LabelPlan() : PlanWork(planning, loaded);
}

/** The plan of surfaces in a file or picture. */
std::string
PlanSurfaces(const SurfacePlanning & planning, const Events & events)
{
  const ScanSource & source = planning.source;
  if (IsFCCImageFile(source.path))
  {
    return PlanLatticeVolume(source, planning.output);
  }
  const UnreadSource unread = OpenSource(source);
  const std::vector<SurfaceRequest> & requests = planning.surfaces.requests;
  if (requests.empty() && planning.surfaces.labels && planning.surfaces.labels->source.IsEmpty())
  {
    return PlanLabels(planning, unread);
  }
  const itk::Size<3> size = GeometryOf(unread.file.scan.image).GetLargestPossibleRegion().GetSize();
  std::vector<std::size_t> pairs = FindSlicePairs(size);
  const ScanImage slices = ReadSlicePairs(unread.file, pairs);
  const std::vector<SurfaceRequest> known = FindRequests(requests, slices);
  MeshEstimate mesh;
  if (!known.empty())
  {
    for (std::size_t n = 0; n < pairs.size(); ++n)
    {
      pairs[n] = 2 * n; // of the slices that were read
    }
    mesh =
      EstimateMesh({ slices, pairs, size[2] }, known, planning.surfaces.mode, source.lattice, source.mostTriangles);
  }
  std::string text = "voxels        " + DescribePlace(unread, source.read) + '\n';
  std::uintmax_t volumes = unread.CountInMemory();
  std::uintmax_t drawing = 0;
  LatticePlan plan;
  if (!requests.empty())
  {
    LatticeStream stream;
    stream.mayBeInSlabs = MayBeInSlabs(requests);
    stream.check = [&] {
      drawing = planning.check(mesh); // nothing is refused of a mesh that is not known
      stream.surfaces = mesh.bytes;
    };
    plan = PlanLattice(unread, source.lattice, stream, events);
    volumes += plan.peak - plan.scanBytes;
    text += "lattice       " + DescribeLattice(plan, CountPasses(planning)) + '\n';
  }
  if (!known.empty())
  {
    text += DescribeSurfaces(planning, mesh.triangles, mesh.temporaryBytes);
    text += "time          " +
            DescribeTime(EstimateSeconds(unread, plan, CountPasses(planning), mesh.triangles, planning.simplifies)) +
            '\n';
  }
  else if (!requests.empty())
  {
    text += "surfaces      not known before the voxels are read\n";
  }
  LabelPlan labels;
  if (planning.surfaces.labels)
  {
    labels = PlanLabelsBeside(planning, unread);
    text +=
      "labels        " + DescribeTriangles(labels.work.triangles) + DescribeTemporary(labels.inFiles, source) + '\n';
  }
  return text + "memory        " + DescribeMemory(volumes, source.read.maximumMemory) +
         (known.empty() ? "" : ", then " + DescribeBytes(mesh.bytes.afterwards) + " for the surfaces") +
         (labels.inMemory == 0 ? "" : ", then " + DescribeBytes(labels.inMemory) + " for the labels") +
         DescribeDrawing(std::max(drawing, labels.drawing), source) + '\n' + DescribeUnwritten(planning.output);
}

} // namespace

std::string
PlanMeshScan(const MeshScanSettings & settings, const Events & events)
{
  CheckOutputs(CheckMeshScan(settings), settings.source, settings.surfaces, InputsOf(settings.colourBy));
  const auto check = [&settings](MeshEstimate & mesh) {
    CheckMesh(mesh, settings);
    return 0;
  };
  const auto checkLabels = [&settings](LabelWork & labels, bool & isInFiles) {
    isInFiles = FitIntoMemory(labels, WorkOf(settings));
    return 0;
  };
  return PlanSurfaces({ settings.source,
                        settings.surfaces,
                        settings.mesh,
                        check,
                        checkLabels,
                        {},
                        true,
                        FindSteps(WorkOf(settings)).simplifies },
                      events);
}

std::string
PlanPictures(const SurfaceWork & work,
             const CountDrawing & countDrawing,
             const FindPart & findPart,
             const fs::path & picture,
             const Events & events)
{
  const auto check = [&](MeshEstimate & mesh) { return FitDrawn(mesh, work, countDrawing); };
  const auto checkLabels = [&](LabelWork & labels, bool & isInFiles) {
    return FitDrawn(labels, work, countDrawing, isInFiles);
  };
  return PlanSurfaces(
    { work.source, work.surfaces, picture, check, checkLabels, findPart, false, FindSteps(work).simplifies }, events);
}

std::string
PlanResampleScan(const ResampleScanSettings & settings, const Events & events)
{
  CheckOutputs(CheckResampleScan(settings), settings.source);
  if (IsFCCImageFile(settings.source.path))
  {
    return PlanLatticeVolume(settings.source, settings.volume);
  }
  const UnreadSource unread = OpenSource(settings.source);
  LatticeStream stream;
  const LatticePlan plan = PlanLattice(unread, settings.source.lattice, stream, events);
  return "voxels        " + DescribePlace(unread, settings.source.read) + "\nlattice       " +
         DescribeLattice(plan, 1) + "\ntime          " + DescribeTime(EstimateSeconds(unread, plan, 1.0, 0.0, false)) +
         "\nmemory        " +
         DescribeMemory(unread.CountInMemory() + plan.peak - plan.scanBytes, settings.source.read.maximumMemory) +
         '\n' + DescribeUnwritten(settings.volume);
}

} // namespace rhombic
