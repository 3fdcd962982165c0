#ifndef rhombicDenoising_h
#define rhombicDenoising_h

#include "rhombicEvents.h"
#include "rhombicFCCImageFile.h"
#include "rhombicScan.h"

#include <cstdint>
#include <string>

namespace rhombic
{

/** \class Denoising
 * \brief How noise is taken out of a volume before surfaces are made of it.
 *
 * Thread safety: a value. */
struct Denoising
{
  /** The filter. */
  enum class Kind
  {
    None,
    Gaussian,      ///< on the lattice (itk::FCCGaussianImageFilter): rounds corners, shrinks what is small
    EdgePreserving ///< on the scan's own grid (itk::GradientAnisotropicDiffusionImageFilter, after P. Perona and J.
                   ///< Malik 1990): keeps edges, and with them thin and small things, but also their roughness, and
                   ///< where voxels are coarse it makes steps of them; slow
  };

  Kind kind = Kind::None;
  double sigma = 0.0; ///< standard deviation of the Gaussian in mm, or of one that takes as much out of what is no edge
  double edge = 0.0;  ///< EdgePreserving: what changes by more than this, in the volume's units per mm, is an edge
};

/** What is written as `none`, `gaussian:SIGMA` or `edges:SIGMA,EDGE`. Throws Failure(Usage). Thread safe. */
Denoising
ParseDenoising(const std::string & text);

/** Throws Failure(Usage) for numbers that are not positive or make no sense. Thread safe. */
void
CheckDenoising(const Denoising & denoising);

/** The image with EdgePreserving noise taken out, in its own pixel type; for other kinds, the image itself. The samples
 * must be those of perpendicular, evenly divided axes. Where these have different spacings, sigma is that along the
 * finest, and grows with the root of the spacing. Takes two images of float besides. Throws Failure: Usage as above,
 * and for a sigma that takes too many steps; Unreadable when values are not finite, as they would spread; Memory,
 * before any work. Thread safe.
 * \param maximumMemory in bytes; 0: half of what is free */
ScanImage
DenoiseScan(const ScanImage & image, const Denoising & denoising, std::uintmax_t maximumMemory, const Events & events);

/** The volume with Gaussian noise taken out, in its own pixel type; for None, the volume itself. Takes one volume
 * besides. Throws Failure: Usage as above, and for EdgePreserving, which needs the scan; Memory, before any work.
 * Thread safe for different volumes.
 * \param maximumMemory in bytes; 0: half of what is free */
FCCVolume
DenoiseLattice(const FCCVolume & volume,
               const Denoising & denoising,
               std::uintmax_t maximumMemory,
               const Events & events);

} // namespace rhombic

#endif
