#ifndef rhombicTableRemoval_h
#define rhombicTableRemoval_h

#include "rhombicEvents.h"
#include "rhombicScan.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rhombic
{

/** Whether the scanner's table is removed from a scan. */
enum class TableRule
{
  RemoveFromCT, ///< if the scan says that it is a CT
  Remove,       ///< also if it does not say what it is
  Keep
};

/** Whether the rule applies to the scan. */
bool
IsTableRemoved(TableRule rule, const Scan & scan);

/** Something that was removed from a scan. Thread safety: a value. */
struct RemovedObject
{
  double millilitres = 0.0;       ///< of what is at or above the threshold of tissue
  itk::Point<double, 3> centroid; ///< in LPS mm, as are the corners of its bounding box
  itk::Point<double, 3> lowest;
  itk::Point<double, 3> highest;
};

/** What RemoveTable() did. Thread safety: a value. */
struct TableRemoval
{
  std::vector<RemovedObject> objects; ///< of 1 ml and more, the largest first
  std::size_t numberOfSpecks = 0;     ///< smaller ones
  double millilitresOfSpecks = 0.0;
  double airValue = 0.0;          ///< in HU, the median of the air around the patient, which took their place
  std::vector<std::string> notes; ///< what was kept for doubt, or why nothing was removed, a sentence each
};

/** Sets what is around the patient of a CT in HU to air: table, mattress, head holder, sheets, tubes. A scan in which
 * there is no such object of 1 ml or more stays as it is, byte for byte.
 *
 * The patient is found in blocks of about 2 mm that are half or more at or above -300 HU:
 * - the parts that are 24 mm thick somewhere, and all of them that is thicker than 9 mm; what lies in between, from
 *   front to back, which is mostly lung; and what is less than half as thick and within reach of a ball of that size;
 * - thinner parts of soft tissue beside them that are no longer than a hand;
 * - thin parts that hang on to these, such as ears, unless they are large, reach far, are a bare wall harder than skin,
 *   or are in one place through much of the scan, as a table is.
 * A table's wall that the back lies on is followed through the contact. In doubt, things are kept, and a note says so.
 *
 * What is around the patient is what balls of 8 mm radius reach from the scan's sides, if that is air. Beyond a margin
 * of two blocks' diagonals from the patient all of it becomes air; within, what is nearer to an object than to the
 * patient. The cut is a smooth surface, not one of voxels: samples are lowered to a limit that falls to air within one
 * sample, and no surface at any threshold arises elsewhere. Tilted and uneven slices may lie as they are.
 *
 * Takes up to 40 bytes for each block. The result does not depend on the number of threads. Thread safe for different
 * scans. */
TableRemoval
RemoveTable(Scan & scan, const Events & events);

} // namespace rhombic

#endif
