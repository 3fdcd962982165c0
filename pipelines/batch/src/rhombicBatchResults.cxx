#include "rhombicBatchResults.h"

#include "rhombicBatchAgreement.h"
#include "rhombicIndexPage.h"
#include "rhombicMeasureTable.h"
#include "rhombicSidecar.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** A value as a field of a table; empty without a value. */
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
  DescribeColumn("kind", "", "page, picture, mesh, volume, agreement, report, table, dicom or thumbnail.", columns);
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
  std::string table = "case\tscan\tlabels\treference\toptions\n";
  for (const BatchCase & batchCase : cases)
  {
    std::string options;
    for (const std::string & option : batchCase.options)
    {
      options += (options.empty() ? "" : " ") + option;
    }
    table += ToLine(
      { batchCase.name, batchCase.scan.string(), batchCase.labels.string(), batchCase.reference.string(), options });
  }
  return table;
}

std::string
Escape(const std::string & text)
{
  static const std::map<char, std::string> entities{
    { '&', "&amp;" }, { '<', "&lt;" }, { '>', "&gt;" }, { '"', "&quot;" }
  };
  std::string escaped;
  for (const char letter : text)
  {
    const auto entity = entities.find(letter);
    escaped += entity != entities.end() ? entity->second : std::string(1, letter);
  }
  return escaped;
}

/** A relative link, with escapes for characters of names that links give a meaning. */
std::string
LinkTo(const std::string & folder, const std::string & file)
{
  std::string link;
  for (const unsigned char letter : "./" + folder + "/" + file)
  {
    constexpr char digits[] = "0123456789ABCDEF";
    const bool isPlain = std::isalnum(letter) != 0 || letter == '/' || letter == '.' || letter == '_' || letter == '-';
    link += isPlain ? std::string(1, static_cast<char>(letter))
                    : std::string{ '%', digits[letter >> 4], digits[letter & 15] };
  }
  return link;
}

/** The surfaces and their volumes; of several with one name, the first. */
std::string
DescribeVolumes(const Report & record)
{
  std::string text;
  std::vector<std::string> names;
  for (const Report & surface : record.value("measures", Report::array()))
  {
    const auto name = surface.value("surface", std::string());
    if (surface.value("volume_ml", Report()).is_number() && std::count(names.begin(), names.end(), name) == 0)
    {
      names.push_back(name);
      text += (text.empty() ? "" : "<br>") + Escape(name) + " " + DescribeVolume(surface["volume_ml"].get<double>());
    }
  }
  return text;
}

std::string
DescribeAgreementOf(const Report & record)
{
  std::string text;
  for (const std::string & sentence : SummarizeAgreementOf(record))
  {
    text += (text.empty() ? "" : "<br>") + Escape(sentence);
  }
  return text;
}

/** \param hasAgreement whether the page has a column for it */
std::string
MakeRow(const Report & record, bool hasAgreement)
{
  const auto name = record.value("case", std::string());
  const auto folder = record.value("folder", std::string());
  const auto status = record.value("status", std::string());
  const std::string word = status.substr(0, status.find(' '));
  std::string picture;
  std::string links;
  std::string page; // that the picture leads to
  for (const Report & output : record.value("outputs", Report::array()))
  {
    const auto file = output.value("name", std::string());
    const std::string link = "<a href=\"" + LinkTo(folder, file) + "\">";
    const std::string extension = fs::path(file).extension().string();
    if (file == ThumbnailFile)
    {
      picture = "<img loading=\"lazy\" alt=\"" + Escape(name) + "\" src=\"" + LinkTo(folder, file) + "\">";
    }
    else if (extension != ".json")
    {
      links += (links.empty() ? "" : "<br>") + link + Escape(file) + "</a>";
      page = page.empty() && extension == ".html" ? link : page;
    }
  }
  picture = page.empty() || picture.empty() ? picture : page + picture + "</a>";
  const std::string failed = ListOf(record, "failedOutputs");
  const std::string notMade = failed.empty() ? "" : " Not made: " + failed;
  return "<tr data-status=\"" + word + "\"><td>" + picture + "</td><td>" +
         (!links.empty() ? "<a href=\"" + LinkTo(folder, CaseFile) + "\">" + Escape(name) + "</a>" : Escape(name)) +
         "</td><td><b class=\"" + word + "\">" + status + "</b><br>" +
         Escape(record.value("cause", std::string()) + notMade) + "</td><td><div>" + DescribeVolumes(record) +
         "</div></td>" + (hasAgreement ? "<td>" + DescribeAgreementOf(record) + "</td>" : "") + "<td>" + links +
         "</td><td class=\"number\">" + FormatFixed(record.value("seconds", 0.0), 1) + "</td><td class=\"number\">" +
         FormatFixed(record.value("peakMemory", 0.0) / (1u << 20), 0) + "</td></tr>\n";
}

/** The page of WriteResults(): a table of all cases with thumbnails and links, which a script on the page filters.
 * Cases that agree least with their references come first. It needs nothing beside the folder. */
std::string
MakeIndexPage(const std::vector<Report> & cases)
{
  std::map<std::string, std::size_t> counts;
  std::string rows;
  const bool hasAgreement = HasAgreement(cases);
  for (const Report & record : WorstFirst(cases))
  {
    ++counts[record.value("status", std::string())];
    rows += MakeRow(record, hasAgreement);
  }
  const auto box = [&counts](const std::string & status, const std::string & name) {
    return "<label><input type=\"checkbox\" name=\"" + name + "\" checked> " + status + " (" +
           std::to_string(counts[status]) + ")</label>";
  };
  const std::string body =
    "<h1>" + Count(cases.size(), "case") + "</h1>\n<p><a href=\"results.tsv\">results.tsv</a> " +
    "<a href=\"results.json\">results.json</a> <a href=\"measures.tsv\">measures.tsv</a> " +
    "<a href=\"outputs.tsv\">outputs.tsv</a>" +
    (hasAgreement ? " <a href=\"agreement.tsv\">agreement.tsv</a> "
                    "<a href=\"agreement-statistics.tsv\">agreement-statistics.tsv</a>"
                  : "") +
    "</p>\n<form>" + box("done", "done") + box("failed", "failed") + box("not run", "not") +
    "<input type=\"search\" name=\"text\" placeholder=\"words\" aria-label=\"words\"> <output></output></form>\n"
    "<table>\n<thead><tr><th></th><th>case</th><th>status</th><th>volumes</th>" +
    (hasAgreement ? "<th>agreement</th>" : "") +
    "<th>outputs</th>"
    "<th class=\"number\">seconds</th><th class=\"number\">peak MiB</th></tr></thead>\n<tbody>\n" +
    rows + "</tbody>\n</table>\n";
  const std::string place = "<!-- cases -->\n";
  std::string page = IndexPage;
  return page.replace(page.find(place), place.size(), body);
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
  const bool hasAgreement = HasAgreement(cases);
  if (hasAgreement)
  {
    StageText(MakeAgreementTable(cases), folder / "agreement.tsv", staged);
    StageText(MakeAgreementStatistics(cases), folder / "agreement-statistics.tsv", staged);
  }
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
  if (!hasAgreement)
  {
    fs::remove(folder / "agreement.tsv");
    fs::remove(folder / "agreement-statistics.tsv");
  }
}

} // namespace rhombic
