#ifndef rhombicMeshPipeline_h
#define rhombicMeshPipeline_h

#include "rhombicScanPipeline.h"
#include "rhombicSurfaceFinish.h"
#include "rhombicSurfaceIO.h"

#include <filesystem>
#include <vector>

namespace rhombic
{

/** From a scan to surface files. Thread safety: a value, whose copies share a decoder. */
struct MeshScanSettings
{
  ScanSource source;
  SurfaceSelection surfaces;
  SurfaceFinish finish;
  /** One file for all surfaces, or, where its name holds {name}, a file for each. */
  std::filesystem::path mesh;
  SurfaceFileSpace space = SurfaceFileSpace::LPS;
  std::filesystem::path measures; ///< a table of them: .csv, or .json with more; empty: none
  bool audits = false;            ///< also tests for self-intersections, and measures the deviation everywhere
  bool requiresWatertight = false;
  Provenance provenance;
};

/** Writes surfaces of a scan; returns the files' paths. Volume, area and all other measures, the distance from the
 * scan's isosurface and the audit are those of the file, read back; what finishing changed since extraction is told
 * beside them. Notes hold the main figures, sidecars and the table all of them. All files appear together at the end,
 * or none does.
 *
 * Throws Failure, also when a surface is not watertight and has to be. Thread safe for different
 * outputs. */
std::vector<std::filesystem::path>
MeshScan(const MeshScanSettings & settings, const Events & events);

} // namespace rhombic

#endif
