#ifndef rhombicMeshScan_h
#define rhombicMeshScan_h

#include "rhombicBulkMemory.h"
#include "rhombicColourBy.h"
#include "rhombicEvents.h"
#include "rhombicLabelSurfaces.h"
#include "rhombicScanSource.h"
#include "rhombicSidecar.h"
#include "rhombicSurfaceFinish.h"
#include "rhombicSurfaceIO.h"
#include "rhombicSurfaceMemory.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace rhombic
{

/** From a scan to surface files. */
struct MeshScanSettings
{
  ScanSource source;
  SurfaceSelection surfaces;
  SurfaceFinish finish;
  std::filesystem::path mesh; ///< a file for all surfaces, or a file for each if the name holds {name}
  SurfaceFileSpace space = SurfaceFileSpace::LPS;
  std::filesystem::path measures; ///< table of measures: .csv, or .json with more; empty: none
  bool audits = false;            ///< also tests for self-intersections, and measures the deviation everywhere
  bool requiresWatertight = false;
  std::optional<ColourBy> colourBy; ///< of the points of PLY, VTP and GLB files, in place of the surfaces' colours
  double minimumThickness = 0.0;    ///< mm; above 0: notes and reports say where walls are thinner (FindThinParts())
  Provenance provenance;
};

/** The place of a surface's name in the name of a file. */
constexpr char NamePlaceholder[] = "{name}";

/** Checks the settings, without reading or writing anything. Returns the files that MeshScan() writes; names of
 * surfaces, which are not known yet, are NamePlaceholder. Throws Failure(Usage). */
std::vector<std::filesystem::path>
CheckMeshScan(const MeshScanSettings & settings);

/** FitIntoMemory(). Throws Failure(Memory) for surfaces that neither the memory (all that is free, without a limit) nor
 * temporary files can hold, and for those that the file can't hold. MeshScan() calls it before its work. A denoised
 * scan, whose surfaces may be far smaller, is not refused; surfaces of up to 4 MiB are never too large for the memory.
 */
void
CheckMesh(MeshEstimate & mesh, const MeshScanSettings & settings);

/** The settings' surfaces. */
SurfaceWork
WorkOf(const MeshScanSettings & settings);

/** Writes surfaces of a scan; returns all files. Measures and the distance from the scan's isosurface are taken
 * while a file is written, and hold for it, as it is read back and compared; the audit is that of the surface read
 * back. Notes give the main figures; sidecars and the table hold all of them, and what finishing changed. All files
 * appear together at the end, or none does.
 *
 * \param volume the source's volume, if the caller has read the source already
 *
 * Throws Failure, also for a surface that has to be watertight and is not. */
std::vector<MadeFile>
MeshScan(const MeshScanSettings & settings, const Events & events, std::optional<SourceVolume> volume = std::nullopt);

} // namespace rhombic

#endif
