#ifndef rhombicLabelColours_h
#define rhombicLabelColours_h

#include "rhombicSceneRules.h"

namespace rhombic
{

/** Sets the colours of a map's labels, so that labels that touch can be told apart. Colours of the label table stay as
 * they are. */
void
ColourLabels(LabelMap & map, LabelColours colours);

} // namespace rhombic

#endif
