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
  RemoveFromCT, ///< from scans whose modality is CT
  Remove,       ///< from CTs, and from scans of unknown modality
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

/** Results of RemoveTable(). */
struct TableRemoval
{
  std::vector<RemovedObject> objects; ///< objects of 1 ml and more, the largest first
  std::size_t numberOfSpecks = 0;     ///< smaller objects
  double millilitresOfSpecks = 0.0;
  double airValue = 0.0;          ///< median of the air around the patient in HU; the value that replaced the objects
  std::vector<std::string> notes; ///< parts that were kept in doubt, or why nothing was removed
};

/** Removes the objects around the patient from a CT in HU: table, mattress, head holder, sheets, tubes. Their values
 * become air. A scan in which there is no such object of 1 ml or more stays as it is, byte for byte.
 *
 * The scan is divided into blocks of about 2 mm; tissue blocks are those with at least half of their samples at or
 * above -300 HU. The patient consists of
 * - the tissue more than 9 mm thick that is connected with tissue at least 24 mm thick, and tissue within 4.5 mm of it;
 * - all blocks between the first and the last block of such tissue on lines from front to back, mostly lung;
 * - separate thinner parts of soft tissue no longer than a hand;
 * - thin parts that touch these, such as ears, unless they are large, reach far, are a bare wall harder than skin, or
 *   repeat at the same position across the patient through much of the scan, as a table does.
 *
 * Where the back touches the wall of a table, the wall is cut off with the thickness that it has beside the contact. In
 * doubt, parts are kept, with a note.
 *
 * The surroundings are what balls of 8 mm radius can reach from the scan's sides without touching the patient. Farther
 * than two block diagonals from the patient, all samples of the surroundings become air; nearer, those that are closer
 * to an object than to the patient. The cut is smooth, without steps of voxels: samples are lowered to a limit that
 * falls to air within one sample. Surfaces at any threshold stay the same elsewhere. Slices may be tilted or unevenly
 * spaced.
 *
 * Takes up to 40 bytes for each block. The result does not depend on the number of threads. */
TableRemoval
RemoveTable(Scan & scan, const Events & events);

} // namespace rhombic

#endif
