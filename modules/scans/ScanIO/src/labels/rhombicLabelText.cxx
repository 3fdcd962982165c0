#include "rhombicLabelTableFormats.h"

#include "rhombicColour.h"
#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <algorithm>
#include <limits>

namespace rhombic
{
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
UnitColour(std::string_view red, std::string_view green, std::string_view blue, const TablePlace & place)
{
  return ToBytes({ RealNumber(red, 0, 1, "red", place),
                   RealNumber(green, 0, 1, "green", place),
                   RealNumber(blue, 0, 1, "blue", place) });
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
