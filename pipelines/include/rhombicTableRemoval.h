#ifndef rhombicTableRemoval_h
#define rhombicTableRemoval_h

#include "rhombicEvents.h"
#include "rhombicScan.h"
#include "rhombicScanReport.h"

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

/** Something that was removed from a scan. */
struct RemovedObject
{
  double millilitres = 0.0;       ///< of what is at or above the threshold of tissue
  itk::Point<double, 3> centroid; ///< in LPS mm, as are the corners of its bounding box
  itk::Point<double, 3> lowest;
  itk::Point<double, 3> highest;
};

/** What RemoveTable() did. */
struct TableRemoval
{
  std::vector<RemovedObject> objects; ///< of 1 ml and more, the largest first
  std::size_t numberOfSpecks = 0;     ///< smaller ones
  double millilitresOfSpecks = 0.0;
  double airValue = 0.0;          ///< what took their place
  std::vector<std::string> notes; ///< what was kept for doubt, or why nothing was removed, a sentence each
};

/** Sets what is around the patient of a CT in HU to air: table, mattress, head holder, sheets, tubes. A scan in which
 * there is no such object of 1 ml or more stays as it is, byte for byte.
 *
 * The patient is found on a grid of about 2 mm in what is at or above -300 HU: the parts that are 3 cm thick, all that
 * is within 1 cm of them, and thin parts that hang on to them (ears, fingers) unless they run through the whole scan at
 * one place, as a table does. The air that they enclose, and gaps of less than 16 mm, belong to them. Beyond a margin
 * of some millimetres from the patient all becomes air; within it, what is nearer to an object than to the patient.
 * The cut is a smooth surface, not one of voxels. In doubt, things are kept, and a note says so.
 *
 * Takes about an eighth of the scan's voxels in bytes times 20. The result does not depend on the number of threads. */
TableRemoval
RemoveTable(Scan & scan, const Events & events);

/** Volumes in ml, positions in LPS mm. */
Report
ReportTableRemoval(const TableRemoval & removal);

} // namespace rhombic

#endif
