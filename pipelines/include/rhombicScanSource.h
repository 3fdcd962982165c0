#ifndef rhombicScanSource_h
#define rhombicScanSource_h

#include "rhombicLabelMap.h"
#include "rhombicScanReader.h"
#include "rhombicScanToLattice.h"
#include "rhombicSceneRules.h"
#include "rhombicSurfaceRequest.h"

#include "itkFCCIsosurfaceMode.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace rhombic
{

/** \class ScanSource
 * \brief The file or folder of a scan, and how the scan gets onto the lattice. Copies share the decoder. */
struct ScanSource
{
  std::filesystem::path path; ///< a scan, or a lattice volume that WriteFCCImage() wrote
  ScanReadOptions read;
  LatticeSettings lattice; ///< for lattice volumes, only the denoising has an effect
  /** Called with what the headers tell, before the voxels of a scan are read; may be empty, and may throw. */
  std::function<void(const Scan & scan)> check;

  bool isHashed = false; ///< whether reports hold a digest of the files that were read

  std::string presetChoice; ///< which preset "auto" stands for, and why; empty if it was not asked for
};

/** What a source holds: a volume on a Cartesian grid, or on the lattice. */
using SourceVolume = std::variant<Scan, FCCVolume>;

/** \class LabelSelection
 * \brief The labels that become surfaces. */
struct LabelSelection
{
  LabelMapSource source;           ///< without a path the scan itself is the label map
  std::vector<std::string> labels; ///< names with wildcards, or values; empty: all that the label table does not hide
};

/** \class SurfaceSelection
 * \brief The surfaces that are made of a scan: isosurfaces, labels, or both. */
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

} // namespace rhombic

#endif
