#ifndef rhombicMeasureTable_h
#define rhombicMeasureTable_h

#include "rhombicAtomicFile.h"
#include "rhombicSourceSurfaces.h"
#include "rhombicScanReport.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Measures of finished surfaces: a list of columns, from which reports, tables and sentences take names, units and
 * values. */

/** A measure or fact of a surface. */
struct MeasureColumn
{
  const char * name;        ///< in snake_case, with the unit at its end
  const char * unit;        ///< empty for columns that are no measures
  const char * description; ///< a sentence

  /** A number or text; null for an unknown value. */
  Report (*find)(const MeshedSurface & surface);

  /** The part of SummarizeMeasures() with the found number; null for columns that the sentence leaves out. */
  std::string (*say)(double number, const MeshedSurface & surface) = nullptr;
};

/** All columns, in the order of tables. Each table has all of them. */
const std::vector<MeasureColumn> &
GetMeasureColumns();

/** The size of a surface that is not finished yet. */
ExtractedSize
MeasureExtracted(const itk::TriangleSurface & surface);

/** Sets the numbers of points and triangles, the measures and the identity of a finished surface. For any thread.
 * \param scan for the values and voxels inside; may be null */
void
MeasureFinished(const Scan * scan, MeshedSurface & surface);

/** The known values of a surface, by column; of a label near a part of its map the volume of its voxels. */
Report
ReportMeasures(const MeshedSurface & surface);

/** The main measures of a surface in one line: "liver: 1502.3 ml, voxels 1501.0 ml, ...". */
std::string
SummarizeMeasures(const MeshedSurface & surface);

/** Change in %. */
inline double
PercentChange(double before, double after)
{
  return 100.0 * (after - before) / before;
}

/** "2.0 % less" or "2.0 % more". */
std::string
DescribeDifference(double percent);

/** Adds a column to the description of a table's columns as BIDS has them beside a table (.json). */
void
DescribeColumn(const std::string & name, const std::string & unit, const std::string & description, Report & columns);

/** The description of all columns of GetMeasureColumns(). */
Report
DescribeMeasures();

/** A field of a tab-separated table: a text without control characters, or a number; "n/a" for null. */
std::string
ToField(const Report & value);

/** A field of a comma-separated table: as ToField(), texts in quotes. */
std::string
ToCSVField(const Report & value);

/** Throws Failure(Usage) for an extension other than .csv and .json. */
void
CheckMeasureTablePath(const std::filesystem::path & path);

/** Writes the measures of surfaces, to appear with all others of \a staged: as .csv a line for each surface, with "n/a"
 * for what is not known; as .json all of ReportMeshedSurface(). Throws Failure(Output). */
void
StageMeasureTable(const std::vector<MeshedSurface> & surfaces,
                  const std::filesystem::path & path,
                  StagedFiles & staged);

} // namespace rhombic

#endif
