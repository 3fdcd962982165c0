#include "rhombicBatchResults.h"

#include "rhombicIndexPage.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace rhombic
{
namespace
{

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
  const std::string body =
    "<h1>" + Count(cases.size(), "case") + "</h1>\n<p><a href=\"results.tsv\">results.tsv</a> " +
    "<a href=\"results.json\">results.json</a> <a href=\"measures.tsv\">measures.tsv</a> " +
    "<a href=\"outputs.tsv\">outputs.tsv</a></p>\n<form>" + box("done", "done") + box("failed", "failed") +
    box("not run", "not") +
    "<input type=\"search\" name=\"text\" placeholder=\"words\" aria-label=\"words\"> <output></output></form>\n"
    "<table>\n<thead><tr><th></th><th>case</th><th>status</th><th>volumes</th><th>outputs</th>"
    "<th class=\"number\">seconds</th><th class=\"number\">peak MiB</th></tr></thead>\n<tbody>\n" +
    rows + "</tbody>\n</table>\n";
  const std::string place = "<!-- cases -->\n";
  std::string page = IndexPage;
  return page.replace(page.find(place), place.size(), body);
}

} // namespace rhombic
