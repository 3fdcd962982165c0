#ifndef rhombicScanValues_h
#define rhombicScanValues_h

#include "rhombicScan.h"

#include <vector>

namespace rhombic
{

/** Up to about 260 thousand finite values of a scan, at equal distances in memory. */
std::vector<double>
TakeScanValues(const Scan & scan);

/** Whether a scan's values are taken for HU: CTs with values below -200, and scans of unknown modality with values
 * below -900. Some CTs have raw numbers instead. */
bool
IsInHounsfieldUnits(const Scan & scan);

} // namespace rhombic

#endif
