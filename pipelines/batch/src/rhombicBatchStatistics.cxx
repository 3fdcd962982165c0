#include "rhombicBatchStatistics.h"

#include "rhombicFailure.h"
#include "rhombicSidecar.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <tuple>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

using Row = std::vector<std::string>;

/** The value of a measure in one case. */
struct CaseValue
{
  double value;
  std::string name; ///< of the case
};

/** Output, surface, and column of the measure. */
using MeasureKey = std::tuple<std::string, std::string, std::size_t>;

/** \param sorted at least one value
 * \param share from 0 to 1 */
double
Quantile(const std::vector<double> & sorted, double share)
{
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

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

/** The numbers in a table of measures. */
std::map<MeasureKey, std::vector<CaseValue>>
ReadMeasures(std::istream & table, Row & columns)
{
  std::map<MeasureKey, std::vector<CaseValue>> measures;
  std::string line;
  std::getline(table, line);
  columns = Split(line, "\t");
  const auto columnOf = [&columns](const std::string & name) {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
  };
  const std::size_t output = columnOf("output");
  const std::size_t surface = columnOf("name");
  while (std::getline(table, line))
  {
    const Row fields = Split(line, "\t");
    for (std::size_t column = 1; column < std::min(fields.size(), columns.size()); ++column)
    {
      const auto value = ToNumber<double>(fields[column]);
      if (value && std::isfinite(*value) && column != output && column != surface && output < fields.size() &&
          surface < fields.size())
      {
        measures[{ fields[output], fields[surface], column }].push_back({ *value, fields[0] });
      }
    }
  }
  return measures;
}

Row
Summarize(const std::vector<CaseValue> & measure)
{
  constexpr double mostDeviations = 3.5;
  constexpr std::size_t fewest = 5;
  std::vector<double> values;
  for (const CaseValue & one : measure)
  {
    values.push_back(one.value);
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
  for (const CaseValue & one : measure)
  {
    if (values.size() >= fewest && std::abs(one.value - median) > limit)
    {
      apart += (apart.empty() ? "" : ", ") + one.name + " (" + FormatNumber(one.value) + ")";
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
  std::ifstream stream(folder / "measures.tsv");
  if (!stream)
  {
    throw Failure(FailureKind::NotFound,
                  "There is no table " + (folder / "measures.tsv").string() +
                    "; run the batch first, or write its tables with --tables.");
  }
  Row columns;
  std::vector<Row> rows{ { "output", "name", "measure", "cases", "least", "q1", "median", "q3", "largest", "apart" } };
  for (const auto & [key, values] : ReadMeasures(stream, columns))
  {
    const auto & [output, surface, column] = key;
    rows.push_back({ output, surface, columns[column] });
    const Row summary = Summarize(values);
    rows.back().insert(rows.back().end(), summary.begin(), summary.end());
  }
  std::string table;
  for (const Row & row : rows)
  {
    for (const std::string & field : row)
    {
      table += (&field == &row.front() ? "" : "\t") + field;
    }
    table += '\n';
  }
  StagedFiles staged;
  StageText(table, folder / "statistics.tsv", staged);
  staged.Commit();
  return Align(rows);
}

} // namespace rhombic
