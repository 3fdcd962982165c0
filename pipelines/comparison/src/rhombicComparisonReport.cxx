#include "rhombicComparisonSteps.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace rhombic
{
namespace
{

/** A column of the tables: a heading, the figure, and whether its ratio to the reference is added. */
struct Column
{
  const char * heading;
  const char * figure;
  bool hasRatio;
};

constexpr Column columns[] = { { "samples", "samples", false },
                               { "per h³", "density", false },
                               { "triangles", "triangles", true },
                               { "judged", "judged", true },
                               { "Q", "q", false },
                               { "mean", "mean", true },
                               { "±", "spread", false },
                               { "RMS", "rms", false },
                               { "max", "max", false },
                               { "mean back", "back-mean", true },
                               { "max back", "back-max", false },
                               { "gap", "gap", false },
                               { "facet °", "facet", true },
                               { "point °", "vertex", false },
                               { "quality", "quality", false },
                               { "parts", "parts", false },
                               { "genus", "genus", false },
                               { "flaws", "flaws", false } };

/** Three significant digits; whole numbers from 100 on, so that counts keep all of theirs. */
std::string
Format(double value)
{
  return std::abs(value) >= 100.0 ? FormatFixed(value, 0) : FormatNumber(value, 3);
}

/** The columns that have a figure in any row. */
std::vector<Column>
ColumnsOf(const ExperimentResult & result)
{
  std::vector<Column> used;
  std::copy_if(std::begin(columns), std::end(columns), std::back_inserter(used), [&](const Column & column) {
    return std::any_of(
      result.rows.begin(), result.rows.end(), [&](const Figures & row) { return row.count(column.figure) > 0; });
  });
  return used;
}

std::string
Cell(const ExperimentResult & result, std::size_t row, const Column & column)
{
  const auto found = result.rows[row].find(column.figure);
  if (found == result.rows[row].end())
  {
    return "";
  }
  std::string cell = Format(found->second);
  if (column.hasRatio && row > 0)
  {
    cell += " (" + FormatFixed(found->second / result.rows[0].at(column.figure), 2) + ")";
  }
  const auto & printed = result.experiment.rows[row].printed;
  const auto inPaper = printed.find(column.figure);
  return inPaper == printed.end() ? cell : cell + " [" + Format(inPaper->second) + "]";
}

/** The figure of a reference such as hand.2.mean. */
double
FindFigure(const std::string & reference, const std::vector<ExperimentResult> & all)
{
  const auto parts = Split(reference, ".");
  const auto row = parts.size() == 3 ? ToNumber<std::size_t>(parts[1]) : std::nullopt;
  for (const ExperimentResult & result : all)
  {
    if (row && result.experiment.name == parts[0] && *row <= result.rows.size())
    {
      const Figures & figures = *row == 0 ? result.truth : result.rows[*row - 1];
      if (const auto found = figures.find(parts[2]); found != figures.end())
      {
        return found->second;
      }
    }
  }
  throw Failure(FailureKind::Unreadable,
                "A text has the figure '" + reference +
                  "', which is none; write experiment.row.figure, with row 0 for the true surface.");
}

} // namespace

std::string
LabelOf(const ExperimentResult & result, std::size_t row)
{
  const ComparedRow & request = result.experiment.rows[row];
  std::string label = request.method;
  if (request.samples == 0.0 && request.density != 1.0)
  {
    label += " " + FormatFixed(request.density, 2);
  }
  return label + (request.isResampled ? ", resampled" : "");
}

std::string
FillIn(const std::string & text, const std::vector<ExperimentResult> & all)
{
  std::string filled;
  std::size_t from = 0;
  for (std::size_t begin; (begin = text.find("${", from)) != std::string::npos;)
  {
    const std::size_t end = std::min(text.find('}', begin), text.size());
    const auto parts = Split(text.substr(begin + 2, end - begin - 2), "/");
    filled += text.substr(from, begin - from);
    filled += parts.size() == 2 ? FormatFixed(FindFigure(parts[0], all) / FindFigure(parts[1], all), 2)
                                : Format(FindFigure(parts[0], all));
    from = std::min(end + 1, text.size());
  }
  return filled + text.substr(from);
}

std::string
MarkdownOf(const ExperimentResult & result,
           const std::vector<ExperimentResult> & all,
           const std::vector<PagePicture> & pictures)
{
  std::string text = "## " + result.experiment.title + "\n\n| lattice | method |";
  std::string line = "|---|---|";
  for (const Column & column : ColumnsOf(result))
  {
    text += std::string(" ") + column.heading + " |";
    line += "---|";
  }
  text += "\n" + line + "\n";
  for (std::size_t row = 0; row < result.rows.size(); ++row)
  {
    text += "| " + GetComparedMethod(result.experiment.rows[row].method).lattice + " | " + LabelOf(result, row) + " |";
    for (const Column & column : ColumnsOf(result))
    {
      text += " " + Cell(result, row, column) + " |";
    }
    text += "\n";
  }
  text += "\nTrue surface: " + Count(static_cast<std::uintmax_t>(result.truth.at("parts")), "part") + ", genus " +
          Format(result.truth.at("genus")) + ".\n";
  if (!result.experiment.text.empty())
  {
    text += "\n" + FillIn(result.experiment.text, all) + (result.experiment.text.back() == '\n' ? "" : "\n");
  }
  for (const PagePicture & picture : pictures)
  {
    text += "\n![" + result.experiment.title + "](" + picture.file + ")\n\n*" + picture.caption + "*\n";
  }
  return text;
}

std::string
MarkdownOf(const std::vector<Claim> & claims, const std::vector<ExperimentResult> & all)
{
  const auto cell = [&all](std::string text) {
    text = FillIn(text, all);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return std::string(Trim(text));
  };
  std::string text = "## Claims\n\n| the paper says | measured here | verdict |\n|---|---|---|\n";
  for (const Claim & claim : claims)
  {
    text += "| " + cell(claim.claim) + " | " + cell(claim.measured) + " | " + cell(claim.verdict) + " |\n";
  }
  return text;
}

std::string
FiguresAsCsv(const std::vector<ExperimentResult> & all)
{
  std::set<std::string> names;
  for (const ExperimentResult & result : all)
  {
    for (const Figures & figures : result.rows)
    {
      std::transform(
        figures.begin(), figures.end(), std::inserter(names, names.end()), [](const auto & f) { return f.first; });
    }
  }
  names.erase("seconds");
  std::string text = "experiment,row,lattice,method";
  for (const std::string & name : names)
  {
    text += "," + name;
  }
  for (const ExperimentResult & result : all)
  {
    for (std::size_t row = 0; row < result.rows.size(); ++row)
    {
      text += "\n" + result.experiment.name + "," + std::to_string(row + 1) + "," +
              GetComparedMethod(result.experiment.rows[row].method).lattice + ",\"" + LabelOf(result, row) + "\"";
      for (const std::string & name : names)
      {
        const auto found = result.rows[row].find(name);
        text += "," + (found == result.rows[row].end() ? "" : FormatExact(found->second));
      }
    }
  }
  return text + "\n";
}

std::string
TimesAsCsv(const std::vector<ExperimentResult> & all)
{
  std::string text = "experiment,row,method,milliseconds,ratio";
  for (const ExperimentResult & result : all)
  {
    for (std::size_t row = 0; row < result.rows.size(); ++row)
    {
      const double seconds = result.rows[row].at("seconds");
      text += "\n" + result.experiment.name + "," + std::to_string(row + 1) + ",\"" + LabelOf(result, row) + "\"," +
              FormatNumber(1000.0 * seconds, 4) + "," + FormatNumber(seconds / result.rows[0].at("seconds"), 3);
    }
  }
  return text + "\n";
}

std::string
FiguresAsJson(const std::vector<ExperimentResult> & all)
{
  nlohmann::ordered_json report;
  for (const ExperimentResult & result : all)
  {
    nlohmann::ordered_json rows;
    for (std::size_t row = 0; row < result.rows.size(); ++row)
    {
      const ComparedRow & request = result.experiment.rows[row];
      rows.push_back({ { "method", request.method },
                       { "lattice", GetComparedMethod(request.method).lattice },
                       { "resampled", request.isResampled },
                       { "figures", result.rows[row] },
                       { "printed", request.printed } });
    }
    report["experiments"].push_back({ { "name", result.experiment.name },
                                      { "title", result.experiment.title },
                                      { "spacing", result.spacing },
                                      { "seeds", result.experiment.seeds },
                                      { "truth", result.truth },
                                      { "rows", rows } });
  }
  return report.dump(2) + "\n";
}

} // namespace rhombic
