#ifndef rhombicLatticePipeline_h
#define rhombicLatticePipeline_h

#include "rhombicEvents.h"
#include "rhombicFCCImageFile.h"
#include "rhombicScan.h"
#include "rhombicSurfaceRequest.h"

#include "itkFCCLattice.h"
#include "itkSeparableTaps.h"

#include <array>
#include <vector>

namespace rhombic
{

/** Which lattice a scan is resampled onto, and how. */
struct LatticeSettings
{
  double density = itk::FCCLattice::NyquistDensity; ///< lattice sites per sample of the scan
  std::array<double, 3> spacing{ 0.0, 0.0, 0.0 };   ///< of the lattice in mm (see itk::FCCImage); 0: from the density
  itk::SeparableKernel kernel = itk::SeparableKernel::CubicBSpline;
};

/** Throws Failure(Usage) for settings that make no lattice of any scan. */
void
CheckLatticeSettings(const LatticeSettings & settings);

/** The scan on the lattice, in its own pixel type (itk::CartesianToFCCImageFilter). Throws Failure: Usage for settings
 * that make no lattice, Memory. */
FCCVolume
ScanToLattice(const ScanImage & image, const LatticeSettings & settings, const Events & events);

/** The volume on a Cartesian grid of the given spacing in mm; 0: that which makes the lattice's samples 0.77 times as
 * many (itk::FCCToCartesianImageFilter). */
ScanImage
LatticeToScan(const FCCVolume & volume, const std::array<double, 3> & spacing, const Events & events);

/** A closed isosurface of the volume for each request, in its order. The requests' isovalues must be known.
 * Throws Failure(Empty) when a surface has no triangle. */
std::vector<SceneSurface>
LatticeToSurfaces(const FCCVolume & volume, const std::vector<SurfaceRequest> & requests, const Events & events);

} // namespace rhombic

#endif
