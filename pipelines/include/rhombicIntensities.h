#ifndef rhombicIntensities_h
#define rhombicIntensities_h

#include "rhombicFCCImageFile.h"
#include "rhombicScan.h"

namespace rhombic
{

/** \class Intensities
 * \brief What the values of a volume, in its own units, say about where its surfaces are. Values that are not finite
 * don't count.
 *
 * Thread safety: a value. */
struct Intensities
{
  double lowest = 0.0;
  double highest = 0.0;
  double otsu = 0.0; ///< N. Otsu's threshold (1979) between background and foreground, from a histogram of 256 bins
};

/** Throws Failure(Unreadable) when no value is finite. Thread safe. */
Intensities
ComputeIntensities(const ScanImage & image);

/** The same for a volume that is on the lattice already. */
Intensities
ComputeIntensities(const FCCVolume & volume);

} // namespace rhombic

#endif
