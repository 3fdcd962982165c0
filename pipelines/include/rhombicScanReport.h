#ifndef rhombicScanReport_h
#define rhombicScanReport_h

#include "rhombicFCCImageFile.h"
#include "rhombicLabelSurfaces.h"
#include "rhombicScan.h"
#include "rhombicTableRemoval.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * What is known of a scan, as JSON. Thread safety: any number of threads may call these functions at once. */

/** A report that keeps the order in which it was written. */
using Report = nlohmann::ordered_json;

/** The geometry report of a scan: what was read, why that, where it lies, and what had to be assumed or repaired.
 * Lengths are in mm, positions in LPS. Holds nothing about the patient. Intensities, which take a pass over the scan,
 * are ReportIntensities()'s. */
Report
ReportScan(const Scan & scan);

/** All that headers tell of the series in a folder, with their spacings. Holds nothing about the patient but the names
 * of files in the series' problems. */
Report
ReportSeriesList(const SeriesList & list);

/** The same as ReportScan() for a volume that is on the lattice already. */
Report
ReportLattice(const FCCVolume & volume);

/** The range of values, and thresholds worth trying for that modality. Throws Failure(Unreadable) when no value is
 * finite. */
Report
ReportIntensities(const Scan & scan);

/** The same for a volume that is on the lattice already. */
Report
ReportIntensities(const FCCVolume & volume);

/** What was removed around the patient: volumes in ml, positions in LPS mm. */
Report
ReportTableRemoval(const TableRemoval & removal);

/** For each label: value, name, colour (`#rrggbb`), voxels and millilitres. */
Report
ReportLabels(const std::vector<LabelSummary> & labels);

/** For each surface of a label: value, name, voxels, millilitres of voxels and surface, their difference, pieces,
 * whether it is torn, protected voxels and triangles. */
Report
ReportLabelSurfaces(const std::vector<LabelSurface> & surfaces);

/** As JSON text; what is not UTF-8 in it is replaced. */
std::string
ToJson(const Report & report);

/** For each image axis, the letter of the anatomical direction nearest to it: LPS for LPS. */
std::string
OrientationLetters(const itk::ImageBase<3>::DirectionType & direction);

} // namespace rhombic

#endif
