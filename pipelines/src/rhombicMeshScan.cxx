#include "rhombicMeshScan.h"

#include "rhombicFailure.h"
#include "rhombicFileInspection.h"
#include "rhombicMeasureTable.h"
#include "rhombicSurfaceReport.h"

#include <algorithm>
#include <set>
#include <utility>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

bool
HasFileForEach(const fs::path & mesh)
{
  return mesh.filename().string().find(NamePlaceholder) != std::string::npos;
}

/** The file's name with the placeholder replaced. */
std::string
InsertName(std::string file, const std::string & name)
{
  std::size_t begin = 0;
  while ((begin = file.find(NamePlaceholder, begin)) != std::string::npos)
  {
    file.replace(begin, sizeof(NamePlaceholder) - 1, name);
    begin += name.size();
  }
  return file;
}

/** The files' paths, one for each surface or one for all; no two are the same. */
std::vector<fs::path>
PathsOf(const fs::path & mesh, const std::vector<MeshedSurface> & surfaces)
{
  if (!HasFileForEach(mesh))
  {
    return { mesh };
  }
  std::set<std::string> taken;
  std::vector<fs::path> paths;
  for (const MeshedSurface & surface : surfaces)
  {
    const std::string name = FileStemOf(surface.scene.name);
    std::string unique = name;
    for (int number = 2; !taken.insert(unique).second; ++number)
    {
      unique = name + '-' + std::to_string(number);
    }
    paths.push_back(mesh.parent_path() / InsertName(mesh.filename().string(), unique));
  }
  return paths;
}

/** All files that are written for surface files. */
std::vector<fs::path>
OutputsOf(const std::vector<fs::path> & meshes, const MeshScanSettings & settings)
{
  std::vector<fs::path> outputs;
  for (const fs::path & mesh : meshes)
  {
    const std::vector<fs::path> files = SurfaceFilesOf(mesh);
    outputs.insert(outputs.end(), files.begin(), files.end());
    if (settings.provenance.writesSidecars)
    {
      outputs.push_back(SidecarOf(mesh));
    }
  }
  if (!settings.measures.empty())
  {
    outputs.push_back(settings.measures);
  }
  return outputs;
}

/** Throws Failure(Usage) for a file that can't hold all surfaces of a source, of which the surfaces are not yet made.
 */
void
CheckNumberOfSurfaces(const LoadedSource & loaded, const MeshScanSettings & settings)
{
  std::size_t fewest = loaded.requests.size();
  if (loaded.labels)
  {
    const auto & labels = loaded.labels->labels;
    const auto shown = std::count_if(labels.begin(), labels.end(), [](const LabelSummary & summary) {
      return summary.label.isVisible && summary.label.opacity > 0.0;
    });
    const bool areAllKept = settings.surfaces.labels->labels.empty() && settings.finish.minimumVolume == 0.0;
    fewest += areAllKept ? static_cast<std::size_t>(shown) : 1;
  }
  CheckSurfacePath(settings.mesh, HasFileForEach(settings.mesh) ? 1 : fewest);
}

} // namespace

std::vector<fs::path>
CheckMeshScan(const MeshScanSettings & settings)
{
  const bool showsAll = settings.surfaces.rules.only.empty() && settings.surfaces.rules.hidden.empty();
  const std::size_t fewest = showsAll ? settings.surfaces.requests.size() + (settings.surfaces.labels ? 1 : 0) : 1;
  CheckSurfacePath(settings.mesh, HasFileForEach(settings.mesh) ? 1 : fewest);
  CheckSurfaceFinish(settings.finish);
  CheckSelection(settings.surfaces);
  if (!settings.measures.empty())
  {
    CheckMeasureTablePath(settings.measures);
  }
  return OutputsOf({ settings.mesh }, settings);
}

std::vector<MadeFile>
MeshScan(const MeshScanSettings & settings, const Events & events, std::optional<SourceVolume> volume)
{
  CheckOutputs(CheckMeshScan(settings), settings.source, settings.surfaces);
  LoadedSource loaded = LoadSource(settings.source, settings.surfaces, std::move(volume), events);
  CheckNumberOfSurfaces(loaded, settings);
  Report sourceReport = ReportSource(loaded, settings.source);
  SourceSurfaces making(settings.source, settings.surfaces, settings.finish, SurfaceUse::Files, events);
  std::vector<MeshedSurface> surfaces = making.Extract(loaded, StoresNormals(settings.mesh));
  loaded.DropVolumes();
  CheckOutputs(OutputsOf(PathsOf(settings.mesh, surfaces), settings), settings.source, settings.surfaces);
  making.Finish(surfaces);

  const FileInspection inspection{ settings, loaded.scan, events };
  const std::vector<fs::path> paths = PathsOf(settings.mesh, surfaces);
  const std::size_t perFile = HasFileForEach(settings.mesh) ? 1 : surfaces.size();
  CheckSurfacePath(paths.front(), perFile);
  if ((settings.audits || settings.requiresWatertight) && surfaces.back().label)
  {
    if (const auto walls = AuditTogether(inspection, surfaces))
    {
      sourceReport["walls"] = *walls;
    }
  }
  OutputFiles outputs{ settings.provenance };
  for (std::size_t n = 0; n < paths.size(); ++n)
  {
    events.Progress("writing and measuring", static_cast<double>(n) / static_cast<double>(paths.size()));
    StageInspected(inspection, paths[n], surfaces.data() + n * perFile, perFile, sourceReport, outputs);
    const std::vector<fs::path> files = SurfaceFilesOf(paths[n]);
    AddOutputs({ files.begin() + 1, files.end() }, "mesh", outputs.made, false);
  }
  if (!settings.measures.empty())
  {
    StageMeasureTable(surfaces, settings.measures, outputs.staged);
    AddOutputs({ settings.measures }, "table", outputs.made, false);
  }
  outputs.staged.Commit();
  events.Progress("writing and measuring", 1.0);
  return outputs.made;
}

} // namespace rhombic
