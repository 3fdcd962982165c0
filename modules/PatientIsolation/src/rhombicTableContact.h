#ifndef rhombicTableContact_h
#define rhombicTableContact_h

#include "rhombicBlockGrid.h"

namespace rhombic
{

/** Takes the wall of a table, on which the patient lies, out of the patient's mask. Where the two touch, both are one
 * thick body. The wall is seen to the left and to the right of such a contact, and the body's back has no step there:
 * in between, the wall is as thick as on both sides.
 *
 * \param solid the patient and all that is not air.
 * \param longAxis the image axis along the patient.
 * \param thickestWall in mm: thicker walls are left alone. */
void
CutTableContacts(const MaskImage & solid, unsigned int longAxis, double thickestWall, MaskImage & patient);

} // namespace rhombic

#endif
