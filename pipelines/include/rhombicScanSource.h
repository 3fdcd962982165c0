#ifndef rhombicScanSource_h
#define rhombicScanSource_h

#include "rhombicEvents.h"
#include "rhombicLabelMap.h"
#include "rhombicMeshEstimate.h"
#include "rhombicScanReader.h"
#include "rhombicScanToLattice.h"
#include "rhombicSceneRules.h"
#include "rhombicSceneSurface.h"
#include "rhombicSurfaceRequest.h"
#include "rhombicTableRemoval.h"

#include "itkFCCIsosurfaceMode.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace rhombic
{

/** The file or folder of a scan, and how the scan gets onto the lattice. */
struct ScanSource
{
  std::filesystem::path path; ///< a scan, or a lattice volume that WriteFCCImage() wrote
  ScanReadOptions read;
  LatticeSettings lattice;    ///< for lattice volumes, only the denoising has an effect
  bool streams = false;       ///< whether a lattice that does not fit is made in slabs, see ScanToLattice()
  double mostTriangles = 0.0; ///< of isosurfaces that keep all: others are only looked at (SurfaceViewing); 0: all do
  /** Called with the facts of the headers, before the voxels of a scan are read; may be empty, and may throw. */
  std::function<void(const Scan & scan)> check;
  /** Called with what isosurfaces of a scan will be, before its lattice is made; may be empty, may throw, and may put
   * them into temporary files. Called if the source \a streams. */
  std::function<void(MeshEstimate & mesh)> checkMesh;

  bool isHashed = false; ///< whether reports hold a digest of the files that were read

  std::string presetChoice; ///< which preset "auto" stands for, and why; empty if it was not asked for
};

/** The volume of a source: on a Cartesian grid, or on the lattice. */
using SourceVolume = std::variant<Scan, FCCVolume>;

/** The labels that become surfaces. */
struct LabelSelection
{
  LabelMapSource source;           ///< without a path the scan itself is the label map
  std::vector<std::string> labels; ///< names with wildcards, or values; empty: all that the label table does not hide
};

/** The surfaces that are made of a scan: isosurfaces, labels, or both. */
struct SurfaceSelection
{
  std::vector<SurfaceRequest> requests;
  std::optional<LabelSelection> labels; ///< from a label map that lies where the scan does
  /** For isosurfaces of CTs: see RemoveTable(); without effect on lattice volumes. Nothing: not removed, and a note
   * says so. */
  std::optional<bool> removesTable;
  SceneRules rules;         ///< which surfaces are shown, and in which colours
  bool lacksPreset = false; ///< the preset's surfaces are not known yet
  itk::FCCIsosurfaceMode mode = itk::FCCIsosurfaceMode::Lean;
};

/** Whether the opacity of a surface was asked for: by a rule for its name, or by its request, if it is no label's. */
bool
HasOwnOpacity(const SurfaceSelection & selection, const SceneSurface & surface);

/** Reads a scan, without notes. Throws Failure. */
Scan
ReadScan(const ScanSource & source, const Events & events);

/** Reads a scan or a lattice volume. Notes describe it and list the assumptions of the reader. Throws Failure: Geometry
 * for a scan farther than 200,000 of its shortest spacings from the origin, and what the readers throw. */
SourceVolume
LoadVolume(const ScanSource & source, const Events & events);

/** The lattice volume that surfaces are extracted from, and the scan behind it. */
struct LoadedSource
{
  std::optional<Scan> scan;                 ///< none when the source is a lattice volume or a label map
  std::optional<TableRemoval> tableRemoval; ///< objects that were removed from the scan
  FCCVolume lattice;                        ///< null without requests
  LatticeStream stream;                     ///< of a lattice that is made in slabs
  itk::ImageBase<3>::Pointer grid;          ///< grid of the scan, without values; null for no or a slanted scan
  std::vector<SurfaceRequest> requests;     ///< with their isovalues
  std::optional<LabelMap> labels;
  std::vector<std::string> warnings; ///< doubts that the labels belong to the scan (FindLabelDoubts())

  /** The scan, or the label map when that is the source; null for lattice volumes. */
  const Scan *
  FindScan() const
  {
    return scan ? &*scan : labels ? &labels->scan : nullptr;
  }

  /** Drops the lattice and the labels. The freed memory goes back to the system, so that it does not add to the memory
   * of the steps behind. */
  void
  DropVolumes();
};

/** Reads a source, removes the table if asked and resamples onto the lattice, as far as the selection needs it. Throws
 * Failure.
 *
 * \param volume the source's volume, if the caller has read the source already */
LoadedSource
LoadSource(const ScanSource & source,
           const SurfaceSelection & selection,
           std::optional<SourceVolume> volume,
           const Events & events);

/** Throws Failure(Empty) for a label map without labels, where no other surfaces are asked for. */
[[noreturn]] void
RefuseEmptyMap(const LabelMapSource & source);

/** Whether surfaces can be made of a lattice in slabs. */
bool
MayBeInSlabs(const std::vector<SurfaceRequest> & requests);

/** Throws Failure(Usage) for rules that fit none of the surfaces, where these are known without reading anything. */
void
CheckSelection(const SurfaceSelection & selection);

/** Throws Failure for an output that can't be written, that is an input, or that is named twice.
 * \param source and \param selection name inputs, \param others more of them */
void
CheckOutputs(const std::vector<std::filesystem::path> & outputs,
             const ScanSource & source,
             const SurfaceSelection & selection = {},
             const std::vector<std::filesystem::path> & others = {});

/** Warns if two DICOM volumes have different frames of reference; either may be empty for an unknown one.
 * \param file of the second */
void
NoteFramesOfReference(const std::string & one,
                      const std::string & other,
                      const std::filesystem::path & file,
                      const Events & events);

} // namespace rhombic

#endif
