#ifndef rhombicLabelDoubts_h
#define rhombicLabelDoubts_h

#include "rhombicLabelMap.h"

#include <string>
#include <vector>

namespace rhombic
{

/** What speaks against a label map being that of a scan, one sentence for each check; no file is named. The checks:
 *
 * - The map's grid covers less than half of the scan's volume, or has as many voxels as the scan, but lies elsewhere.
 * DICOM SEG and NRRD, whose grids may be those of the labels alone, are exempt.
 * - In a CT in HU, labels of known names have mean values that their tissues can't have: bones below 40 HU, lungs and
 *   airways above -300 HU, solid organs, muscles and vessels below -50 or above 500 HU. These labels hold at least 2 %
 * of the volume of all labels with known names.
 * - Of five labels and more, the scan's values differ more from label to label, and between labels and background, if
 *   the map is moved by 5 or 15 mm along an axis of its grid, or mirrored. Measured is the share of the variance of the
 *   values' ranks that is between the labels, with the background and without it; the product of the two has to rise by
 *   5 %, and neither may fall. Not for unevenly spaced slices.
 *
 * Values are those at up to some 130 thousand voxels of the map, at equal distances in memory. */
std::vector<std::string>
FindLabelDoubts(const Scan & scan, const LabelMap & map);

} // namespace rhombic

#endif
