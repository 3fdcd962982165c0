#ifndef rhombicEnclosingLabels_h
#define rhombicEnclosingLabels_h

#include "rhombicLabelMap.h"

#include <cstdint>
#include <set>

namespace rhombic
{

/** The values of the labels that hide another label of the list from all sides: skin, fat, muscle and body by their
 * names, as they are thin in places, and labels that rays along the scan's axes meet first, from both ends. Voxels of
 * labels that are not in the list or not visible do not hide anything. Empty for a list of one label. */
std::set<std::int32_t>
FindEnclosingLabels(const LabelMap & map);

} // namespace rhombic

#endif
