#ifndef rhombicLabelColours_h
#define rhombicLabelColours_h

#include "rhombicLabelMap.h"

namespace rhombic
{

/** Where the colours of labels come from. */
enum class LabelColours
{
  Anatomy,    ///< for known names the colours of anatomical illustrations; for others the colours of the label table
  Table,      ///< the colours of the label table
  ColourBlind ///< eight colours that colour-blind people tell apart (Okabe and Ito), and lighter and darker ones
};

/** Sets the colours of a map's labels, so that labels that touch or overlap can be told apart. Colours of the
 * label table stay as they are. */
void
ColourLabels(LabelMap & map, LabelColours colours);

} // namespace rhombic

#endif
