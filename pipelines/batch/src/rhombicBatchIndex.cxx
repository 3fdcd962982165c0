#include "rhombicBatchResults.h"

#include "rhombicWording.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace rhombic
{
namespace
{

constexpr char head[] = R"html(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Rhombic: results of a batch</title>
<style>
body { font: 15px/1.4 sans-serif; margin: 1.5em; color: #222; background: #fff; }
h1 { font-size: 1.3em; }
form { position: sticky; top: 0; background: #fff; padding: .6em 0; border-bottom: 1px solid #ccc; }
label { margin-right: 1em; }
table { border-collapse: collapse; width: 100%; }
td, th { text-align: left; vertical-align: top; padding: .5em .8em .5em 0; border-bottom: 1px solid #ddd; }
td { overflow-wrap: anywhere; }
td div { max-height: 150px; min-width: 12em; overflow: auto; }
td.number, th.number { text-align: right; }
img { height: 150px; display: block; }
.done { color: #17692b; } .failed { color: #a01818; } .not { color: #666; }
[hidden] { display: none; }
small { color: #555; }
</style>
</head>
<body>
)html";

constexpr char script[] = R"html(<script>
const form = document.querySelector('form'), rows = [...document.querySelectorAll('tbody tr')];
function filter() {
  const words = form.text.value.toLowerCase().split(/\s+/);
  let shown = 0;
  for (const row of rows) {
    const text = row.textContent.toLowerCase();
    row.hidden = !form[row.dataset.status].checked || !words.every(word => text.includes(word));
    shown += !row.hidden;
  }
  document.querySelector('output').textContent = shown + ' of ' + rows.length + ' shown';
}
form.addEventListener('input', filter);
form.addEventListener('submit', event => event.preventDefault());
filter();
</script>
</body>
</html>
)html";

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

/** A relative link. Names of files may have characters that mean something in one. */
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
    if (surface.contains("volume_ml") && std::count(names.begin(), names.end(), name) == 0)
    {
      names.push_back(name);
      text += (text.empty() ? "" : "<br>") + Escape(name) + " " + FormatMillilitres(surface["volume_ml"].get<double>());
    }
  }
  return text;
}

std::string
MakeRow(const Report & record)
{
  const auto name = record.value("case", std::string());
  const auto folder = record.value("folder", std::string());
  const auto status = record.value("status", std::string());
  const std::string word = status.substr(0, status.find(' '));
  std::string picture;
  std::string links;
  for (const Report & output : record.value("outputs", Report::array()))
  {
    const auto file = output.value("name", std::string());
    if (file == ThumbnailFile)
    {
      picture = "<img loading=\"lazy\" alt=\"\" src=\"" + LinkTo(folder, file) + "\">";
    }
    else if (file.size() < 5 || file.substr(file.size() - 5) != ".json")
    {
      links += (links.empty() ? "" : "<br>") + ("<a href=\"" + LinkTo(folder, file) + "\">") + Escape(file) + "</a>";
    }
  }
  const std::string failed = ListOf(record, "failedOutputs");
  const std::string notMade = failed.empty() ? "" : " Not made: " + failed;
  return "<tr data-status=\"" + word + "\"><td>" + picture + "</td><td>" +
         (!links.empty() ? "<a href=\"" + LinkTo(folder, CaseFile) + "\">" + Escape(name) + "</a>" : Escape(name)) +
         "</td><td><b class=\"" + word + "\">" + status + "</b><br>" +
         Escape(record.value("cause", std::string()) + notMade) + "</td><td><div>" + DescribeVolumes(record) +
         "</div></td><td>" + links + "</td><td class=\"number\">" + FormatFixed(record.value("seconds", 0.0), 1) +
         "</td><td class=\"number\">" + FormatFixed(record.value("peakMemory", 0.0) / (1u << 20), 0) + "</td></tr>\n";
}

} // namespace

std::string
MakeIndexPage(const std::vector<Report> & cases)
{
  std::map<std::string, std::size_t> counts;
  std::string rows;
  for (const Report & record : cases)
  {
    ++counts[record.value("status", std::string())];
    rows += MakeRow(record);
  }
  const auto box = [&counts](const std::string & status, const std::string & name) {
    return "<label><input type=\"checkbox\" name=\"" + name + "\" checked> " + status + " (" +
           std::to_string(counts[status]) + ")</label>";
  };
  return head +
         ("<h1>" + Count(cases.size(), "case") + "</h1>\n<p><a href=\"results.tsv\">results.tsv</a> " +
          "<a href=\"results.json\">results.json</a> <a href=\"measures.tsv\">measures.tsv</a> " +
          "<a href=\"outputs.tsv\">outputs.tsv</a></p>\n<form>") +
         box("done", "done") + box("failed", "failed") + box("not run", "not") +
         "<input type=\"search\" name=\"text\" placeholder=\"words\" aria-label=\"words\"> <output></output></form>\n"
         "<table>\n<thead><tr><th></th><th>case</th><th>status</th><th>volumes</th><th>outputs</th>"
         "<th class=\"number\">seconds</th><th class=\"number\">peak MiB</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody>\n</table>\n" + script;
}

} // namespace rhombic
