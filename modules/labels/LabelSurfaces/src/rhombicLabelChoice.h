#ifndef rhombicLabelChoice_h
#define rhombicLabelChoice_h

#include "rhombicLabelSurfaces.h"

#include <string>
#include <vector>

namespace rhombic
{

/** Throws Failure(Usage) for a density that is not above 0 and at most 64. */
void
CheckLabelDensity(double density);

/** The labels of the map that are wanted, or those that its table shows if none are named. Throws Failure: Usage for
 * names that fit none, Empty when there is none to show. */
std::vector<LabelSummary>
ChooseLabels(const LabelMap & map, const std::vector<std::string> & wanted);

/** The label's name, colour, opacity and voxels, without a surface. */
LabelSurface
DescribeLabel(const LabelSummary & summary);

/** Notes a torn surface, and a volume that differs by more than 1 %. */
void
NoteShortcomings(const LabelSurface & made, const Events & events);

} // namespace rhombic

#endif
