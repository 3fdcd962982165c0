#ifndef rhombicProbabilities_h
#define rhombicProbabilities_h

#include "rhombicLabelMapReader.h"

namespace rhombic
{

/** Reads volumes of probabilities as a label map of the most probable labels (see LabelMapSource::probabilities).
 * Throws Failure as OpenScan() does, and: Geometry for volumes with other voxels than the first, or with unevenly
 * spaced slices; Unreadable for values more than a tenth beyond their range; Memory; Usage for more than 4096 volumes.
 */
LabelMap
ReadProbabilities(const LabelMapSource & source, ScanReadOptions options);

} // namespace rhombic

#endif
