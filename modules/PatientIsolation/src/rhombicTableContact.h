#ifndef rhombicTableContact_h
#define rhombicTableContact_h

#include "rhombicBlockGrid.h"

namespace rhombic
{

/** Removes the wall of a table that the patient touches from the patient's mask, in which both are one thick body. The
 * wall is visible to the left and to the right of the contact; between the two, it is cut off with the thickness that
 * it has there.
 *
 * \param solid the blocks that are not air, with the patient and the table.
 * \param longAxis the image axis along the patient.
 * \param thickestWall in mm: thicker walls are left alone. */
void
CutTableContacts(const MaskImage & solid, unsigned int longAxis, double thickestWall, MaskImage & patient);

} // namespace rhombic

#endif
