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

/** Writes surfaces of a scan; returns the files' paths. Each surface is measured as it was extracted; how far it is
 * from the scan's isosurface, and its audit, are those of the file, read back. Notes say both, and sidecars all of it.
 *
 * Throws Failure, also when a surface is not watertight and has to be: then there is no file. Thread safe for different
 * outputs. */
std::vector<std::filesystem::path>
MeshScan(const MeshScanSettings & settings, const Events & events);

} // namespace rhombic

#endif
