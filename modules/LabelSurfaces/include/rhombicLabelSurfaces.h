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
 * Surfaces of labels. Thread safety: the structs are values, but that copies of a LabelSurface share its surface. */

/** Which labels get a surface, and how it is made. */
struct LabelSurfaceSettings
{
  std::vector<std::string> labels;                  ///< names or values; empty: all that the label table wants shown
  double density = itk::FCCLattice::NyquistDensity; ///< lattice sites per voxel
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
  std::size_t pieces = 0;          ///< of the label: voxels connected through faces, edges or corners
  std::size_t surfacePieces = 0;   ///< of the surface: closed shells that enclose something
  bool isTorn = false;             ///< whether the surface has more pieces than there would be if voxels were connected
                                   ///< through faces only
  std::size_t finerPieces = 0;     ///< pieces that took a lattice finer than asked for
  std::size_t protectedVoxels = 0; ///< voxels of parts so thin that smoothing would have lost them

  /** The surface's volume against the voxels', relative: 0 where they agree. */
  double
  GetVolumeDifference() const
  {
    return surfaceMillilitres / voxelMillilitres - 1.0;
  }
};

/** A closed surface for each label, in the order of their values, without the steps of the voxels.
 *
 * Each piece of a label (voxels connected through faces, edges or corners) becomes a smooth field
 * (itk::AntiAliasMaskImageFilter), is resampled onto the lattice and extracted at the level at which it has its voxels'
 * volume. A piece that comes out in several parts, or more than 1 % off its volume, or, when it is thin (at least a
 * quarter of it), with holes that its voxels don't have, is made again on finer and finer lattices, as long as that
 * helps: up to 8 times the sites, or 64 times on small ones. Where voxels of broader parts touch at edges or corners
 * only, the surface may or may not be connected.
 *
 * Where a label reaches the scan's border, its surface closes at the outer faces of the voxels there. A hollow label
 * has shells inside, too. Tilted, sheared and unevenly spaced stacks keep their true places
 * (itk::CartesianToFCCImageFilter). Neighbouring labels get the same wall, each its own, within 0.1 voxels.
 *
 * Labels are worked on one after the other, each piece in its own box, on all threads; the result has the same bytes
 * for any number of them.
 *
 * Throws Failure: Usage for a density that makes no lattice and for labels that the map doesn't hold; Empty when there
 * is none to show; Memory, before the work on a piece, for one that is too large. Thread safe. */
std::vector<LabelSurface>
LabelsToSurfaces(const LabelMap & map, const LabelSurfaceSettings & settings, const Events & events);

} // namespace rhombic

#endif
