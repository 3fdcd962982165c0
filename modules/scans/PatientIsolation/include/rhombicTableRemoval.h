#ifndef rhombicTableRemoval_h
#define rhombicTableRemoval_h

#include "rhombicEvents.h"
#include "rhombicScan.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rhombic
{

/** A connected part of a scan's tissue and objects. Points are in LPS mm. */
struct ScanObject
{
  double millilitres = 0.0; ///< volume of its samples at or above -300 HU
  itk::Point<double, 3> centroid;
  itk::Point<double, 3> lowest; ///< corners of its bounding box
  itk::Point<double, 3> highest;
};

/** Results of RemoveTable(). */
struct TableRemoval
{
  std::vector<ScanObject> objects; ///< removed objects of 1 ml and more, the largest first
  std::size_t numberOfSpecks = 0;  ///< smaller objects
  double millilitresOfSpecks = 0.0;
  std::vector<ScanObject> kept;   ///< parts of 1 ml and more that count as the patient's, but do not touch the largest
  double airValue = 0.0;          ///< median of the air around the patient in HU; the value that replaced the objects
  std::vector<std::string> notes; ///< why nothing was removed
};

/** Removes the objects around the patient from a CT in HU: table, head holder, sheets, tubes. Their values become air.
 * A scan in which no such object of 1 ml or more is told from the patient stays as it is, byte for byte.
 *
 * The patient is what is thick; tables and holders have thin walls. On a grid of blocks of about 3 mm, of which those
 * are tissue that have at least half of their samples at or above -300 HU, the patient consists of
 * - the body: tissue more than 9 mm thick that is connected with tissue at least 24 mm thick, and what lies between
 *   such tissue on lines from front to back, mostly lung;
 * - separate parts more than 9 mm thick, if they are soft and no longer than a hand;
 * - the skin: tissue within 8 mm of these;
 * - thin parts that touch the skin and end within 40 mm of the body, as ears do; within 60 mm after what is at the same
 *   place in half of the scan's length was taken away, as a table is.
 *
 * Objects are other tissue around the patient, where balls of 8 mm radius from the scan's sides have room. What is in
 * the body or in its clefts stays.
 *
 * Sheets and air under them can't be told from the skin that they touch. Within 30 mm of the objects (10 mm at thin
 * parts), the skin is drawn anew, at the place that the blocks' shares of tissue give: outside it all samples become
 * air, and in its outer 3 mm, samples below fat become fat, over two samples. Elsewhere samples stay the same. Where a
 * back lies on the wall of a table without a gap, the wall stays. Slices may be tilted or unevenly spaced.
 *
 * Takes up to 50 bytes for each block. The result does not depend on the number of threads. */
TableRemoval
RemoveTable(Scan & scan, const Events & events);

} // namespace rhombic

#endif
