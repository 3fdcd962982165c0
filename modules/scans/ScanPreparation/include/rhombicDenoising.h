#ifndef rhombicDenoising_h
#define rhombicDenoising_h

#include "rhombicEvents.h"
#include "rhombicFCCImageFile.h"
#include "rhombicScan.h"

#include "itkProcessObject.h"

#include <cstdint>

namespace rhombic
{

/** \class Denoising
 * \brief A filter that takes noise out of a volume before surfaces are extracted. */
struct Denoising
{
  /** The filter. */
  enum class Kind
  {
    None,
    Gaussian,      ///< on the lattice (itk::FCCGaussianImageFilter); fast; rounds corners and shrinks small structures
    EdgePreserving ///< on the scan's grid (itk::GradientAnisotropicDiffusionImageFilter, after P. Perona and J. Malik
                   ///< 1990); slow; keeps thin and small structures, but also rough edges, and makes coarse
                   ///< voxels visible as steps
  };

  Kind kind = Kind::None;
  double sigma = 0.0; ///< mm: standard deviation of the Gaussian, or of the one that smooths flat regions as much
  double edge = 0.0;  ///< EdgePreserving: gradients above this are edges, in the volume's units per mm
};

/** Throws Failure(Usage) unless the parameters are positive and finite. */
void
CheckDenoising(const Denoising & denoising);

/** Applies EdgePreserving to a scan's image, and keeps its pixel type; returns the image itself for other kinds. The
 * axes must be perpendicular and the slices evenly spaced. Along an axis with larger spacing than the finest, sigma
 * grows with the root of the spacing. Needs memory for two images of float.
 *
 * Throws Failure: Usage for parameters out of range, and for a sigma that takes too many steps; Unreadable for values
 * that are not finite, which would spread; Memory, before any work.
 *
 * \param maximumMemory in bytes; 0: half of the free memory */
ScanImage
DenoiseScan(const ScanImage & image, const Denoising & denoising, std::uintmax_t maximumMemory, const Events & events);

/** A lattice volume smoothed by Gaussian, of which nothing is made yet: \a filter makes it, in parts if it is asked for
 * them, and must be kept with the volume's own source. Throws Failure(Usage) for parameters out of range. */
FCCVolume
ConnectDenoising(const FCCVolume & volume, const Denoising & denoising, itk::ProcessObject::Pointer & filter);

/** Applies Gaussian to a lattice volume, and keeps its pixel type; returns the volume itself for None. Needs memory for
 * one more volume.
 *
 * Throws Failure: Usage for parameters out of range, and for EdgePreserving, which works on scans only; Memory, before
 * any work.
 *
 * \param maximumMemory in bytes; 0: half of the free memory */
FCCVolume
DenoiseLattice(const FCCVolume & volume,
               const Denoising & denoising,
               std::uintmax_t maximumMemory,
               const Events & events);

} // namespace rhombic

#endif
