#ifndef rhombicGreyWindow_h
#define rhombicGreyWindow_h

#include "rhombicScan.h"
#include "rhombicScanValues.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace rhombic
{

/** \file
 * From a scan's values to greys. */

/** \class GreyWindow
 * \brief The range of values that become greys: black at its lower end and below, white at its upper end and above. */
struct GreyWindow
{
  double width = 400.0; ///< in the scan's units, above 0
  double centre = 40.0; ///< the value of middle grey

  /** From 0 to 255; DICOM's LINEAR_EXACT (PS3.3, C.11.2.1.3.2). Black for what is not a number. */
  std::uint8_t
  GreyOf(double value) const
  {
    const double share = (value - centre) / width + 0.5;
    return share >= 1.0 ? 255 : share > 0.0 ? static_cast<std::uint8_t>(255.0 * share + 0.5) : 0;
  }
};

/** Usual windows for tissues in HU, for CT, by name: abdomen, bone, brain, ... */
const std::map<std::string, GreyWindow> &
WindowPresets();

/** The window of a text as WindowFromText() takes it, before there is a scan; nothing for "auto". Throws
 * Failure(Usage). */
std::optional<GreyWindow>
ParseWindow(const std::string & text);

/** The window of a text: a preset's name in upper or lower case, width and centre as "350/50", or "auto" for
 * AutomaticWindow(). Throws Failure(Usage) for other texts and for widths that are not above 0. */
GreyWindow
WindowFromText(const std::string & text, const Scan & scan);

/** For scans in HU "soft-tissue". For other scans from the 1st to the 99th percentile of the values above the lowest
 * value, which may stand for no data. About 260 thousand values are taken, at equal distances. */
GreyWindow
AutomaticWindow(const Scan & scan);

} // namespace rhombic

#endif
