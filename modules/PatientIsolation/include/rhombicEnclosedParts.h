#ifndef rhombicEnclosedParts_h
#define rhombicEnclosedParts_h

#include "rhombicFCCImageFile.h"
#include "rhombicThreshold.h"

#include "itkTriangleSurface.h"

#include <cstddef>
#include <functional>

namespace rhombic
{

/** What KeepEnclosedParts() left out of a surface, and what it kept although the scan's sides cut it. */
struct EnclosedParts
{
  double aroundBody = 0.0;          ///< volume left out around the body, in ml
  std::size_t numberOfSmall = 0;    ///< left out: parts of less than a fiftieth of the volume of the largest one
  double small = 0.0;               ///< volume of these, in ml
  std::size_t numberCutBySides = 0; ///< kept parts that end at a side of the scan other than top and bottom
};

/** Extracts the closed surface of a volume. */
using SurfaceExtractor = std::function<itk::TriangleSurface::Pointer(const FCCVolume & volume)>;

/** Keeps the connected parts of a surface that lie in the body, without small ones: the lungs, also where the scan's
 * sides cut them, but not the air around the patient.
 *
 * Around the body is what is below -940 HU (or less than 60 HU above the lowest values, if that is between -940 and
 * -860 HU) and reaches a corner of the slices, or a side of the scan where a ball of 8 mm radius has room. All else is
 * in the body: lungs without emphysema are denser. Where no tissue lies between the two, as at the border of a round
 * field of view or in the nose, the volume is cut there, and the surface extracted anew. At isovalues of 0 and more,
 * which are no thresholds of air in HU, and where inside is above, the corners alone decide.
 *
 * \param surface of the volume at the threshold
 * \param extract makes the same surface of a copy of the volume that was cut; called once at most */
EnclosedParts
KeepEnclosedParts(itk::TriangleSurface::Pointer & surface,
                  const FCCVolume & volume,
                  const Threshold & threshold,
                  const SurfaceExtractor & extract);

} // namespace rhombic

#endif
