#ifndef rhombicMeasureTable_h
#define rhombicMeasureTable_h

#include "rhombicAtomicFile.h"
#include "rhombicScanReport.h"

#include <filesystem>

namespace rhombic
{

/** Throws Failure(Usage) when StageMeasureTable() would because of the extension. */
void
CheckMeasureTablePath(const std::filesystem::path & path);

/** Writes the reports of surfaces as a table: .csv with a line for each and units in the head line, or .json with all
 * there is, to appear with all others of \a staged. What is not known of a surface is left empty. Throws Failure: Usage
 * for another extension, Output. */
void
StageMeasureTable(const Report & surfaces, const std::filesystem::path & path, StagedFiles & staged);

} // namespace rhombic

#endif
