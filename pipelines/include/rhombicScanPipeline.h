#ifndef rhombicScanPipeline_h
#define rhombicScanPipeline_h

#include "rhombicEvents.h"
#include "rhombicIntensities.h"
#include "rhombicLabelMapReader.h"
#include "rhombicLatticePipeline.h"
#include "rhombicPictureIO.h"
#include "rhombicScanReader.h"
#include "rhombicSidecar.h"
#include "rhombicSurfaceRequest.h"
#include "rhombicTableRemoval.h"

#include <filesystem>
#include <vector>

namespace rhombic
{

/** \file
 * From scans to pictures and volumes. Thread safety: the structs are values; copies of those with
 * ScanReadOptions share the decoder. */

/** Where a scan is, and how it gets onto the lattice. */
struct ScanSource
{
  std::filesystem::path path; ///< anything ReadScan() reads, or a lattice volume that WriteFCCImage() wrote
  ScanReadOptions read;
  LatticeSettings lattice; ///< on lattice volumes, only its denoising has an effect
};

/** The surfaces of a label map. */
struct LabelSelection
{
  LabelMapSource source;           ///< with an empty path: the scan itself is the label map
  std::vector<std::string> labels; ///< names or values; empty: all that the label table wants shown
};

/** Which surfaces are made of a scan: isosurfaces, labels, or both. */
struct SurfaceSelection
{
  std::vector<SurfaceRequest> requests;
  std::optional<LabelSelection> labels;      ///< of a map that lies where the scan does
  TableRule table = TableRule::RemoveFromCT; ///< for the requests; without effect on lattice volumes
  itk::FCCIsosurfaceMode mode = itk::FCCIsosurfaceMode::Lean;
};

/** From a scan to pictures of its surfaces. */
struct RenderScanSettings
{
  ScanSource source;
  SurfaceSelection surfaces;
  RenderSettings render; ///< its view is set from the list below, its memory is the source's
  std::vector<View> views{ View::Anterior };
  std::filesystem::path picture; ///< with more than one view, the view's name is added to the stem
  Provenance provenance;
};

/** Renders a scan; returns the pictures' paths. Like the others, writes a sidecar for each output. Throws Failure, for
 * pictures that take more memory than the source allows before the scan is read.
 * Thread safe for different outputs. */
std::vector<std::filesystem::path>
RenderScan(const RenderScanSettings & settings, const Events & events);

/** From a scan to a lattice volume, or from a lattice volume to a Cartesian one. */
struct ResampleScanSettings
{
  ScanSource source;
  std::filesystem::path volume; ///< .nrrd for a lattice volume; .nrrd, .nii, .nii.gz, .mha for a Cartesian one
  Provenance provenance;
};

/** Resamples a scan onto the lattice, or, when the source is a lattice volume, back; the source's lattice spacing is
 * then that of the grid. Throws Failure. Thread safe for different outputs. */
void
ResampleScan(const ResampleScanSettings & settings, const Events & events);

/** Makes sure that every request's isovalue is known and lies where there can be a surface. Throws Failure(Empty),
 * naming the volume's range. Thread safe. */
std::vector<SurfaceRequest>
ResolveIsovalues(std::vector<SurfaceRequest> requests, const Intensities & intensities);

} // namespace rhombic

#endif
