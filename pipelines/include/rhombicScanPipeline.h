#ifndef rhombicScanPipeline_h
#define rhombicScanPipeline_h

#include "rhombicEvents.h"
#include "rhombicIntensities.h"
#include "rhombicLatticePipeline.h"
#include "rhombicPictureIO.h"
#include "rhombicScanReader.h"
#include "rhombicSidecar.h"
#include "rhombicSurfaceRequest.h"

#include <filesystem>
#include <vector>

namespace rhombic
{

/** Where a scan is, and how it gets onto the lattice. */
struct ScanSource
{
  std::filesystem::path path; ///< anything ReadScan() reads, or a lattice volume that WriteFCCImage() wrote
  ScanReadOptions read;
  LatticeSettings lattice; ///< without effect on lattice volumes
};

/** From a scan to pictures of its surfaces. */
struct RenderScanSettings
{
  ScanSource source;
  std::vector<SurfaceRequest> surfaces;
  itk::FCCIsosurfaceMode mode = itk::FCCIsosurfaceMode::Lean;
  RenderSettings render; ///< its view is set from the list below
  std::vector<View> views{ View::Anterior };
  std::filesystem::path picture; ///< with more than one view, the view's name is added to the stem
  Provenance provenance;
};

/** Renders a scan; returns the pictures' paths. Like the others, writes a sidecar for each output. Throws Failure. */
std::vector<std::filesystem::path>
RenderScan(const RenderScanSettings & settings, const Events & events);

/** From a scan to one surface file. */
struct MeshScanSettings
{
  ScanSource source;
  SurfaceRequest surface;
  itk::FCCIsosurfaceMode mode = itk::FCCIsosurfaceMode::Lean;
  std::filesystem::path mesh; ///< .stl, .ply, .obj, .vtp or .glb
  Provenance provenance;
};

/** Writes the surface of a scan. Throws Failure. */
void
MeshScan(const MeshScanSettings & settings, const Events & events);

/** From a scan to a lattice volume, or from a lattice volume to a Cartesian one. */
struct ResampleScanSettings
{
  ScanSource source;
  std::filesystem::path volume; ///< .nrrd for a lattice volume; .nrrd, .nii, .nii.gz, .mha for a Cartesian one
  Provenance provenance;
};

/** Resamples a scan onto the lattice, or, when the source is a lattice volume, back; the source's lattice spacing is
 * then that of the grid. Throws Failure. */
void
ResampleScan(const ResampleScanSettings & settings, const Events & events);

/** Makes sure that every request's isovalue is known and lies where there can be a surface. Throws Failure(Empty),
 * naming the volume's range. */
std::vector<SurfaceRequest>
ResolveIsovalues(std::vector<SurfaceRequest> requests, const Intensities & intensities);

} // namespace rhombic

#endif
