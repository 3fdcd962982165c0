#include "rhombicBatchAgreement.h"

#include "rhombicBatchResults.h"
#include "rhombicMeasureTable.h"
#include "rhombicQuantile.h"
#include "rhombicWording.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace rhombic
{
namespace
{

/** The rows of a case: see CompareLabels(). A is the reference. */
Report
RowsOf(const Report & record)
{
  return record.value("agreement", Report::array());
}

/** The columns of which statistics are made. */
constexpr std::array<const char *, 10> Measures{
  "volume_difference_ml", "volume_difference_percent", "dice", "iou", "hd_mm", "hd95_mm", "masd_mm", "assd_mm", "nsd",
  "centroid_shift_mm"
};

bool
IsMissing(const Report & row)
{
  return row["status"] != "compared" && row["status"] != "both-empty";
}

/** How badly the labels of a case agree: greater pairs are worse. */
struct Badness
{
  std::ptrdiff_t missing = -1; ///< labels; -1 without a comparison
  double distance = 0.0;       ///< the largest HD95 of a label in mm
  std::string label;           ///< that has this distance
};

Badness
FindBadness(const Report & record)
{
  Badness badness;
  for (const Report & row : RowsOf(record))
  {
    badness.missing = std::max<std::ptrdiff_t>(badness.missing, 0) + (IsMissing(row) ? 1 : 0);
    const Report & distance = row["hd95_mm"];
    if (!distance.is_null() && (badness.label.empty() || distance.get<double>() > badness.distance))
    {
      badness.distance = distance.get<double>();
      badness.label = row["label"].get<std::string>();
    }
  }
  return badness;
}

/** One label of one output in all cases. */
struct LabelOfCases
{
  std::map<std::string, std::size_t> statuses; ///< numbers of cases
  std::map<std::string, std::vector<double>> values;
};

} // namespace

bool
HasAgreement(const std::vector<Report> & cases)
{
  return std::any_of(cases.begin(), cases.end(), [](const Report & record) { return !RowsOf(record).empty(); });
}

std::string
MakeAgreementTable(const std::vector<Report> & cases)
{
  std::string table;
  for (const Report & record : cases)
  {
    for (const Report & row : RowsOf(record))
    {
      std::vector<std::string> heads{ "case" };
      std::vector<std::string> fields{ ToField(record["case"]) };
      for (const auto & [column, value] : row.items())
      {
        heads.push_back(column);
        fields.push_back(ToField(value));
      }
      table += (table.empty() ? ToLine(heads) : "") + ToLine(fields);
    }
  }
  return table;
}

std::string
MakeAgreementStatistics(const std::vector<Report> & cases)
{
  std::map<std::pair<std::string, std::string>, LabelOfCases> labels; // by output and label
  for (const Report & record : cases)
  {
    for (const Report & row : RowsOf(record))
    {
      LabelOfCases & label = labels[{ ToField(row["output"]), ToField(row["label"]) }];
      ++label.statuses[row["status"].get<std::string>()];
      for (const char * const measure : Measures)
      {
        if (!row[measure].is_null())
        {
          label.values[measure].push_back(row[measure].get<double>());
        }
      }
    }
  }
  std::string table = ToLine({ "output",
                               "label",
                               "measure",
                               "compared",
                               "missing_in_reference",
                               "missing_in_case",
                               "cases",
                               "mean",
                               "least",
                               "q1",
                               "median",
                               "q3",
                               "largest" });
  for (auto & [key, label] : labels)
  {
    for (const char * const measure : Measures)
    {
      std::vector<double> & values = label.values[measure];
      std::vector<std::string> fields{ key.first, key.second, measure };
      for (const char * const status : { "compared", "missing-in-A", "missing-in-B" })
      {
        fields.push_back(std::to_string(label.statuses[status]));
      }
      fields.push_back(std::to_string(values.size()));
      if (values.empty())
      {
        fields.insert(fields.end(), 6, "n/a");
      }
      else
      {
        std::sort(values.begin(), values.end());
        const double sum = std::accumulate(values.begin(), values.end(), 0.0);
        fields.push_back(FormatNumber(sum / static_cast<double>(values.size())));
        for (const double share : { 0.0, 0.25, 0.5, 0.75, 1.0 })
        {
          fields.push_back(FormatNumber(Quantile(values, share)));
        }
      }
      table += ToLine(fields);
    }
  }
  return table;
}

std::vector<Report>
WorstFirst(std::vector<Report> cases)
{
  std::vector<std::pair<Badness, const Report *>> order;
  for (const Report & record : cases)
  {
    order.emplace_back(FindBadness(record), &record);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto & one, const auto & other) {
    return std::pair(one.first.missing, one.first.distance) > std::pair(other.first.missing, other.first.distance);
  });
  std::vector<Report> sorted;
  std::transform(
    order.begin(), order.end(), std::back_inserter(sorted), [](const auto & entry) { return *entry.second; });
  return sorted;
}

std::vector<std::string>
SummarizeAgreementOf(const Report & record)
{
  std::string missing;
  std::vector<double> dice;
  for (const Report & row : RowsOf(record))
  {
    if (IsMissing(row))
    {
      missing += (missing.empty() ? "" : ", ") + row["label"].get<std::string>() +
                 (row["status"] == "missing-in-A" ? " is not in the reference" : " is missing");
    }
    if (!row["dice"].is_null())
    {
      dice.push_back(row["dice"].get<double>());
    }
  }
  std::vector<std::string> sentences;
  if (!missing.empty())
  {
    sentences.push_back(missing);
  }
  if (const Badness badness = FindBadness(record); !badness.label.empty())
  {
    sentences.push_back("HD95 up to " + FormatFixed(badness.distance, 1) + " mm (" + badness.label + ")");
  }
  if (!dice.empty())
  {
    const double sum = std::accumulate(dice.begin(), dice.end(), 0.0);
    sentences.push_back("mean Dice " + FormatFixed(sum / static_cast<double>(dice.size()), 3) + " of " +
                        Count(dice.size(), "label"));
  }
  return sentences;
}

} // namespace rhombic
