#ifndef rhombicIntensities_h
#define rhombicIntensities_h

#include "rhombicFCCImageFile.h"
#include "rhombicScan.h"

namespace rhombic
{

/** \class Intensities
 * \brief Range and thresholds of a volume's finite values, in the volume's units. */
struct Intensities
{
  double lowest = 0.0;
  double highest = 0.0;
  double otsu = 0.0;    ///< N. Otsu's threshold (1979) between background and foreground, from a histogram of 256 bins
  double lowOtsu = 0.0; ///< Otsu's threshold of the values up to `otsu`; in MR, between air and the darkest tissue
  double lowestOtsu = 0.0; ///< Otsu's threshold of the values up to `lowOtsu`; in PET, between air and the body
  double highOtsu = 0.0;   ///< Otsu's threshold of the values from `otsu` on; in CT, between soft tissue and bone
};

/** Throws Failure(Unreadable) when no value is finite.
 * \param findsOtsu without it, the thresholds are the lowest value */
Intensities
ComputeIntensities(const ScanImage & image, bool findsOtsu = true);

/** The same for a lattice volume. */
Intensities
ComputeIntensities(const FCCVolume & volume, bool findsOtsu = true);

} // namespace rhombic

#endif
