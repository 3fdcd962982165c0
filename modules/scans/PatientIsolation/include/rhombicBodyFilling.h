#ifndef rhombicBodyFilling_h
#define rhombicBodyFilling_h

#include "rhombicFCCImageFile.h"

namespace rhombic
{

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
