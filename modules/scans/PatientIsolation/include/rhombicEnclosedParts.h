#ifndef rhombicEnclosedParts_h
#define rhombicEnclosedParts_h

#include "rhombicFCCImageFile.h"
#include "rhombicPixelTypes.h"

#include "itkTriangleSurface.h"

#include <cstddef>
#include <functional>

namespace rhombic
{

/** Results of KeepEnclosedParts(): volumes and numbers of parts left out, and of parts that the scan's sides cut. */
struct EnclosedParts
{
  double aroundBody = 0.0;       ///< volume left out around the body, in ml
  std::size_t numberOfSmall = 0; ///< parts left out because they have less than a fiftieth of the largest part's volume
  double small = 0.0;            ///< volume of these parts, in ml
  std::size_t numberCutBySides = 0; ///< kept parts that end at a side of the scan other than top and bottom
};

/** Extracts the closed surface of a volume. */
using SurfaceExtractor = std::function<itk::TriangleSurface::Pointer(const FCCVolume & volume)>;

/** Keeps the connected parts of a surface that lie in the body, without small ones: the lungs, also where the scan's
 * sides cut them, but not the air around the patient.
 *
 * Air around the body is a connected part of the values below -940 HU that reaches an edge of the scan along the
 * patient, or one of the four sides between these edges where a ball of 8 mm radius has room. (If the scan's lowest
 * values are above -1000 HU, the limit is 60 HU above them, at most -860 HU.) All other parts are in the body: lungs
 * without emphysema are denser. Where no tissue separates a lung from the air around the body, as at the border of a
 * round field of view or in the nose, the volume is cut there and the surface extracted anew. If the isovalue is 0 or
 * more, or values above it are inside, values need not be HU: then parts inside the surface are around the body if they
 * reach an edge.
 *
 * \param surface the surface of the volume at the threshold; replaced by its kept parts
 * \param extract extracts the surface of a copy of the volume that was cut; called once at most */
EnclosedParts
KeepEnclosedParts(itk::TriangleSurface::Pointer & surface,
                  const FCCVolume & volume,
                  const Threshold & threshold,
                  const SurfaceExtractor & extract);

/** A copy of a volume in which the inside of the body is filled: samples deeper than \a depth under the body's outline
 * are at the isovalue or above it, so that the surface at the isovalue is the skin without lungs and bowel gas. Lungs
 * that the scan's top or bottom cuts are filled, too. A sample at the isovalue or above it stays as it is. Cavities
 * that are less deep stay; see itk::FillTriangleSurfaceCavities() for them.
 *
 * Air around the body is found as by KeepEnclosedParts(), but up to -880 HU, for mattresses of foam. Where there is
 * none, the volume is copied as it is.
 *
 * \param isovalue between air and tissue; below 0 the volume's values are taken for HU
 * \param depth in mm, at least 8 */
FCCVolume
FillBody(const FCCVolume & volume, double isovalue, double depth = 12.0);

} // namespace rhombic

#endif
