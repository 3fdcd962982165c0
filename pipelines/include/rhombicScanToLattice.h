#ifndef rhombicScanToLattice_h
#define rhombicScanToLattice_h

#include "rhombicDenoising.h"
#include "rhombicEvents.h"
#include "rhombicFCCImageFile.h"
#include "rhombicScan.h"
#include "rhombicVoxelGrid.h"

#include "itkFCCLattice.h"
#include "itkProcessObject.h"
#include "itkSeparableTaps.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace rhombic
{

/** The lattice that a scan is resampled onto. A volume that is on a lattice already is only denoised. */
struct LatticeSettings
{
  double density = itk::FCCLattice::DefaultDensity; ///< lattice sites per sample of the scan
  std::array<double, 3> spacing{ 0.0, 0.0, 0.0 };   ///< lattice spacing in mm (see itk::FCCImage); 0: from the density
  itk::SeparableKernel kernel = itk::SeparableKernel::CubicBSpline;
  std::uintmax_t maximumMemory = 0; ///< bytes for scan and lattice; 0: the lattice takes half of the free memory
  Denoising denoising;              ///< none by default
  bool nested = false; ///< takes every other sample of the scan instead, without interpolation; density 0.5
};

/** The memory that surfaces of a lattice need, in bytes. */
struct SurfaceBytes
{
  std::uintmax_t besideSlab = 0; ///< beside a slab of the lattice, while they are extracted
  std::uintmax_t afterwards = 0; ///< while they are untangled and written, when the lattice is gone
};

/** How a lattice is made within the memory that is allowed. */
struct LatticePlan
{
  std::uintmax_t scanBytes = 0;        ///< of the scan in memory, if they count
  std::uintmax_t latticeBytes = 0;     ///< of the whole lattice, twice where it is smoothed
  itk::SizeValueType planesOfSlab = 0; ///< 0 for a lattice that is whole
  unsigned int slabs = 1;
  std::uintmax_t peak = 0; ///< of scan, lattice or slab, and what is made beside a slab
};

/** For a lattice that is made in slabs when the whole of it does not fit. */
struct LatticeStream
{
  SurfaceBytes surfaces;        ///< what surfaces made of the lattice need
  bool mayBeInSlabs = true;     ///< otherwise it must fit
  std::uintmax_t scanBytes = 0; ///< of a scan that has no voxels yet: what it will take of the memory
  bool onlyPlans = false;       ///< nothing is made but the plan, and a lattice without samples
  std::function<void()> check;  ///< called when the lattice's size is known to be right; may be empty, and may throw

  LatticePlan plan;
  std::vector<itk::ProcessObject::Pointer> sources; ///< make the slabs, one behind the other; none for a whole lattice
};

/** A denoising written as `none`, `gaussian:SIGMA` or `edges:SIGMA,EDGE`. Throws Failure(Usage). */
Denoising
ParseDenoising(const std::string & text);

/** Throws Failure(Usage) for settings out of their ranges. */
void
CheckLatticeSettings(const LatticeSettings & settings);

/** Resamples a scan onto the lattice, in its own pixel type (itk::CartesianToFCCImageFilter, or
 * itk::CartesianToNestedFCCImageFilter). Sites beside tilted, sheared or uneven slices get the scan's lowest value.
 * Edge-preserving denoising is applied to the scan before, Gaussian denoising to the lattice after. Notes give the
 * lattice's size.
 *
 * Throws Failure: Usage for settings out of range, for labels that overlap, for a nested lattice or edge-preserving
 * denoising of a slanted scan, and for a lattice of too many or no sites; Memory, before any work, with a density that
 * would fit; and those of DenoiseScan().
 *
 * \param stream if not null, a lattice that does not fit is no failure: its buffer then holds as many planes as fit,
 * and its sources, which \a stream keeps, make others when they are asked for (itk::ForEachLoadedPart(), and
 * itk::FCCIsosurfaceFilter with the divisions of FindDivisions()). Pages of a mapped scan are dropped behind each slab.
 * A note tells the number of slabs. */
FCCVolume
ScanToLattice(const Scan & scan,
              const LatticeSettings & settings,
              const Events & events,
              LatticeStream * stream = nullptr);

/** In how many slabs a lattice is made, one after the other: 1 for one that is whole in its buffer. */
unsigned int
FindDivisions(const FCCVolume & lattice);

/** Resamples a lattice volume onto a Cartesian grid (itk::FCCToCartesianImageFilter). Throws Failure(Usage) for a
 * spacing that makes no grid.
 * \param spacing of the grid in mm; 0: that of a grid on which the lattice has density 0.77 */
ScanImage
LatticeToScan(const FCCVolume & volume, const std::array<double, 3> & spacing, const Events & events);

} // namespace rhombic

#endif
