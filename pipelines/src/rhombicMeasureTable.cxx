#include "rhombicMeasureTable.h"

#include "rhombicFailure.h"
#include "rhombicSidecar.h"
#include "rhombicSurfaceReport.h"
#include "rhombicWording.h"

#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iomanip>
#include <iterator>
#include <sstream>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

using Surface = MeshedSurface;

/** Null for NaN and infinite numbers. */
Report
FiniteOrNull(double number)
{
  return std::isfinite(number) ? Report(number) : Report();
}

Report
FiniteOrNull(const std::optional<double> & number)
{
  return number ? FiniteOrNull(*number) : Report();
}

Report
MillilitresOrNull(const std::optional<double> & volume)
{
  return volume ? FiniteOrNull(*volume / CubicMillimetresPerMl) : Report();
}

template <auto Member>
Report
FindMeasure(const Surface & surface)
{
  return FiniteOrNull(surface.measures.*Member);
}

Report
FindMode(const Surface & surface)
{
  std::ostringstream mode;
  mode << surface.mode;
  return surface.request ? Report(mode.str()) : Report();
}

template <double IsosurfaceVolume::*Member>
Report
FindIsosurface(const Surface & surface)
{
  const auto & isosurface = surface.measures.isosurface;
  return isosurface ? MillilitresOrNull((*isosurface).*Member) : Report();
}

std::string
SayIsosurface(double ml, const Surface & surface)
{
  const auto & measures = surface.measures;
  return DescribeDifference(measures.GetVolumeError().value()) + " than the scan's isosurface encloses (" +
         DescribeVolume(ml, measures.isosurface->uncertainty / CubicMillimetresPerMl) + ")";
}

template <std::size_t Bound>
Report
FindBound(const Surface & surface)
{
  return FiniteOrNull(surface.measures.bounds[Bound]);
}

template <std::size_t Axis>
Report
FindCentroid(const Surface & surface)
{
  return FiniteOrNull(surface.measures.centroid[Axis]);
}

template <double SurfaceDeviation::*Member>
Report
FindDeviation(const Surface & surface)
{
  const auto & deviation = surface.deviation;
  return deviation && deviation->IsKnown() ? FiniteOrNull((*deviation).*Member) : Report();
}

/** The volume of the voxels that a surface should enclose, in mm^3, counted without the surface. Nothing where parts
 * were left out. */
std::optional<double>
CountVoxels(const Surface & surface, const Scan * scan)
{
  if (!surface.parts.IsNothing())
  {
    return std::nullopt;
  }
  if (surface.label)
  {
    return surface.label->voxelMillilitres * CubicMillimetresPerMl;
  }
  if (scan != nullptr && surface.request && surface.request->parts == SurfaceRequest::Parts::All)
  {
    return CountVoxelVolume(*scan, surface.request->GetThreshold());
  }
  return std::nullopt;
}

/** A hash of a surface's name and triangles, whatever their order. */
std::string
Identify(const std::string & name, const itk::TriangleSurface & surface)
{
  std::uint64_t sum = 0;
  for (const auto & triangle : surface.GetTriangles())
  {
    std::array<itk::TriangleSurface::PointType, 3> corners;
    for (std::size_t n = 0; n < 3; ++n)
    {
      corners[n] = surface.GetPoints()[triangle[n]];
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    std::uint64_t hash = 0;
    for (const auto & corner : corners)
    {
      for (const float coordinate : corner)
      {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &coordinate, sizeof(bits));
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15u; // the golden ratio in 64 bits, as in Steele et al. 2014
        hash ^= hash >> 29;
      }
    }
    sum += hash;
  }
  return HashText(name + '\n' + std::to_string(sum)).substr(0, 12);
}

constexpr MeasureColumn Columns[] = {
  { "surface_id",
    "",
    "Identifies the surface as finished: a hash of its name and triangles.",
    [](const Surface & s) { return Report(s.identity); } },
  { "surface", "", "The surface's name.", [](const Surface & s) { return Report(s.scene.name); } },
  { "kind",
    "",
    "isosurface, label, or file: where the surface comes from.",
    [](const Surface & s) {
      return Report(s.request ? "isosurface" : s.label ? "label" : "file");
    } },
  { "label_value",
    "",
    "The label's number in the label map.",
    [](const Surface & s) { return s.label ? Report(s.label->value) : Report(); } },
  { "isovalue_scan_unit",
    "unit of the scan's values (HU for CT)",
    "The threshold of an isosurface.",
    [](const Surface & s) { return s.request ? FiniteOrNull(s.request->isovalue) : Report(); } },
  { "inside",
    "",
    "above or below: the side of the threshold that is inside.",
    [](const Surface & s) { return s.request ? Report(s.request->insideIsBelow ? "below" : "above") : Report(); } },
  { "mode", "", "How an isosurface is put through the lattice's cells.", FindMode },
  { "volume_ml",
    "mL",
    "The volume that the finished surface encloses.",
    [](const Surface & s) { return MillilitresOrNull(s.measures.volume); },
    [](double ml, const Surface &) { return DescribeVolume(ml); } },
  { "isosurface_volume_ml",
    "mL",
    "The volume inside the scan's isosurface, estimated from the lattice's samples.",
    FindIsosurface<&IsosurfaceVolume::volume>,
    SayIsosurface },
  { "isosurface_uncertainty_ml",
    "mL",
    "The uncertainty of isosurface_volume_ml.",
    FindIsosurface<&IsosurfaceVolume::uncertainty> },
  { "voxel_volume_ml",
    "mL",
    "The volume of the voxels of the label, or on the inner side of the threshold.",
    [](const Surface & s) { return MillilitresOrNull(s.measures.voxelVolume); },
    [](double ml, const Surface &) { return "voxels " + DescribeVolume(ml); } },
  { "volume_error_percent",
    "%",
    "By how much volume_ml is above its reference.",
    [](const Surface & s) { return FiniteOrNull(s.measures.GetVolumeError()); } },
  { "volume_error_reference",
    "",
    "isosurface or voxels: the reference of volume_error_percent.",
    [](const Surface & s) {
      return s.measures.GetVolumeError() ? Report(s.measures.isosurface ? "isosurface" : "voxels") : Report();
    } },
  { "area_mm2",
    "mm^2",
    "The area of the finished surface.",
    FindMeasure<&SurfaceMeasures::area>,
    [](double area, const Surface &) { return DescribeArea(area); } },
  { "x_min_mm", "mm", "The lowest coordinate to the patient's left (LPS).", FindBound<0> },
  { "x_max_mm", "mm", "The highest coordinate to the patient's left (LPS).", FindBound<1> },
  { "y_min_mm", "mm", "The lowest coordinate to the patient's back (LPS).", FindBound<2> },
  { "y_max_mm", "mm", "The highest coordinate to the patient's back (LPS).", FindBound<3> },
  { "z_min_mm", "mm", "The lowest coordinate to the patient's head (LPS).", FindBound<4> },
  { "z_max_mm", "mm", "The highest coordinate to the patient's head (LPS).", FindBound<5> },
  { "centroid_x_mm", "mm", "The centre of the enclosed volume, to the patient's left (LPS).", FindCentroid<0> },
  { "centroid_y_mm", "mm", "The centre of the enclosed volume, to the patient's back (LPS).", FindCentroid<1> },
  { "centroid_z_mm", "mm", "The centre of the enclosed volume, to the patient's head (LPS).", FindCentroid<2> },
  { "longest_diameter_mm",
    "mm",
    "The largest distance between two points of the surface.",
    FindMeasure<&SurfaceMeasures::longestDiameter>,
    [](double diameter, const Surface &) { return "longest diameter " + DescribeLength(diameter); } },
  { "mean_scan_unit",
    "unit of the scan's values (HU for CT)",
    "The mean of the scan's values inside the surface.",
    FindMeasure<&SurfaceMeasures::meanValue>,
    [](double mean, const Surface &) { return "mean value " + FormatFixed(mean, 1); } },
  { "standard_deviation_scan_unit",
    "unit of the scan's values (HU for CT)",
    "The standard deviation of the scan's values inside the surface.",
    FindMeasure<&SurfaceMeasures::standardDeviation> },
  { "points", "count", "The number of points.", [](const Surface & s) { return Report(s.points); } },
  { "triangles", "count", "The number of triangles.", [](const Surface & s) { return Report(s.triangles); } },
  { "extracted_volume_ml",
    "mL",
    "The volume at extraction, before parts were removed and the surface was smoothed or simplified.",
    [](const Surface & s) { return s.extracted ? MillilitresOrNull(s.extracted->volume) : Report(); } },
  { "extracted_area_mm2",
    "mm^2",
    "The area at extraction.",
    [](const Surface & s) { return s.extracted ? FiniteOrNull(s.extracted->area) : Report(); } },
  { "extracted_triangles",
    "count",
    "The number of triangles at extraction.",
    [](const Surface & s) { return s.extracted ? Report(s.extracted->triangles) : Report(); } },
  { "finishing_volume_change_percent",
    "%",
    "By how much volume_ml is above extracted_volume_ml.",
    [](const Surface & s) {
      return s.extracted ? FiniteOrNull(PercentChange(s.extracted->volume, s.measures.volume)) : Report();
    } },
  { "finishing_area_change_percent",
    "%",
    "By how much area_mm2 is above extracted_area_mm2.",
    [](const Surface & s) {
      return s.extracted ? FiniteOrNull(PercentChange(s.extracted->area, s.measures.area)) : Report();
    } },
  { "deviation_mean_mm",
    "mm",
    "The mean distance from the surface to the scan's isosurface.",
    FindDeviation<&SurfaceDeviation::mean> },
  { "deviation_percentile95_mm",
    "mm",
    "The distance to the scan's isosurface that 95 % of the surface stay within.",
    FindDeviation<&SurfaceDeviation::percentile95> },
  { "deviation_maximum_mm",
    "mm",
    "The largest distance from the surface to the scan's isosurface.",
    FindDeviation<&SurfaceDeviation::maximum> },
  { "deviation_bias_mm",
    "mm",
    "The mean of the signed distances; above 0 where the surface lies outside the isosurface.",
    FindDeviation<&SurfaceDeviation::bias> },
};

/** Texts are in quotes, in which quotes are doubled (RFC 4180). */
std::string
ToCSV(const std::vector<MeshedSurface> & surfaces)
{
  std::ostringstream text;
  for (const MeasureColumn & column : Columns)
  {
    text << (&column == Columns ? "" : ",") << column.name;
  }
  text << "\r\n";
  for (const MeshedSurface & surface : surfaces)
  {
    for (const MeasureColumn & column : Columns)
    {
      text << (&column == Columns ? "" : ",") << ToCSVField(column.find(surface));
    }
    text << "\r\n";
  }
  return text.str();
}

} // namespace

const std::vector<MeasureColumn> &
GetMeasureColumns()
{
  static const std::vector<MeasureColumn> columns(std::begin(Columns), std::end(Columns));
  return columns;
}

ExtractedSize
MeasureExtracted(const itk::TriangleSurface & surface)
{
  return { ComputeTriangleSurfaceVolume(surface), ComputeTriangleSurfaceArea(surface), surface.GetNumberOfTriangles() };
}

void
MeasureFinished(const Scan * scan, MeshedSurface & surface)
{
  const itk::TriangleSurface & finished = *surface.scene.surface;
  surface.identity = Identify(surface.scene.name, finished);
  if (const auto & whole = surface.whole)
  {
    surface.points = whole->points;
    surface.triangles = whole->triangles;
    surface.measures.volume = whole->volume;
    surface.measures.area = whole->area;
    surface.measures.bounds = whole->bounds;
    surface.measures.centroid = whole->centroid;
    surface.measures.longestDiameter = std::nan(""); // not known, nor the values inside
    return;
  }
  surface.points = finished.GetNumberOfPoints();
  surface.triangles = finished.GetNumberOfTriangles();
  surface.measures = scan != nullptr ? MeasureSurface(finished, *scan) : MeasureSurface(finished);
  surface.measures.voxelVolume = CountVoxels(surface, scan);
}

Report
ReportMeasures(const MeshedSurface & surface)
{
  if (surface.label && surface.label->isPart)
  {
    return { { "voxel_volume_ml", surface.label->voxelMillilitres } };
  }
  Report report;
  for (const MeasureColumn & column : GetMeasureColumns())
  {
    if (Report value = column.find(surface); !value.is_null())
    {
      report[column.name] = std::move(value);
    }
  }
  return report;
}

std::string
SummarizeMeasures(const MeshedSurface & surface)
{
  std::string text;
  for (const MeasureColumn & column : GetMeasureColumns())
  {
    const Report value = column.say != nullptr ? column.find(surface) : Report();
    if (!value.is_null())
    {
      text += (text.empty() ? ": " : ", ") + column.say(value.get<double>(), surface);
    }
  }
  return surface.scene.name + text;
}

std::string
DescribeDifference(double percent)
{
  return FormatFixed(std::abs(percent), 1) + (percent < 0.0 ? " % less" : " % more");
}

void
DescribeColumn(const std::string & name, const std::string & unit, const std::string & description, Report & columns)
{
  columns[name]["Description"] = description;
  if (!unit.empty())
  {
    columns[name]["Units"] = unit;
  }
}

Report
DescribeMeasures()
{
  Report columns;
  for (const MeasureColumn & column : GetMeasureColumns())
  {
    DescribeColumn(column.name, column.unit, column.description, columns);
  }
  return columns;
}

std::string
ToField(const Report & value)
{
  std::string text = value.is_null() ? "n/a" : value.is_string() ? value.get<std::string>() : ToJson(value);
  std::replace_if(
    text.begin(), text.end(), [](unsigned char letter) { return letter < ' '; }, ' ');
  return text;
}

std::string
ToCSVField(const Report & value)
{
  std::ostringstream text;
  text << std::quoted(ToField(value), '"', '"');
  return value.is_string() ? text.str() : ToField(value);
}

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
StageMeasureTable(const std::vector<MeshedSurface> & surfaces, const fs::path & path, StagedFiles & staged)
{
  Report table = Report::array();
  std::transform(surfaces.begin(), surfaces.end(), std::back_inserter(table), ReportMeshedSurface);
  StageText(path.extension() == ".csv" ? ToCSV(surfaces) : ToJson(table) + '\n', path, staged);
}

} // namespace rhombic
