#ifndef rhombicTableContact_h
#define rhombicTableContact_h

#include "rhombicCoarseScan.h"

namespace rhombic
{

/** Takes the wall of a table, on which the patient lies, out of the patient's mask. Where the two touch, both are one
 * thick body. Across the patient, the wall goes in there and comes out again, and the body's back has no step: in
 * between, the wall is as thick as on both sides.
 *
 * \param solid the patient and all that is not air.
 * \param longAxis the image axis along the patient.
 * \param thickestWall in mm: what is thicker is left alone. */
void
CutTableContacts(const MaskImage & solid, unsigned int longAxis, double thickestWall, MaskImage & patient);

} // namespace rhombic

#endif
