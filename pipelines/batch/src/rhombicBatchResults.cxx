#include "rhombicBatchResults.h"

#include "rhombicSidecar.h"
#include "rhombicWording.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** A value as a field of a table. */
std::string
FieldOf(const Report & record, const std::string & key)
{
  if (!record.contains(key))
  {
    return "";
  }
  const Report & value = record[key];
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  std::replace_if(
    text.begin(), text.end(), [](unsigned char letter) { return letter < ' '; }, ' ');
  return text;
}

std::string
MakeResultTable(const std::vector<Report> & cases)
{
  std::string table = "case\tstatus\tcode\tseconds\tpeak_MiB\tsteps\toutputs\tcause\n";
  for (const Report & record : cases)
  {
    std::string steps;
    std::string outputs;
    for (const Report & step : record.value("steps", Report::array()))
    {
      steps +=
        (steps.empty() ? "" : " ") + FieldOf(step, "output") + "=" + FormatFixed(step.value("seconds", 0.0), 1) + "s";
    }
    for (const Report & output : record.value("outputs", Report::array()))
    {
      outputs += (outputs.empty() ? "" : " ") + FieldOf(output, "name");
    }
    const double peak = record.value("peakMemory", 0.0) / (1u << 20);
    table += FieldOf(record, "case") + '\t' + FieldOf(record, "status") + '\t' + FieldOf(record, "code") + '\t' +
             FormatFixed(record.value("seconds", 0.0), 1) + '\t' + FormatFixed(peak, 0) + '\t' + steps + '\t' +
             outputs + '\t' + FieldOf(record, "cause") + '\n';
  }
  return table;
}

/** A line for each surface of each output; the columns are all that any of them has. */
std::string
MakeMeasureTable(const std::vector<Report> & cases)
{
  std::vector<std::string> columns;
  for (const Report & record : cases)
  {
    for (const Report & surface : record.value("surfaces", Report::array()))
    {
      for (const auto & [key, value] : surface.items())
      {
        if (std::find(columns.begin(), columns.end(), key) == columns.end())
        {
          columns.push_back(key);
        }
      }
    }
  }
  std::string table = "case";
  for (const std::string & column : columns)
  {
    table += '\t' + column;
  }
  table += '\n';
  for (const Report & record : cases)
  {
    for (const Report & surface : record.value("surfaces", Report::array()))
    {
      table += FieldOf(record, "case");
      for (const std::string & column : columns)
      {
        table += '\t' + FieldOf(surface, column);
      }
      table += '\n';
    }
  }
  return table;
}

} // namespace

void
WriteResults(const std::vector<Report> & cases, const fs::path & folder)
{
  StagedFiles staged;
  StageText(MakeResultTable(cases), folder / "results.tsv", staged);
  StageText(ToJson(cases) + '\n', folder / "results.json", staged);
  StageText(MakeMeasureTable(cases), folder / "measures.tsv", staged);
  StageText(MakeIndexPage(cases), folder / "index.html", staged);
  staged.Commit();
}

} // namespace rhombic
