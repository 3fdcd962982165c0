#include "rhombicMeasureTable.h"

#include "rhombicFailure.h"
#include "rhombicSidecar.h"
#include "rhombicSurfaceReport.h"
#include "rhombicWording.h"

#include <cmath>
#include <string>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

using Surface = MeshedSurface;
using Field = std::string;

/** Text in quotes, in which quotes are doubled (RFC 4180). */
Field
Quote(const std::string & text)
{
  Field field = "\"";
  for (const char letter : text)
  {
    field += letter == '"' ? "\"\"" : std::string(1, letter);
  }
  return field + '"';
}

/** Empty for what is no finite number. */
Field
ToField(double number)
{
  return std::isfinite(number) ? FormatExact(number) : "";
}

Field
ToField(const std::optional<double> & number)
{
  return number ? ToField(*number) : "";
}

Field
ToMillilitres(const std::optional<double> & volume)
{
  return volume ? ToField(*volume / CubicMillimetresPerMl) : "";
}

Field
FindReference(const Surface & surface)
{
  const bool isKnown = surface.measures.GetVolumeError().has_value();
  return isKnown ? Quote(surface.measures.isosurface ? "isosurface" : "voxels") : "";
}

template <double IsosurfaceVolume::*Member>
Field
FindIsosurface(const Surface & surface)
{
  const auto & isosurface = surface.measures.isosurface;
  return isosurface ? ToMillilitres((*isosurface).*Member) : "";
}

template <std::size_t Bound>
Field
FindBound(const Surface & surface)
{
  return ToField(surface.measures.bounds[Bound]);
}

template <std::size_t Axis>
Field
FindCentroid(const Surface & surface)
{
  return ToField(surface.measures.centroid[Axis]);
}

template <double SurfaceDeviation::*Member>
Field
FindDeviation(const Surface & surface)
{
  const auto & deviation = surface.deviation;
  return deviation && deviation->IsKnown() ? ToField((*deviation).*Member) : "";
}

struct Column
{
  const char * head;
  Field (*find)(const Surface & surface);
};

const Column columns[] = {
  { "name", [](const Surface & s) { return Quote(s.scene.name); } },
  { "isovalue", [](const Surface & s) { return s.request ? ToField(s.request->isovalue) : Field(); } },
  { "inside", [](const Surface & s) { return s.request ? Quote(s.request->insideIsBelow ? "below" : "above") : ""; } },
  { "volume (ml)", [](const Surface & s) { return ToMillilitres(s.measures.volume); } },
  { "isosurface volume (ml)", FindIsosurface<&IsosurfaceVolume::volume> },
  { "isosurface uncertainty (ml)", FindIsosurface<&IsosurfaceVolume::uncertainty> },
  { "voxel volume (ml)", [](const Surface & s) { return ToMillilitres(s.measures.voxelVolume); } },
  { "volume error (%)", [](const Surface & s) { return ToField(s.measures.GetVolumeError()); } },
  { "volume error is of", FindReference },
  { "area (mm2)", [](const Surface & s) { return ToField(s.measures.area); } },
  { "x min (mm)", FindBound<0> },
  { "x max (mm)", FindBound<1> },
  { "y min (mm)", FindBound<2> },
  { "y max (mm)", FindBound<3> },
  { "z min (mm)", FindBound<4> },
  { "z max (mm)", FindBound<5> },
  { "centroid x (mm)", FindCentroid<0> },
  { "centroid y (mm)", FindCentroid<1> },
  { "centroid z (mm)", FindCentroid<2> },
  { "longest diameter (mm)", [](const Surface & s) { return ToField(s.measures.longestDiameter); } },
  { "mean value", [](const Surface & s) { return ToField(s.measures.meanValue); } },
  { "standard deviation", [](const Surface & s) { return ToField(s.measures.standardDeviation); } },
  { "triangles", [](const Surface & s) { return std::to_string(s.triangles); } },
  { "volume as extracted (ml)", [](const Surface & s) { return ToMillilitres(s.extracted.volume); } },
  { "area as extracted (mm2)", [](const Surface & s) { return ToField(s.extracted.area); } },
  { "triangles as extracted", [](const Surface & s) { return std::to_string(s.extracted.triangles); } },
  { "volume change by finishing (%)",
    [](const Surface & s) { return ToField(PercentChange(s.extracted.volume, s.measures.volume)); } },
  { "area change by finishing (%)",
    [](const Surface & s) { return ToField(PercentChange(s.extracted.area, s.measures.area)); } },
  { "mean deviation (mm)", FindDeviation<&SurfaceDeviation::mean> },
  { "95 % deviation (mm)", FindDeviation<&SurfaceDeviation::percentile95> },
  { "largest deviation (mm)", FindDeviation<&SurfaceDeviation::maximum> },
};

std::string
ToCSV(const std::vector<MeshedSurface> & surfaces)
{
  std::string heads;
  for (const Column & column : columns)
  {
    heads += (heads.empty() ? "" : ",") + std::string(column.head);
  }
  std::string text = heads + "\r\n";
  for (const MeshedSurface & surface : surfaces)
  {
    std::string line;
    for (const Column & column : columns)
    {
      line += (&column == columns ? "" : ",") + column.find(surface);
    }
    text += line + "\r\n";
  }
  return text;
}

std::string
ToJsonTable(const std::vector<MeshedSurface> & surfaces, itk::FCCIsosurfaceMode mode)
{
  Report table = Report::array();
  for (const MeshedSurface & surface : surfaces)
  {
    table.push_back(ReportMeshedSurface(surface, mode));
  }
  return ToJson(table) + '\n';
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
StageMeasureTable(const std::vector<MeshedSurface> & surfaces,
                  itk::FCCIsosurfaceMode mode,
                  const fs::path & path,
                  StagedFiles & staged)
{
  CheckMeasureTablePath(path);
  StageText(path.extension() == ".csv" ? ToCSV(surfaces) : ToJsonTable(surfaces, mode), path, staged);
}

} // namespace rhombic
