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

/** Something that was removed from a scan. Points are in LPS mm. */
struct RemovedObject
{
  double millilitres = 0.0; ///< volume of its samples at or above -300 HU
  itk::Point<double, 3> centroid;
  itk::Point<double, 3> lowest; ///< corners of its bounding box
  itk::Point<double, 3> highest;
};

/** What RemoveTable() did. */
struct TableRemoval
{
  std::vector<RemovedObject> objects; ///< those of 1 ml and more, the largest first
  std::size_t numberOfSpecks = 0;     ///< smaller objects
  double millilitresOfSpecks = 0.0;
  double airValue = 0.0;          ///< median of the air around the patient in HU, which replaced the objects
  std::vector<std::string> notes; ///< sentences on what was kept in doubt, or why nothing was removed
};

/** Sets what is around the patient of a CT in HU to air: table, mattress, head holder, sheets, tubes. A scan in which
 * there is no such object of 1 ml or more stays as it is, byte for byte.
 *
 * The scan is divided into blocks of about 2 mm; tissue blocks are those with at least half of their samples at or
 * above -300 HU. The patient consists of
 * - the tissue more than 9 mm thick that is connected with tissue at least 24 mm thick, and tissue within 4.5 mm of it;
 * - what lies between such tissue on lines from front to back, which is mostly lung;
 * - separate thinner parts of soft tissue no longer than a hand;
 * - thin parts that touch these, such as ears, unless they are large, reach far, are a bare wall harder than skin,
 *   or lie in one place through much of the scan, as a table does.
 * Where the back lies on the wall of a table, the wall is followed through the contact. In doubt, parts are kept, and a
 * note says so.
 *
 * Around the patient is what balls of 8 mm radius reach from the scan's sides through air. Farther than two blocks'
 * diagonals from the patient all of it becomes air; nearer, what is closer to an object than to the patient. The cut is
 * smooth, without steps of voxels: samples are lowered to a limit that falls to air within one sample. Surfaces at any
 * threshold stay the same elsewhere. Slices may be tilted or unevenly spaced.
 *
 * Takes up to 40 bytes for each block. The result does not depend on the number of threads. */
TableRemoval
RemoveTable(Scan & scan, const Events & events);

} // namespace rhombic

#endif
