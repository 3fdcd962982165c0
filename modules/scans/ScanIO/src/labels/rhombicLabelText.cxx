#include "rhombicLabelTableFormats.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rhombic
{
namespace
{

constexpr std::size_t MostLines = 100'000;

} // namespace

void
RefuseTable(const TablePlace & place, const std::string & why)
{
  const std::string line = place.line == 0 ? "" : ", line " + std::to_string(place.line);
  throw Failure(FailureKind::Unreadable, "Cannot read " + place.source + line + ": " + why + ".");
}

std::string
Quoted(std::string_view text)
{
  constexpr std::size_t longest = 40;
  std::string shown(text.substr(0, longest));
  std::replace_if(
    shown.begin(), shown.end(), [](char letter) { return letter < ' ' || letter > '~'; }, '?');
  return "\"" + shown + (text.size() > longest ? "..." : "") + "\"";
}

std::vector<TextLine>
LinesOfTable(std::string_view text, const std::string & source)
{
  std::vector<TextLine> lines;
  for (std::size_t number = 1; !text.empty(); ++number)
  {
    if (number > MostLines)
    {
      RefuseTable({ source }, "it has more than 100,000 lines, too many for a label table; check that it is one");
    }
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = Trim(text.substr(0, end));
    if (!line.empty() && line.front() != '#')
    {
      lines.push_back({ line, number });
    }
    const bool isPair = text.substr(end, 2) == "\r\n";
    text.remove_prefix(std::min(end + (isPair ? 2 : 1), text.size()));
  }
  return lines;
}

std::vector<std::string>
FieldsOf(std::string_view line, char separator, const TablePlace & place)
{
  std::vector<std::string> fields(1);
  bool isInQuotes = false;
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    const char letter = line[i];
    const bool isDoubled = isInQuotes && letter == '"' && i + 1 < line.size() && line[i + 1] == '"';
    if (letter == '"' && !isDoubled)
    {
      isInQuotes = !isInQuotes;
    }
    else if (letter == separator && !isInQuotes)
    {
      fields.emplace_back();
    }
    else
    {
      fields.back() += letter;
      i += isDoubled ? 1 : 0;
    }
  }
  if (isInQuotes)
  {
    RefuseTable(place, "a quoted text does not end in this line; close the quotes");
  }
  for (std::string & field : fields)
  {
    field = Trim(field);
  }
  return fields;
}

std::int32_t
WholeNumber(std::string_view text,
            std::int32_t lowest,
            std::int32_t highest,
            const char * what,
            const TablePlace & place)
{
  const auto number = ToNumber<std::int32_t>(text);
  if (!number || *number < lowest || *number > highest)
  {
    RefuseTable(place,
                std::string(what) + " is " + Quoted(text) + ", which is no whole number from " +
                  std::to_string(lowest) + " to " + std::to_string(highest) + "; correct it");
  }
  return *number;
}

double
RealNumber(std::string_view text, double lowest, double highest, const char * what, const TablePlace & place)
{
  const auto number = ToNumber<double>(text);
  if (!number || !(*number >= lowest && *number <= highest))
  {
    RefuseTable(place,
                std::string(what) + " is " + Quoted(text) + ", which is no number from " + FormatNumber(lowest) +
                  " to " + FormatNumber(highest) + "; correct it");
  }
  return *number;
}

std::int32_t
LabelValue(std::string_view text, const TablePlace & place)
{
  using Limits = std::numeric_limits<std::int32_t>;
  return WholeNumber(text, Limits::min(), Limits::max(), "the label's value", place);
}

std::array<std::uint8_t, 3>
ByteColour(std::string_view red, std::string_view green, std::string_view blue, const TablePlace & place)
{
  return { static_cast<std::uint8_t>(WholeNumber(red, 0, 255, "red", place)),
           static_cast<std::uint8_t>(WholeNumber(green, 0, 255, "green", place)),
           static_cast<std::uint8_t>(WholeNumber(blue, 0, 255, "blue", place)) };
}

std::array<std::uint8_t, 3>
UnitColour(std::string_view red, std::string_view green, std::string_view blue, const TablePlace & place)
{
  const auto component = [&place](std::string_view text, const char * what) {
    return static_cast<std::uint8_t>(std::lround(255 * RealNumber(text, 0, 1, what, place)));
  };
  return { component(red, "red"), component(green, "green"), component(blue, "blue") };
}

void
LabelCollector::Add(Label label, const TablePlace & place)
{
  const std::int32_t value = label.value;
  const auto [entry, isNew] = m_Entries.insert({ value, { std::move(label), place.line } });
  if (!isNew)
  {
    const std::string first = entry->second.line == 0 ? "" : ", first in line " + std::to_string(entry->second.line);
    RefuseTable(place, "value " + std::to_string(value) + " is given twice" + first + "; remove one of them");
  }
}

LabelTable
LabelCollector::Take()
{
  LabelTable table;
  table.reserve(m_Entries.size());
  for (auto & [value, entry] : m_Entries)
  {
    table.push_back(std::move(entry.label));
  }
  return table;
}

} // namespace rhombic
