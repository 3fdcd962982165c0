#ifndef rhombicScanReport_h
#define rhombicScanReport_h

#include "rhombicDescribeScan.h"
#include "rhombicTableRemoval.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace rhombic
{

/** \file
 * Reports as JSON of what is read and made: this file of scans, rhombicSurfaceReport.h of surfaces. Units are in the
 * keys where they are not mm; positions are in LPS. Nothing in them is about the patient, but that problems of series
 * may name files. */

/** JSON that keeps the order in which it was written. */
using Report = nlohmann::ordered_json;

/** Format, geometry, series, assumptions and repairs of the reader, for outputs: notes don't name the scan's
 * file, whose name may be the patient's. */
Report
ReportWithoutNames(const Scan & scan, const std::filesystem::path & path);

/** Number of files, and the digest of their contents, one after the other. */
Report
ReportFiles(const std::vector<std::filesystem::path> & files);

/** Format and geometry. */
Report
ReportLattice(const FCCVolume & volume);

/** Kind, and its parameters in mm and in the scan's units. */
Report
ReportDenoising(const Denoising & denoising);

/** Objects that were removed around the patient, and separate parts that were kept: volumes in ml, positions, and the
 * value that replaced the objects. */
Report
ReportTableRemoval(const TableRemoval & removal);

/** All of a description. */
Report
ReportDescription(const ScanDescription & description);

/** As JSON text; bytes that are not UTF-8 are replaced. */
std::string
ToJson(const Report & report);

/** For each image axis, the letter of the anatomical direction nearest to it: LPS for LPS. */
std::string
OrientationLetters(const itk::ImageBase<3>::DirectionType & direction);

/** "right" or "left". */
std::string
HandednessOf(const itk::ImageBase<3>::DirectionType & direction);

/** `#rrggbb`. */
std::string
ToHexadecimal(const Label & label);

} // namespace rhombic

#endif
