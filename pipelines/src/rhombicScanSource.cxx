#include "rhombicScanSource.h"

#include "itkNativeScanFileReader.h"
#include "rhombicAtomicFile.h"
#include "rhombicEvents.h"
#include "rhombicFailure.h"
#include "rhombicForEachBlock.h"
#include "rhombicLabelDoubts.h"
#include "rhombicMappedVoxels.h"
#include "rhombicMemoryBudget.h"
#include "rhombicPatientAxes.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** "DICOM CT: 512 x 512 x 138 samples, spacing 0.7 x 0.7 x 2 mm, int16". */
std::string
DescribeGrid(const Scan & scan)
{
  const auto & grid = GeometryOf(scan.image);
  return scan.format + (scan.modality.empty() ? "" : " " + scan.modality) + ": " +
         FormatProduct(grid.GetLargestPossibleRegion().GetSize()) + " samples, spacing " +
         DescribeSpacing(grid.GetSpacing()) + ", " + PixelTypeName(scan.image);
}

/** Throws Failure(Geometry) if a corner of the scan is so far from the origin that the 32-bit coordinates of surfaces
 * there are steps of more than 1/80 of a voxel. */
void
RequireNearOrigin(const Scan & scan, const fs::path & path)
{
  constexpr double mostSpacings = 200'000.0; // of 2^24 steps
  const auto & grid = GeometryOf(scan.image);
  const auto & region = grid.GetLargestPossibleRegion();
  const auto & spacing = grid.GetSpacing();
  double farthest = 0.0;
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    itk::Index<3> index;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      constexpr itk::IndexValueType around = 2; // voxels, to which the lattice reaches
      index[axis] =
        (corner >> axis & 1u) != 0 ? region.GetUpperIndex()[axis] + around : region.GetIndex()[axis] - around;
    }
    const auto point = grid.TransformIndexToPhysicalPoint<double>(index);
    farthest = std::max({ farthest, std::abs(point[0]), std::abs(point[1]), std::abs(point[2]) });
  }
  if (!(farthest <= mostSpacings * std::min({ spacing[0], spacing[1], spacing[2] })))
  {
    throw Failure(FailureKind::Geometry,
                  "The voxels of " + path.string() + " lie up to " + FormatNumber(farthest, 4) +
                    " mm from the origin, too far for the coordinates of surfaces (200,000 voxels at most); "
                    "correct the origin in the header.");
  }
}

void
NoteAll(const std::vector<std::string> & notes, const Events & events, const std::string & before = "")
{
  for (const std::string & note : notes)
  {
    events.Note(before + note);
  }
}

[[noreturn]] void
RefuseToChoose(const fs::path & path)
{
  throw Failure(FailureKind::Usage,
                "No surface is chosen, and " + path.string() +
                  " is no label map; choose a --preset (see rhombic render --list-presets), or give --surface "
                  "name=threshold, --labels MAP or, to rhombic mesh, a threshold, as -t 250.5.");
}

/** The labels of a scan that is a label map itself. */
LabelMap
TakeForLabels(Scan scan, const LabelMapSource & source, const Events & events)
{
  if (!IsLabelMap(scan))
  {
    RefuseToChoose(source.GetFirstPath());
  }
  std::vector<LabelSummary> labels = FindLabels(scan, source);
  if (labels.empty())
  {
    RefuseEmptyMap(source);
  }
  events.Note(source.GetFirstPath().string() + " is a label map of " + Count(labels.size(), "label") +
              ", of which surfaces are made");
  return { std::move(scan), std::move(labels) };
}

LabelMap
LoadLabels(const ScanSource & source, const LabelMapSource & labels, const Scan & scan, const Events & events)
{
  events.Progress("reading labels", 0.0);
  LabelMap map = ReadLabelMap(labels, source.read, scan, source.path);
  events.Note(Count(map.labels.size(), "label") + " in " +
              (labels.probabilities.size() + labels.paths.size() > 1 ? Count(map.scan.files.size(), "file")
                                                                     : labels.GetFirstPath().string()));
  NoteAll(map.scan.notes, events);
  return map;
}

/** Removes the table if asked; says so if a scan keeps it unasked. Scans of unknown modality are taken for CTs when
 * asked. */
std::optional<TableRemoval>
TreatTable(Scan & scan, const std::optional<bool> & removesTable, const Events & events)
{
  const bool isCT = scan.modality == "CT";
  const bool isRemoved = removesTable.value_or(false);
  if (isRemoved && (isCT || scan.modality.empty()))
  {
    return RemoveTable(scan, events);
  }
  if (isRemoved)
  {
    events.Note("no table is removed, as the scan is no CT, but of modality " + scan.modality);
  }
  else if (isCT && !removesTable)
  {
    events.Note("the scan is taken as it is; --remove-table removes table, holders and sheets around the patient");
  }
  return {};
}

/** Says which walls of bone voxels of a CT are too long for. A wall of thickness w between soft tissue in voxels of
 * length d has a share w / d of the difference between the two. */
void
NoteThinBone(const Scan & scan, const std::vector<SurfaceRequest> & requests, const Events & events)
{
  constexpr double coarse = 2.5;         // mm
  constexpr double compactBone = 1200.0; // HU, and next
  constexpr double softTissue = 50.0;
  constexpr double lower = 150.5; // at 3 mm, closes vertebrae and most of the pelvis
  const auto & spacing = GeometryOf(scan.image).GetSpacing();
  const double longest = *std::max_element(spacing.Begin(), spacing.End());
  if (longest < coarse || (!scan.modality.empty() && scan.modality != "CT"))
  {
    return;
  }
  for (const SurfaceRequest & request : requests)
  {
    const double isovalue = request.isovalue.value();
    if (!request.insideIsBelow && isovalue > lower && isovalue < compactBone && FitsPattern("*bone*", request.name))
    {
      const double thickness = longest * (isovalue - softTissue) / (compactBone - softTissue);
      events.Note("the voxels are " + FormatNumber(longest, 3) +
                  " mm long, in which walls of compact bone thinner than some " + FormatNumber(thickness, 1) +
                  " mm fall below " + FormatNumber(isovalue) + ": " + request.name +
                  " has holes there; --surface bone=" + FormatNumber(lower) + ",ivory closes most of them");
    }
  }
}

/** The requests with their isovalues. Otsu's threshold is computed only if a request needs it. */
template <typename TVolume>
std::vector<SurfaceRequest>
ResolveRequests(const std::vector<SurfaceRequest> & requests, const TVolume & volume)
{
  const bool needsOtsu =
    std::any_of(requests.begin(), requests.end(), [](const SurfaceRequest & request) { return !request.isovalue; });
  return ResolveIsovalues(requests, ComputeIntensities(volume, needsOtsu));
}

LoadedSource
PrepareLattice(FCCVolume volume, const ScanSource & source, const SurfaceSelection & selection, const Events & events)
{
  if (selection.labels && selection.labels->source.IsEmpty())
  {
    RefuseToChoose(source.path);
  }
  if (selection.labels)
  {
    throw Failure(FailureKind::Usage,
                  "Labels need the scan that they belong to, and " + source.path.string() +
                    " is a lattice volume; name the scan, or the label map itself.");
  }
  LoadedSource loaded;
  std::vector<SurfaceRequest> requests = selection.requests;
  ApplySceneRules(selection.rules, requests, nullptr);
  loaded.requests = ResolveRequests(requests, volume);
  loaded.lattice = DenoiseLattice(volume, source.lattice.denoising, source.lattice.maximumMemory, events);
  return loaded;
}

LoadedSource
PrepareScan(Scan volume, const ScanSource & source, const SurfaceSelection & selection, const Events & events)
{
  LoadedSource loaded;
  if (selection.labels && selection.labels->source.IsEmpty())
  {
    loaded.labels = TakeForLabels(std::move(volume), { { source.path }, selection.labels->source.table }, events);
    ApplySceneRules(selection.rules, loaded.requests, &*loaded.labels);
    return loaded;
  }
  Scan & scan = loaded.scan.emplace(std::move(volume));
  if (selection.labels)
  {
    loaded.labels = LoadLabels(source, selection.labels->source, scan, events);
    loaded.warnings = FindLabelDoubts(scan, *loaded.labels);
    NoteAll(loaded.warnings, events, "warning: ");
  }
  std::vector<SurfaceRequest> requests = selection.requests;
  SceneRules rules = selection.rules;
  for (const std::string & label : selection.labels ? selection.labels->labels : std::vector<std::string>())
  {
    if (!ToNumber<double>(label)) // a name, no value
    {
      rules.needed.push_back(label);
    }
  }
  ApplySceneRules(rules, requests, loaded.labels ? &*loaded.labels : nullptr);
  if (loaded.labels && loaded.labels->labels.empty())
  {
    if (requests.empty())
    {
      RefuseEmptyMap(selection.labels->source);
    }
    loaded.labels.reset();
  }
  if (requests.empty())
  {
    return loaded;
  }
  loaded.tableRemoval = TreatTable(scan, selection.removesTable, events);
  loaded.requests = ResolveRequests(requests, scan.image);
  NoteThinBone(scan, loaded.requests, events);
  const Scan ordered = OrderAlongPatient(scan, source.lattice.maximumMemory, source.read.temporaryFolder);
  loaded.stream.mayBeInSlabs = MayBeInSlabs(loaded.requests);
  MeshEstimate mesh;
  if (source.streams)
  {
    const itk::Size<3> size = GeometryOf(ordered.image).GetLargestPossibleRegion().GetSize();
    mesh = EstimateMesh({ ordered.image, FindSlicePairs(size), size[2] },
                        loaded.requests,
                        selection.mode,
                        source.lattice,
                        source.mostTriangles);
    loaded.stream.check = [&] {
      source.checkMesh ? source.checkMesh(mesh) : void();
      loaded.stream.surfaces = mesh.bytes;
    };
  }
  loaded.lattice = ScanToLattice(ordered, source.lattice, events, source.streams ? &loaded.stream : nullptr);
  loaded.stream.check = nullptr;
  if (!IsSlanted(ordered))
  {
    loaded.grid = itk::ImageBase<3>::New();
    const DeepImage deep = MakeDeep(ordered.image);
    loaded.grid->CopyInformation(&GeometryOf(deep.image));
  }
  return loaded;
}

} // namespace

bool
MayBeInSlabs(const std::vector<SurfaceRequest> & requests)
{
  return std::all_of(requests.begin(), requests.end(), [](const SurfaceRequest & request) {
    return request.parts == SurfaceRequest::Parts::All; // others are found in the whole lattice
  });
}

bool
HasOwnOpacity(const SurfaceSelection & selection, const SceneSurface & surface)
{
  const auto & [requests, rules] = std::tie(selection.requests, selection.rules.rules);
  const auto isRequested = [&surface](const SurfaceRequest & request) {
    return surface.label == 0 && request.hasOwnOpacity && request.name == surface.name;
  };
  const auto isRuled = [&surface](const SceneRule & rule) {
    return rule.opacity && FitsPattern(rule.pattern, surface.name);
  };
  return std::any_of(requests.begin(), requests.end(), isRequested) || std::any_of(rules.begin(), rules.end(), isRuled);
}

Scan
ReadScan(const ScanSource & source, const Events & events)
{
  const auto reader = itk::NativeScanFileReader::New();
  reader->SetFileName(source.path.string());
  reader->SetOptions(source.read);
  ObserveProgress(*reader, "reading", events);
  if (source.check)
  {
    reader->UpdateOutputInformation();
    source.check(reader->GetScan());
  }
  reader->Update();
  return *reader->GetOutput()->Get();
}

SourceVolume
LoadVolume(const ScanSource & source, const Events & events)
{
  events.Progress("reading", 0.0);
  if (IsFCCImageFile(source.path))
  {
    return ReadFCCImage(source.path);
  }
  ScanSource near = source;
  near.check = [&source](const Scan & scan) {
    RequireNearOrigin(scan, source.path);
    source.check ? source.check(scan) : void();
  };
  Scan scan = ReadScan(near, events);
  events.Note(DescribeGrid(scan));
  if (IsMapped(scan.image))
  {
    DropPages(scan.image);
    events.Note(PlaceOf(scan.image) == VoxelPlace::TemporaryFile
                  ? "the voxels were put into a temporary file in " +
                      TemporaryStore{ source.read.temporaryFolder, {} }.FindFolder().string() +
                      " and are read from there where they are needed, as they do not fit into the memory that is "
                      "allowed"
                  : "the voxels stay in their file and are read where they are needed, as they would take more "
                    "than half of the memory that is allowed");
  }
  NoteAll(scan.notes, events);
  NoteAll(scan.fileNotes, events);
  return scan;
}

void
LoadedSource::DropVolumes()
{
  lattice = FCCVolume();
  stream = {};
  labels.reset();
  GiveBackFreedMemory();
}

void
RefuseEmptyMap(const LabelMapSource & source)
{
  throw Failure(FailureKind::Empty,
                source.GetFirstPath().string() + " holds nothing but background; check that it was exported whole.");
}

LoadedSource
LoadSource(const ScanSource & source,
           const SurfaceSelection & selection,
           std::optional<SourceVolume> volume,
           const Events & events)
{
  CheckLatticeSettings(source.lattice);
  if (!volume)
  {
    volume = LoadVolume(source, events);
  }
  if (auto * const lattice = std::get_if<FCCVolume>(&*volume))
  {
    return PrepareLattice(std::move(*lattice), source, selection, events);
  }
  return PrepareScan(std::get<Scan>(*std::move(volume)), source, selection, events);
}

void
CheckSelection(const SurfaceSelection & selection)
{
  if (!selection.labels && !selection.lacksPreset) // whose names are not known yet
  {
    std::vector<SurfaceRequest> requests = selection.requests;
    ApplySceneRules(selection.rules, requests, nullptr);
  }
}

void
CheckOutputs(const std::vector<fs::path> & outputs,
             const ScanSource & source,
             const SurfaceSelection & selection,
             const std::vector<fs::path> & others)
{
  std::vector<fs::path> inputs{ source.path };
  inputs.insert(inputs.end(), others.begin(), others.end());
  if (selection.labels)
  {
    const LabelMapSource & labels = selection.labels->source;
    inputs.push_back(labels.table);
    inputs.insert(inputs.end(), labels.paths.begin(), labels.paths.end());
    inputs.insert(inputs.end(), labels.probabilities.begin(), labels.probabilities.end());
  }
  std::set<fs::path> seen;
  for (const fs::path & output : outputs)
  {
    std::error_code ignored;
    for (const fs::path & input : inputs)
    {
      if (fs::equivalent(output, input, ignored))
      {
        throw Failure(FailureKind::Usage,
                      "The output " + output.string() + " is the input itself; give it another name.");
      }
    }
    const AtomicFile probe(output);
    if (!seen.insert(fs::weakly_canonical(fs::absolute(output), ignored)).second)
    {
      throw Failure(FailureKind::Usage,
                    "Two outputs would be the same file, " + output.string() + "; give one of them another name.");
    }
  }
}

void
NoteFramesOfReference(const std::string & one,
                      const std::string & other,
                      const std::filesystem::path & file,
                      const Events & events)
{
  if (!one.empty() && !other.empty() && one != other)
  {
    events.Note("warning: " + file.filename().string() +
                " has another frame of reference (DICOM) than the scan that it is laid over: their positions belong "
                "together only if a registration made them so");
  }
}

} // namespace rhombic
