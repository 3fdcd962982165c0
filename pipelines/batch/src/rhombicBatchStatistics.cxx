#include "rhombicRunBatch.h"

#include "rhombicBatchResults.h"
#include "rhombicFailure.h"
#include "rhombicFiles.h"
#include "rhombicMeasureTable.h"
#include "rhombicQuantile.h"
#include "rhombicSidecar.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <utility>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

using Row = std::vector<std::string>;
using Key = std::pair<std::string, std::string>;

/** The value of a measure in one case. */
struct CaseValue
{
  double value;
  std::string name; ///< of the case
};

/** The estimate of the standard deviation that WriteBatchStatistics() describes. */
double
EstimateDeviation(const std::vector<double> & values, double median)
{
  std::vector<double> differences;
  double sum = 0.0;
  for (const double value : values)
  {
    differences.push_back(std::abs(value - median));
    sum += differences.back();
  }
  std::sort(differences.begin(), differences.end());
  const double middle = Quantile(differences, 0.5);
  return middle > 0.0 ? 1.4826 * middle : 1.2533 * sum / static_cast<double>(values.size());
}

/** A table of tab-separated fields. */
struct Table
{
  Row columns;
  std::vector<Row> rows; ///< of as many fields

  std::size_t
  Find(const std::string & column) const
  {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) - columns.begin());
  }
};

/** Reads a table of a batch. Lines of other lengths than the first are left out. Throws Failure: NotFound; Unreadable,
 * also without a needed column. */
Table
ReadTable(const fs::path & path, const Row & needed)
{
  std::ifstream stream = OpenIfThere(path);
  if (!stream.is_open())
  {
    throw Failure(FailureKind::NotFound,
                  "There is no table " + path.string() + "; run the batch first, or write its tables with --tables.");
  }
  Table table;
  std::string line;
  std::getline(stream, line);
  table.columns = Split(line, "\t");
  for (const std::string & column : needed)
  {
    if (table.Find(column) == table.columns.size())
    {
      throw Failure(FailureKind::Unreadable,
                    "The table " + path.string() + " has no column " + column +
                      "; it is of another version: run the batch again, or write its tables with --tables.");
    }
  }
  while (std::getline(stream, line))
  {
    table.rows.push_back(Split(line, "\t"));
    if (table.rows.back().size() != table.columns.size())
    {
      table.rows.pop_back();
    }
  }
  return table;
}

/** The rows of surfaces of one name that the same outputs have in all cases, by these outputs and the name. */
std::map<Key, std::set<std::size_t>>
GroupSurfaces(const Table & measures, const Table & outputs)
{
  std::map<Key, std::size_t> rowOf; // by case and identity
  for (std::size_t n = 0; n < measures.rows.size(); ++n)
  {
    rowOf[{ measures.rows[n][measures.Find("case")], measures.rows[n][measures.Find("surface_id")] }] = n;
  }
  std::map<Key, std::set<std::size_t>> ofOutputs; // by output and name
  for (const Row & file : outputs.rows)
  {
    for (const std::string & identity : Split(file[outputs.Find("surface_ids")], ","))
    {
      const auto row = rowOf.find({ file[outputs.Find("case")], identity });
      if (row != rowOf.end())
      {
        const std::string & name = measures.rows[row->second][measures.Find("surface")];
        ofOutputs[{ file[outputs.Find("output")], name }].insert(row->second);
      }
    }
  }
  std::map<std::set<std::size_t>, Key> merged; // by the rows
  for (const auto & [key, rows] : ofOutputs)
  {
    auto & [names, surface] = merged[rows];
    names += (names.empty() ? "" : ",") + key.first;
    surface = key.second;
  }
  std::map<Key, std::set<std::size_t>> groups;
  for (const auto & [rows, key] : merged)
  {
    groups[key] = rows;
  }
  return groups;
}

Row
Summarize(const std::vector<CaseValue> & measure)
{
  constexpr double mostDeviations = 3.5;
  constexpr std::size_t fewest = 5;
  std::vector<double> values;
  for (const CaseValue & caseValue : measure)
  {
    values.push_back(caseValue.value);
  }
  std::sort(values.begin(), values.end());
  const double median = Quantile(values, 0.5);
  const double limit = mostDeviations * EstimateDeviation(values, median);
  Row row{ std::to_string(values.size()) };
  for (const double share : { 0.0, 0.25, 0.5, 0.75, 1.0 })
  {
    row.push_back(FormatNumber(Quantile(values, share)));
  }
  std::string apart;
  for (const CaseValue & caseValue : measure)
  {
    if (values.size() >= fewest && std::abs(caseValue.value - median) > limit)
    {
      apart += (apart.empty() ? "" : ", ") + caseValue.name + " (" + FormatNumber(caseValue.value) + ")";
    }
  }
  row.push_back(apart);
  return row;
}

/** Rows with columns that stand below each other; those of numbers are aligned at the right. */
std::string
Align(const std::vector<Row> & rows)
{
  constexpr std::size_t firstNumber = 3;
  std::string text;
  for (const Row & row : rows)
  {
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column)
    {
      std::size_t width = 0;
      for (const Row & other : rows)
      {
        width = std::max(width, other[column].size());
      }
      const std::string blanks(width - row[column].size(), ' ');
      const bool isNumber = column >= firstNumber && column + 1 < row.size();
      line += (isNumber ? blanks + row[column] : row[column] + blanks) + "  ";
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

} // namespace

std::string
WriteBatchStatistics(const fs::path & folder)
{
  const Table measures = ReadTable(folder / "measures.tsv", { "case", "surface_id", "surface" });
  const Table outputs = ReadTable(folder / "outputs.tsv", { "case", "output", "surface_ids" });
  std::vector<Row> rows{
    { "outputs", "surface", "measure", "cases", "least", "q1", "median", "q3", "largest", "apart" }
  };
  for (const auto & [key, members] : GroupSurfaces(measures, outputs))
  {
    for (const MeasureColumn & measure : GetMeasureColumns())
    {
      const std::size_t column = measures.Find(measure.name);
      std::vector<CaseValue> values;
      for (const std::size_t n : members)
      {
        const Row & row = measures.rows[n];
        const auto value = column < row.size() ? ToNumber<double>(row[column]) : std::nullopt;
        if (value && std::isfinite(*value) && measure.unit[0] != '\0')
        {
          values.push_back({ *value, row[measures.Find("case")] });
        }
      }
      if (!values.empty())
      {
        rows.push_back({ key.first, key.second, measure.name });
        const Row summary = Summarize(values);
        rows.back().insert(rows.back().end(), summary.begin(), summary.end());
      }
    }
  }
  std::string table;
  for (const Row & row : rows)
  {
    table += ToLine(row);
  }
  StagedFiles staged;
  StageText(table, folder / "statistics.tsv", staged);
  staged.Commit();
  return Align(rows);
}

} // namespace rhombic
