#ifndef rhombicLabelSurfaces_h
#define rhombicLabelSurfaces_h

#include "rhombicEvents.h"
#include "rhombicLabelMapReader.h"
#include "rhombicSceneSurface.h"

#include "itkFCCIsosurfaceMode.h"
#include "itkFCCLattice.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Surfaces of labels. Copies of a LabelSurface share its surface. */

/** Which labels get a surface, and how it is made. */
struct LabelSurfaceSettings
{
  std::vector<std::string>
    labels; ///< names with wildcards (see MatchesPattern()), or values; empty: all that the label table shows
  double density = itk::FCCLattice::DefaultDensity; ///< lattice sites per voxel
  itk::FCCIsosurfaceMode mode = itk::FCCIsosurfaceMode::Lean;
  std::uintmax_t maximumMemory = 0; ///< for the work on one piece of a label, in bytes; 0: half of what is free
};

/** The surface of a label, in the label's name, colour and opacity, and how it compares with the label's voxels. */
struct LabelSurface
{
  SceneSurface scene;
  std::int32_t value = 0;
  std::size_t numberOfVoxels = 0;
  double voxelMillilitres = 0.0;
  double surfaceMillilitres = 0.0;
  std::size_t pieces = 0;        ///< pieces of the label: voxels connected through faces, edges or corners
  std::size_t surfacePieces = 0; ///< pieces of the surface: closed shells of positive volume
  bool isTorn = false;           ///< more pieces than the label has, even than its voxels connected through faces alone
  std::size_t finerPieces = 0;   ///< pieces whose lattice is finer than asked for
  std::size_t protectedVoxels = 0; ///< voxels of parts so thin that smoothing would have lost them
  bool sharesWalls = false;        ///< made by LabelsToWalls()

  /** The relative difference between the volumes of surface and voxels. */
  double
  GetVolumeDifference() const
  {
    return surfaceMillilitres / voxelMillilitres - 1.0;
  }
};

/** A closed surface for each label, in the order of their values, without the steps of the voxels.
 *
 * Each piece of a label (voxels connected through faces, edges or corners) becomes a smooth field
 * (itk::AntiAliasMaskImageFilter), is resampled onto the lattice, and is extracted at the level that encloses its
 * voxels' volume. It is made again on finer lattices, as long as that helps, if it comes out in several parts or more
 * than 1 % off its volume, or if it is thin (a quarter of its voxels or more) and has holes that its voxels don't have:
 * with up to 8 times the sites, or 64 times on small lattices. Where voxels of broader parts touch at edges or corners
 * only, the surface may or may not be connected.
 *
 * Where a label reaches the scan's border, its surface closes at the outer faces of the voxels there. A hollow label
 * has shells inside, too. Slices may be tilted, sheared or unevenly spaced (itk::CartesianToFCCImageFilter). The walls
 * that two neighbouring labels share are extracted for each; they agree within 0.1 voxels. LabelsToWalls() makes them
 * once for both.
 *
 * Works on one piece after another, each on all threads. The result has the same bytes for any number of threads.
 *
 * Throws Failure: Usage for a density that is not above 0 and at most 64, and for labels that the map doesn't hold;
 * Empty when there is none to show; Memory, before the work on a piece, for one that is too large. */
std::vector<LabelSurface>
LabelsToSurfaces(const LabelMap & map, const LabelSurfaceSettings & settings, const Events & events);

} // namespace rhombic

#endif
