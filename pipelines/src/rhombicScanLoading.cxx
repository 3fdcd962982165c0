#include "rhombicScanLoading.h"

#include "rhombicAtomicFile.h"
#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** Size and place of a scan's samples without their values; null when it is slanted. */
itk::ImageBase<3>::Pointer
GridOf(const Scan & scan)
{
  if (IsSlanted(scan))
  {
    return nullptr;
  }
  const auto grid = itk::ImageBase<3>::New();
  grid->CopyInformation(&GeometryOf(scan.image));
  return grid;
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
    RefuseToChoose(source.path);
  }
  std::vector<LabelSummary> labels = FindLabels(scan, source);
  events.Note(source.path.string() + " is a label map of " + Count(labels.size(), "label") +
              ", of which surfaces are made");
  return { std::move(scan), std::move(labels) };
}

LabelMap
LoadLabels(const ScanSource & source, const LabelMapSource & labels, const Scan & scan, const Events & events)
{
  events.Progress("reading labels", 0.0);
  LabelMap map = ReadLabelMap(labels, source.read, scan, source.path);
  events.Note(Count(map.labels.size(), "label") + " in " + labels.path.string());
  for (const std::string & note : map.scan.notes)
  {
    events.Note(note);
  }
  return map;
}

LoadedSource
LoadLatticeVolume(const ScanSource & source, const SurfaceSelection & selection, const Events & events)
{
  if (selection.labels && selection.labels->source.path.empty())
  {
    RefuseToChoose(source.path);
  }
  if (selection.labels)
  {
    throw Failure(FailureKind::Usage,
                  "Labels need the scan that they belong to, and " + source.path.string() +
                    " is a lattice volume; name the scan, or the label map itself.");
  }
  events.Progress("reading", 0.0);
  LoadedSource loaded;
  loaded.lattice = ReadFCCImage(source.path);
  loaded.requests = ResolveIsovalues(selection.requests, ComputeIntensities(loaded.lattice));
  loaded.lattice = DenoiseLattice(loaded.lattice, source.lattice.denoising, source.lattice.maximumMemory, events);
  return loaded;
}

LoadedSource
LoadScanAndLabels(const ScanSource & source, const SurfaceSelection & selection, const Events & events)
{
  CheckLatticeSettings(source.lattice);
  LoadedSource loaded;
  loaded.scan = LoadScan(source, events);
  Scan & scan = *loaded.scan;
  loaded.report["scan"] = ReportWithoutNames(scan, source.path);
  loaded.isOriented = scan.isOriented;
  if (selection.labels && selection.labels->source.path.empty())
  {
    loaded.labels = TakeForLabels(std::move(scan), { source.path, selection.labels->source.table }, events);
    loaded.scan.reset(); // surfaces of labels have no mean of its values
    return loaded;
  }
  if (selection.labels)
  {
    loaded.labels = LoadLabels(source, selection.labels->source, scan, events);
  }
  if (selection.requests.empty())
  {
    return loaded;
  }
  if (IsTableRemoved(selection.table, scan))
  {
    loaded.report["removed"] = ReportTableRemoval(RemoveTable(scan, events));
  }
  loaded.requests = ResolveIsovalues(selection.requests, ComputeIntensities(scan.image));
  loaded.lattice = ScanToLattice(scan, source.lattice, events);
  loaded.grid = GridOf(scan);
  return loaded;
}

void
CheckOutput(const fs::path & output, const fs::path & input)
{
  std::error_code error;
  if (fs::equivalent(output, input, error))
  {
    throw Failure(FailureKind::Usage, "The output " + output.string() + " is the input itself; give it another name.");
  }
}

} // namespace

std::vector<fs::path>
InputsOf(const ScanSource & source, const SurfaceSelection & selection)
{
  std::vector<fs::path> inputs{ source.path };
  if (selection.labels)
  {
    inputs.push_back(selection.labels->source.path);
    inputs.push_back(selection.labels->source.table);
  }
  return inputs;
}

void
CheckOutputs(const std::vector<fs::path> & outputs, const std::vector<fs::path> & inputs)
{
  std::set<fs::path> seen;
  for (const fs::path & output : outputs)
  {
    for (const fs::path & input : inputs)
    {
      CheckOutput(output, input);
    }
    const AtomicFile probe(output);
    std::error_code ignored;
    if (!seen.insert(fs::weakly_canonical(fs::absolute(output), ignored)).second)
    {
      throw Failure(FailureKind::Usage,
                    "Two outputs would be the same file, " + output.string() + "; give one of them another name.");
    }
  }
}

Scan
LoadScan(const ScanSource & source, const Events & events)
{
  events.Progress("reading", 0.0);
  ScanReadOptions options = source.read;
  options.progress = [&events](double fraction) { events.Progress("reading", fraction); };
  Scan scan = ReadScan(source.path, options);
  const auto & geometry = GeometryOf(scan.image);
  const auto & size = geometry.GetLargestPossibleRegion().GetSize();
  const auto & spacing = geometry.GetSpacing();
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << scan.format << (scan.modality.empty() ? "" : " " + scan.modality) << ": " << size[0] << " x " << size[1]
       << " x " << size[2] << " samples, spacing " << spacing[0] << " x " << spacing[1] << " x " << spacing[2]
       << " mm, " << PixelTypeName(scan.image);
  events.Note(text.str());
  for (const auto * const notes : { &scan.notes, &scan.fileNotes })
  {
    for (const std::string & note : *notes)
    {
      events.Note(note);
    }
  }
  return scan;
}

Report
ReportWithoutNames(const Scan & scan, const fs::path & path)
{
  Report report = ReportScan(scan);
  for (Report & note : report["notes"])
  {
    auto text = note.get<std::string>();
    for (const std::string & name : { path.string(), path.filename().string(), path.stem().string() })
    {
      for (std::size_t at = text.find(name); !name.empty() && at != std::string::npos; at = text.find(name, at + 4))
      {
        text.replace(at, name.size(), "SCAN");
      }
    }
    note = text;
  }
  return report;
}

LoadedSource
LoadSource(const ScanSource & source, const SurfaceSelection & selection, const Events & events)
{
  LoadedSource loaded = IsFCCImageFile(source.path) ? LoadLatticeVolume(source, selection, events)
                                                    : LoadScanAndLabels(source, selection, events);
  if (!loaded.requests.empty())
  {
    loaded.report["denoising"] = ReportDenoising(source.lattice.denoising);
    loaded.report["lattice"] = ReportLattice(loaded.lattice);
  }
  return loaded;
}

Report
ReportSurface(const SurfaceRequest & request, const ExtractedSurface & surface, itk::FCCIsosurfaceMode mode)
{
  std::ostringstream modeName;
  modeName << mode;
  Report report = { { "name", request.name },
                    { "isovalue", request.isovalue.value() },
                    { "inside", request.side == SurfaceRequest::Side::Above ? "above" : "below" },
                    { "mode", modeName.str() },
                    { "points", surface.scene.surface->GetNumberOfPoints() },
                    { "triangles", surface.scene.surface->GetNumberOfTriangles() } };
  if (surface.enclosed)
  {
    report["enclosed"] = { { "leftOutAroundBodyInMillilitres", surface.enclosed->aroundBody },
                           { "leftOutSmallParts", surface.enclosed->numberOfSmall },
                           { "leftOutSmallPartsInMillilitres", surface.enclosed->small },
                           { "keptPartsCutBySides", surface.enclosed->numberCutBySides } };
  }
  return report;
}

LabelSurfaceSettings
GetLabelSettings(const ScanSource & source, const SurfaceSelection & selection)
{
  LabelSurfaceSettings settings;
  settings.labels = selection.labels->labels;
  settings.density = source.lattice.density;
  settings.mode = selection.mode;
  settings.maximumMemory = source.lattice.maximumMemory;
  return settings;
}

} // namespace rhombic
