#include "rhombicAgreementTable.h"

#include "rhombicFailure.h"
#include "rhombicMeasureTable.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <sstream>

namespace rhombic
{
namespace
{

/** A column of the table. */
struct Column
{
  const char * name; ///< in snake_case, with the unit at its end
  Report (*find)(const LabelAgreement & label);
  bool isAveraged = false; ///< over all labels
  bool (*isNeeded)(const CompareLabelsSettings & settings) = [](const CompareLabelsSettings &) { return true; };
};

bool
HasParts(const CompareLabelsSettings & settings)
{
  return !settings.parts.empty();
}

bool
HasVoxelMetrics(const CompareLabelsSettings & settings)
{
  return settings.hasVoxelMetrics;
}

Report
NumberOrNull(std::optional<double> number)
{
  return number && std::isfinite(*number) ? Report(*number) : Report();
}

/** A measure of the surfaces of both segmentations. */
template <double itk::TriangleSurfaceAgreement::*measure>
Report
FindMeasure(const LabelAgreement & label)
{
  return label.status == AgreementStatus::Compared ? NumberOrNull(label.surfaces.*measure) : Report();
}

template <std::size_t axis>
Report
FindWorst(const LabelAgreement & label)
{
  return label.status == AgreementStatus::Compared ? NumberOrNull(label.surfaces.worst[axis]) : Report();
}

std::string
NameStatus(AgreementStatus status)
{
  switch (status)
  {
    case AgreementStatus::MissingInFirst:
      return "missing-in-A";
    case AgreementStatus::MissingInSecond:
      return "missing-in-B";
    case AgreementStatus::BothEmpty:
      return "both-empty";
    case AgreementStatus::Compared:
      break;
  }
  return "compared";
}

std::string
NameWorstSide(const LabelAgreement & label)
{
  return label.surfaces.worstSide == itk::TriangleSurfaceAgreement::Side::First ? "A" : "B";
}

double
FindDifference(const LabelAgreement & label)
{
  return label.second.millilitres - label.first.millilitres;
}

/** In ml for each year of 365.25 days. */
std::optional<double>
FindGrowth(const LabelAgreement & label)
{
  constexpr double daysOfYear = 365.25;
  return label.days ? std::optional(FindDifference(label) / *label.days * daysOfYear) : std::nullopt;
}

/** The days in which a volume that grows exponentially doubles; nothing for one that does not grow. */
std::optional<double>
FindDoublingTime(const LabelAgreement & label)
{
  const bool grows = label.first.millilitres > 0.0 && label.second.millilitres > label.first.millilitres;
  return label.days && grows
           ? std::optional(*label.days * std::log(2.0) / std::log(label.second.millilitres / label.first.millilitres))
           : std::nullopt;
}

template <double VoxelMetrics::*measure>
Report
FindVoxelMetric(const LabelAgreement & label)
{
  return label.voxels ? NumberOrNull((*label.voxels).*measure) : Report();
}

template <std::size_t PartChange::*count>
Report
CountParts(const LabelAgreement & label)
{
  return label.change ? Report((*label.change).*count) : Report();
}

const Column Columns[] = {
  { "label", [](const LabelAgreement & label) { return Report(label.label); } },
  { "status", [](const LabelAgreement & label) { return Report(NameStatus(label.status)); } },
  { "volume_a_ml", [](const LabelAgreement & label) { return NumberOrNull(label.first.millilitres); } },
  { "volume_b_ml", [](const LabelAgreement & label) { return NumberOrNull(label.second.millilitres); } },
  { "volume_difference_ml", [](const LabelAgreement & label) { return NumberOrNull(FindDifference(label)); } },
  { "volume_difference_percent",
    [](const LabelAgreement & label) {
      return label.first.millilitres > 0.0 ? NumberOrNull(100.0 * FindDifference(label) / label.first.millilitres)
                                           : Report();
    } },
  { "voxel_volume_a_ml", [](const LabelAgreement & label) { return NumberOrNull(label.first.voxelMillilitres); } },
  { "voxel_volume_b_ml", [](const LabelAgreement & label) { return NumberOrNull(label.second.voxelMillilitres); } },
  { "dice", [](const LabelAgreement & label) { return NumberOrNull(label.dice); }, true },
  { "iou", [](const LabelAgreement & label) { return NumberOrNull(label.iou); }, true },
  { "hd_mm", FindMeasure<&itk::TriangleSurfaceAgreement::hausdorff>, true },
  { "hd95_mm", FindMeasure<&itk::TriangleSurfaceAgreement::hausdorff95>, true },
  { "masd_mm", FindMeasure<&itk::TriangleSurfaceAgreement::meanOfMeans>, true },
  { "assd_mm", FindMeasure<&itk::TriangleSurfaceAgreement::pooledMean>, true },
  { "nsd",
    [](const LabelAgreement & label) {
      return label.status == AgreementStatus::BothEmpty ? Report() : NumberOrNull(label.surfaces.normalizedDice);
    },
    true },
  { "tolerance_mm", [](const LabelAgreement & label) { return NumberOrNull(label.tolerance); } },
  { "noise_floor_mm", [](const LabelAgreement & label) { return NumberOrNull(label.noiseFloor); } },
  { "days", [](const LabelAgreement & label) { return NumberOrNull(label.days); } },
  { "growth_ml_per_year", [](const LabelAgreement & label) { return NumberOrNull(FindGrowth(label)); } },
  { "doubling_time_days", [](const LabelAgreement & label) { return NumberOrNull(FindDoublingTime(label)); } },
  { "centroid_shift_mm", [](const LabelAgreement & label) { return NumberOrNull(label.centroidShift); }, true },
  { "worst_x_mm", FindWorst<0> },
  { "worst_y_mm", FindWorst<1> },
  { "worst_z_mm", FindWorst<2> },
  { "worst_side",
    [](const LabelAgreement & label) {
      return label.status == AgreementStatus::Compared ? Report(NameWorstSide(label)) : Report();
    } },
  { "change",
    [](const LabelAgreement & label) { return label.change ? Report(NameChange(*label.change)) : Report(); },
    false,
    HasParts },
  { "parts_a", CountParts<&PartChange::partsOfFirst>, false, HasParts },
  { "parts_b", CountParts<&PartChange::partsOfSecond>, false, HasParts },
  { "deepmind_mean_a_to_b_mm", FindVoxelMetric<&VoxelMetrics::meanToSecond>, true, HasVoxelMetrics },
  { "deepmind_mean_b_to_a_mm", FindVoxelMetric<&VoxelMetrics::meanToFirst>, true, HasVoxelMetrics },
  { "deepmind_hd_mm", FindVoxelMetric<&VoxelMetrics::hausdorff>, true, HasVoxelMetrics },
  { "deepmind_hd95_mm", FindVoxelMetric<&VoxelMetrics::hausdorff95>, true, HasVoxelMetrics },
  { "deepmind_nsd", FindVoxelMetric<&VoxelMetrics::normalizedDice>, true, HasVoxelMetrics },
};

/** The columns of a table, which always has the same ones for the same settings. */
std::vector<Column>
ColumnsFor(const CompareLabelsSettings & settings)
{
  std::vector<Column> columns;
  std::copy_if(std::begin(Columns), std::end(Columns), std::back_inserter(columns), [&](const Column & column) {
    return column.isNeeded(settings);
  });
  return columns;
}

/** "7 compared, 1 missing-in-A, 2 missing-in-B". */
std::string
CountStatuses(const std::vector<LabelAgreement> & labels)
{
  std::string text;
  using Status = AgreementStatus;
  for (const Status status : { Status::Compared, Status::MissingInFirst, Status::MissingInSecond, Status::BothEmpty })
  {
    const auto count = std::count_if(
      labels.begin(), labels.end(), [status](const LabelAgreement & label) { return label.status == status; });
    if (count > 0 || status == Status::Compared)
    {
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + NameStatus(status);
    }
  }
  return text;
}

Report
ReportMeans(const std::vector<LabelAgreement> & labels, const std::vector<Column> & columns)
{
  Report row;
  for (const Column & column : columns)
  {
    double sum = 0.0;
    std::size_t count = 0;
    for (const LabelAgreement & label : labels)
    {
      const Report value = column.isAveraged ? column.find(label) : Report();
      sum += value.is_null() ? 0.0 : value.get<double>();
      count += value.is_null() ? 0 : 1;
    }
    row[column.name] = count > 0 ? Report(sum / static_cast<double>(count)) : Report();
  }
  row["label"] = "mean";
  row["status"] = CountStatuses(labels);
  return row;
}

} // namespace

std::string
NameChange(const PartChange & change)
{
  if (change.partsOfFirst == 0 || change.partsOfSecond == 0)
  {
    return change.partsOfFirst == 0 ? "new" : "gone";
  }
  const bool isSplit = change.partsOfSecond > 1;
  const bool isMerged = change.partsOfFirst > 1;
  return isSplit && isMerged ? "regrouped" : isSplit ? "split" : isMerged ? "merged" : "kept";
}

Report
ReportAgreement(const std::vector<LabelAgreement> & labels, const CompareLabelsSettings & settings)
{
  const std::vector<Column> columns = ColumnsFor(settings);
  Report rows = Report::array();
  for (const LabelAgreement & label : labels)
  {
    Report row;
    for (const Column & column : columns)
    {
      row[column.name] = column.find(label);
    }
    rows.push_back(row);
  }
  rows.push_back(ReportMeans(labels, columns));
  return rows;
}

std::string
WriteAgreement(const Report & rows, const std::string & extension)
{
  if (extension == ".json")
  {
    return ToJson(rows) + '\n';
  }
  const bool isCSV = extension == ".csv";
  const char * const between = isCSV ? "," : "\t";
  const char * const end = isCSV ? "\r\n" : "\n";
  std::ostringstream text;
  const auto addLine = [&](const Report & row, const auto & fieldOf) {
    const char * before = "";
    for (auto field = row.begin(); field != row.end(); ++field)
    {
      text << before << fieldOf(field);
      before = between;
    }
    text << end;
  };
  addLine(rows.front(), [](const auto & field) { return field.key(); });
  for (const Report & row : rows)
  {
    addLine(row, [isCSV](const auto & field) { return isCSV ? ToCSVField(field.value()) : ToField(field.value()); });
  }
  return text.str();
}

void
CheckAgreementPath(const std::filesystem::path & path)
{
  const std::string extension = path.extension().string();
  if (extension != ".csv" && extension != ".tsv" && extension != ".json")
  {
    throw Failure(FailureKind::Usage,
                  "Cannot write the table to " + path.string() + ": use the extension .csv, .tsv or .json.");
  }
}

std::string
SummarizeAgreement(const LabelAgreement & label)
{
  if (label.status != AgreementStatus::Compared)
  {
    return label.label + ": " + (label.change ? NameChange(*label.change) : NameStatus(label.status));
  }
  const auto & surfaces = label.surfaces;
  return label.label + ": " + (label.change ? NameChange(*label.change) + ", " : "") +
         (label.dice ? "Dice " + FormatFixed(*label.dice, 3) + ", " : "") + "HD95 " +
         FormatFixed(surfaces.hausdorff95, 2) + " mm, HD " + FormatFixed(surfaces.hausdorff, 2) + " mm, MASD " +
         FormatFixed(surfaces.meanOfMeans, 2) + " mm, NSD " + FormatFixed(surfaces.normalizedDice, 3) + " at " +
         FormatNumber(label.tolerance) + " mm" +
         (label.noiseFloor && surfaces.meanOfMeans > 0.0 && surfaces.meanOfMeans < *label.noiseFloor
            ? "; below the noise floor of " + FormatFixed(*label.noiseFloor, 2) + " mm"
            : "");
}

std::string
DescribeAgreement(const std::vector<LabelAgreement> & labels)
{
  struct Shown
  {
    const char * column;
    const char * heading;
    int decimals;
  };
  constexpr Shown shown[] = { { "volume_a_ml", "A ml", 2 }, { "volume_b_ml", "B ml", 2 }, { "dice", "Dice", 3 },
                              { "hd95_mm", "HD95 mm", 2 },  { "hd_mm", "HD mm", 2 },      { "masd_mm", "MASD mm", 2 },
                              { "nsd", "NSD", 3 } };
  const CompareLabelsSettings settings;
  const Report rows = ReportAgreement(labels, settings);
  std::size_t width = 5;
  for (const Report & row : rows)
  {
    width = std::max(width, row["label"].get<std::string>().size());
  }
  std::ostringstream text;
  text << std::left << std::setw(static_cast<int>(width)) << "label" << std::right;
  for (const Shown & column : shown)
  {
    text << std::setw(10) << column.heading;
  }
  text << "  status\n";
  for (const Report & row : rows)
  {
    text << std::left << std::setw(static_cast<int>(width)) << row["label"].get<std::string>() << std::right;
    for (const Shown & column : shown)
    {
      const Report & value = row[column.column];
      text << std::setw(10) << (value.is_null() ? "" : FormatFixed(value.get<double>(), column.decimals));
    }
    text << "  " << row["status"].get<std::string>();
    const auto number = static_cast<std::size_t>(&row - &rows.front());
    if (number < labels.size() && labels[number].change)
    {
      text << ", " << NameChange(*labels[number].change);
    }
    text << '\n';
  }
  return text.str();
}

} // namespace rhombic
