#ifndef rhombicLatticePipeline_h
#define rhombicLatticePipeline_h

#include "rhombicDenoising.h"
#include "rhombicEnclosedParts.h"
#include "rhombicEvents.h"
#include "rhombicFCCImageFile.h"
#include "rhombicScan.h"
#include "rhombicSurfaceRequest.h"

#include "itkFCCIsosurfaceMode.h"
#include "itkFCCLattice.h"
#include "itkSeparableTaps.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace rhombic
{

/** \class LatticeSettings
 * \brief Which lattice a scan is resampled onto, and how. On volumes that are on a lattice already, noise alone is
 * taken out.
 *
 * Thread safety: a value. */
struct LatticeSettings
{
  double density = itk::FCCLattice::NyquistDensity; ///< lattice sites per sample of the scan
  std::array<double, 3> spacing{ 0.0, 0.0, 0.0 };   ///< of the lattice in mm (see itk::FCCImage); 0: from the density
  itk::SeparableKernel kernel = itk::SeparableKernel::CubicBSpline;
  std::uintmax_t maximumMemory = 0; ///< for scan and lattice, in bytes; 0: the lattice takes half of what is free
  Denoising denoising;              ///< none by default
  bool nested = false;              ///< instead: every other sample of the scan, without interpolation; density 0.5
};

/** The spacing in mm that a grid or lattice of as many samples would have if it were the same along all axes. Thread
 * safe. */
double
MeanSpacingOf(const itk::ImageBase<3> & image);

/** Whether the scan's samples are not those of perpendicular, evenly divided axes. Thread safe. */
bool
IsSlanted(const Scan & scan);

/** Throws Failure(Usage) for settings that make no lattice of any scan. Thread safe. */
void
CheckLatticeSettings(const LatticeSettings & settings);

/** The scan on the lattice, in its own pixel type (itk::CartesianToFCCImageFilter, or
 * itk::CartesianToNestedFCCImageFilter). Where its slices are tilted, sheared or unevenly spaced, what is beside them
 * gets its lowest value. Noise is taken out first where edges are preserved, else last. Throws Failure: Usage for
 * settings that make no lattice, or none of such a scan; Memory, before any work, for a lattice that is too large; and
 * those of DenoiseScan(). Thread safe for different scans. */
FCCVolume
ScanToLattice(const Scan & scan, const LatticeSettings & settings, const Events & events);

/** The volume on a Cartesian grid of the given spacing in mm; 0: that which makes the lattice's samples 0.77 times as
 * many (itk::FCCToCartesianImageFilter). Throws Failure(Usage) for a spacing that makes no grid. Thread safe for
 * different volumes. */
ScanImage
LatticeToScan(const FCCVolume & volume, const std::array<double, 3> & spacing, const Events & events);

/** A surface of a lattice volume. Thread safety: a value. */
struct ExtractedSurface
{
  SceneSurface scene;
  std::optional<EnclosedParts> enclosed; ///< if they were asked for
};

/** A closed isosurface of the volume for each request, in its order, made as the mode says; those on the same side of
 * their isovalues are extracted in one pass over the volume. Where the scan ends, surfaces are closed by walls: on the
 * outer faces of the lattice, or, when it is known, of the grid's voxels. Throws Failure: Usage for a request without
 * an isovalue (see ResolveIsovalues()), Empty for a surface without triangles. Thread safe for different volumes.
 * \param grid of the scan that the volume was made from, if it is not slanted */
std::vector<ExtractedSurface>
ExtractSurfaces(const FCCVolume & volume,
                const std::vector<SurfaceRequest> & requests,
                itk::FCCIsosurfaceMode mode,
                const Events & events,
                const itk::ImageBase<3> * grid = nullptr);

/** As ExtractSurfaces(), but returns the surfaces only. */
std::vector<SceneSurface>
LatticeToSurfaces(const FCCVolume & volume,
                  const std::vector<SurfaceRequest> & requests,
                  itk::FCCIsosurfaceMode mode,
                  const Events & events,
                  const itk::ImageBase<3> * grid = nullptr);

} // namespace rhombic

#endif
