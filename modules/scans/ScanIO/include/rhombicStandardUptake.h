#ifndef rhombicStandardUptake_h
#define rhombicStandardUptake_h

#include "rhombicScan.h"

#include <optional>
#include <string>

namespace rhombic
{

/** What turns a PET's values into standardized uptake values by body weight (SUVbw, in g/ml). */
struct StandardUptake
{
  std::optional<double> factor; ///< of the values; nothing if the headers do not say all that it needs
  std::string reason;           ///< why there is no factor, as "the patient's weight is missing"; empty with one
};

/** Finds the factor in the headers of a scan's DICOM files. Values in g/ml have the factor 1, unless they are SUV of
 * another type. Values in Bq/ml have
 *
 *     factor = weight in g / (injected dose in Bq * 2^(-time / half-life)),
 *
 * where the time is that from the injection to the scan if decay is corrected to the scan's start (START), and 0 if it
 * is corrected to the injection (ADMIN). The scan begins at the series' date and time, or at the earliest
 * acquisition's, where the series is of later, as one that was processed. An injection without a date is within the 24
 * hours before. Source: QIBA, "Standardized Uptake Value (SUV)", vendor-neutral pseudo-code, qibawiki.rsna.org. As it
 * demands, there is no factor without corrections for attenuation and decay, nor where anything of the formula is
 * missing or 0. Private elements are not read.
 *
 * Reads the headers of all files. Nothing of the patient is kept but the factor. */
StandardUptake
FindStandardUptake(const Scan & scan);

} // namespace rhombic

#endif
