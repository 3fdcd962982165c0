#include "rhombicMeasureTable.h"

#include "rhombicFailure.h"
#include "rhombicSidecar.h"

#include <cmath>
#include <string>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

struct Column
{
  const char * head;
  const char * place; ///< in a surface's report, as a JSON pointer
};

constexpr Column columns[] = {
  { "name", "/name" },
  { "isovalue", "/isovalue" },
  { "inside", "/inside" },
  { "volume (ml)", "/measures/volumeInMillilitres" },
  { "isosurface volume (ml)", "/measures/isosurfaceVolumeInMillilitres" },
  { "isosurface uncertainty (ml)", "/measures/isosurfaceUncertaintyInMillilitres" },
  { "voxel volume (ml)", "/measures/voxelVolumeInMillilitres" },
  { "volume error (%)", "/measures/volumeErrorInPercent" },
  { "volume error is of", "/measures/volumeErrorReference" },
  { "area (mm2)", "/measures/areaInSquareMillimetres" },
  { "x min (mm)", "/measures/boundsInMillimetres/0" },
  { "x max (mm)", "/measures/boundsInMillimetres/1" },
  { "y min (mm)", "/measures/boundsInMillimetres/2" },
  { "y max (mm)", "/measures/boundsInMillimetres/3" },
  { "z min (mm)", "/measures/boundsInMillimetres/4" },
  { "z max (mm)", "/measures/boundsInMillimetres/5" },
  { "centroid x (mm)", "/measures/centroidInMillimetres/0" },
  { "centroid y (mm)", "/measures/centroidInMillimetres/1" },
  { "centroid z (mm)", "/measures/centroidInMillimetres/2" },
  { "longest diameter (mm)", "/measures/longestDiameterInMillimetres" },
  { "mean value", "/measures/meanValue" },
  { "standard deviation", "/measures/standardDeviation" },
  { "triangles", "/triangles" },
  { "volume as extracted (ml)", "/extracted/volumeInMillilitres" },
  { "area as extracted (mm2)", "/extracted/areaInSquareMillimetres" },
  { "triangles as extracted", "/extracted/triangles" },
  { "volume change by finishing (%)", "/extracted/volumeChangeInPercent" },
  { "area change by finishing (%)", "/extracted/areaChangeInPercent" },
  { "mean deviation (mm)", "/deviation/meanInMillimetres" },
  { "95 % deviation (mm)", "/deviation/percentile95InMillimetres" },
  { "largest deviation (mm)", "/deviation/maximumInMillimetres" },
};

/** Text in quotes, in which quotes are doubled (RFC 4180); nothing for what is no finite number; everything else as
 * JSON writes it. */
std::string
ToField(const Report & value)
{
  if (!value.is_string())
  {
    const bool isUnknown = value.is_null() || (value.is_number_float() && !std::isfinite(value.get<double>()));
    return isUnknown ? "" : value.dump();
  }
  std::string field = "\"";
  for (const char letter : value.get<std::string>())
  {
    field += letter == '"' ? "\"\"" : std::string(1, letter);
  }
  return field + '"';
}

std::string
ToCSV(const Report & surfaces)
{
  std::string text;
  for (const Column & column : columns)
  {
    text += (text.empty() ? "" : ",") + std::string(column.head);
  }
  text += "\r\n";
  for (const Report & surface : surfaces)
  {
    std::string line;
    for (const Column & column : columns)
    {
      const Report::json_pointer place(column.place);
      line += (&column == columns ? "" : ",") + (surface.contains(place) ? ToField(surface.at(place)) : "");
    }
    text += line + "\r\n";
  }
  return text;
}

} // namespace

void
CheckMeasureTablePath(const fs::path & path)
{
  if (path.extension() != ".csv" && path.extension() != ".json")
  {
    throw Failure(FailureKind::Usage,
                  "Cannot write the measures to " + path.string() + ": use the extension .csv or .json.");
  }
}

void
StageMeasureTable(const Report & surfaces, const fs::path & path, StagedFiles & staged)
{
  CheckMeasureTablePath(path);
  StageText(path.extension() == ".csv" ? ToCSV(surfaces) : ToJson(surfaces) + '\n', path, staged);
}

} // namespace rhombic
