#include "rhombicBatchResults.h"

#include "rhombicMeasureTable.h"
#include "rhombicSidecar.h"
#include "rhombicWording.h"

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** A value as a field of a table; empty without one. */
std::string
FieldOf(const Report & record, const std::string & key)
{
  return record.contains(key) ? ToField(record[key]) : "";
}

std::string
MakeResultTable(const std::vector<Report> & cases)
{
  std::string table = "case\tstatus\tcode\tseconds\tpeak_MiB\tsteps\toutputs\tcause\tfailed_outputs\n";
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
    table += ToLine({ FieldOf(record, "case"),
                      FieldOf(record, "status"),
                      FieldOf(record, "code"),
                      FormatFixed(record.value("seconds", 0.0), 1),
                      FormatFixed(record.value("peakMemory", 0.0) / (1u << 20), 0),
                      steps,
                      outputs,
                      FieldOf(record, "cause"),
                      ListOf(record, "failedOutputs") });
  }
  return table;
}

constexpr char caseDescription[] = "The case's name.";

/** A line for each surface of each case. */
std::string
MakeMeasureTable(const std::vector<Report> & cases)
{
  std::vector<std::string> heads{ "case" };
  for (const MeasureColumn & column : GetMeasureColumns())
  {
    heads.push_back(column.name);
  }
  std::string table = ToLine(heads);
  for (const Report & record : cases)
  {
    for (const Report & surface : record.value("measures", Report::array()))
    {
      std::vector<std::string> fields{ FieldOf(record, "case") };
      for (const MeasureColumn & column : GetMeasureColumns())
      {
        fields.push_back(ToField(surface.value(column.name, Report())));
      }
      table += ToLine(fields);
    }
  }
  return table;
}

/** A line for each file of each case. */
std::string
MakeOutputTable(const std::vector<Report> & cases)
{
  std::string table = "case\tfile\tkind\toutput\tsize_bytes\tmd5\tsurface_ids\n";
  for (const Report & record : cases)
  {
    for (const Report & output : record.value("outputs", Report::array()))
    {
      const std::string surfaces = ListOf(output, "surfaces");
      table += ToLine({ FieldOf(record, "case"),
                        FieldOf(record, "folder") + '/' + FieldOf(output, "name"),
                        FieldOf(output, "kind"),
                        FieldOf(output, "output"),
                        FieldOf(output, "bytes"),
                        FieldOf(output, "md5"),
                        surfaces.empty() ? "n/a" : surfaces });
    }
  }
  return table;
}

Report
DescribeOutputTable()
{
  Report columns;
  DescribeColumn("case", "", caseDescription, columns);
  DescribeColumn("file", "", "The file's path below the folder of this table.", columns);
  DescribeColumn("kind", "", "page, picture, mesh, volume, report, table, dicom or thumbnail.", columns);
  DescribeColumn("output", "", "The name of the output in the pipeline, which may be one for several files.", columns);
  DescribeColumn("size_bytes", "byte", "The file's size.", columns);
  DescribeColumn("md5", "", "The MD5 of the file's content.", columns);
  DescribeColumn("surface_ids",
                 "",
                 "The surfaces that the file holds or shows: surface_id in measures.tsv, with a comma between them.",
                 columns);
  return columns;
}

std::string
MakeManifest(const std::vector<BatchCase> & cases)
{
  std::string table = "case\tscan\tlabels\toptions\n";
  for (const BatchCase & batchCase : cases)
  {
    std::string options;
    for (const std::string & option : batchCase.options)
    {
      options += (options.empty() ? "" : " ") + option;
    }
    table += ToLine({ batchCase.name, batchCase.scan.string(), batchCase.labels.string(), options });
  }
  return table;
}

} // namespace

std::string
ListOf(const Report & record, const std::string & key)
{
  std::string list;
  for (const Report & text : record.value(key, Report::array()))
  {
    list += (list.empty() ? "" : ",") + ToField(text);
  }
  return list;
}

std::string
ToLine(const std::vector<std::string> & fields)
{
  std::string line;
  for (const std::string & field : fields)
  {
    line += (&field == &fields.front() ? "" : "\t") + field;
  }
  return line + '\n';
}

void
WriteResults(const std::vector<Report> & cases, const std::vector<BatchCase> * manifest, const fs::path & folder)
{
  Report measureColumns;
  DescribeColumn("case", "", caseDescription, measureColumns);
  measureColumns.update(DescribeMeasures());
  StagedFiles staged;
  StageText(MakeResultTable(cases), folder / "results.tsv", staged);
  StageText(ToJson(cases) + '\n', folder / "results.json", staged);
  StageText(MakeMeasureTable(cases), folder / "measures.tsv", staged);
  StageText(ToJson(measureColumns) + '\n', folder / "measures.json", staged);
  StageText(MakeOutputTable(cases), folder / "outputs.tsv", staged);
  StageText(ToJson(DescribeOutputTable()) + '\n', folder / "outputs.json", staged);
  StageText(MakeIndexPage(cases), folder / "index.html", staged);
  const fs::path casesTable = folder / "cases.tsv";
  if (manifest != nullptr)
  {
    StageText(MakeManifest(*manifest), casesTable, staged, fs::perms::owner_read | fs::perms::owner_write);
  }
  staged.Commit();
  if (manifest == nullptr)
  {
    fs::remove(casesTable);
  }
}

} // namespace rhombic
