#include "rhombicAnatomicalColours.h"
#include "rhombicLabelTableFormats.h"
#include "rhombicWording.h"

#include <limits>
#include <set>

namespace rhombic
{
namespace
{

constexpr std::string_view Prefix = "Segment";
using KeyValues = std::map<std::string, std::string>;

/** The numbers of segments, as text, from keys like Segment12_Name. */
std::set<std::string>
SegmentNumbers(const KeyValues & keyValues)
{
  std::set<std::string> numbers;
  for (auto pair = keyValues.lower_bound(std::string(Prefix)); pair != keyValues.end(); ++pair)
  {
    const std::string & key = pair->first;
    if (key.compare(0, Prefix.size(), Prefix) != 0)
    {
      break;
    }
    const std::size_t end = key.find_first_not_of("0123456789", Prefix.size());
    const std::string ending = end == std::string::npos ? "" : key.substr(end);
    if (end > Prefix.size() && (ending == "_ID" || ending == "_Name" || ending == "_LabelValue"))
    {
      numbers.insert(key.substr(Prefix.size(), end - Prefix.size()));
    }
  }
  return numbers;
}

} // namespace

bool
HasSegments(const KeyValues & keyValues)
{
  return !SegmentNumbers(keyValues).empty();
}

LabelTable
LabelsOfSegments(const KeyValues & keyValues, const std::string & source, int layer)
{
  LabelCollector collector;
  for (const std::string & number : SegmentNumbers(keyValues))
  {
    const std::string segment = std::string(Prefix) + number;
    const std::string name = source + ", " + segment;
    const TablePlace place{ name };
    const auto get = [&keyValues, &segment](const char * field) {
      const auto found = keyValues.find(segment + field);
      return found == keyValues.end() ? std::string() : std::string(Trim(found->second));
    };

    // Before 3D Slicer 4.11 every segment was in a layer of its own.
    const bool isOld = get("_LabelValue").empty() && get("_Layer").empty();
    const std::string layerText = isOld ? number : get("_Layer").empty() ? "0" : get("_Layer");
    if (WholeNumber(layerText, 0, std::numeric_limits<std::int32_t>::max(), "its layer", place) != layer)
    {
      continue;
    }
    Label label;
    label.value = isOld ? 1 : LabelValue(get("_LabelValue"), place);
    label.name = SanitizeLabelName(get("_Name"), label.value);
    const std::string colourText = get("_Color");
    const std::vector<std::string_view> colour = SplitWords(colourText);
    if (colour.size() != 3 && !colour.empty())
    {
      RefuseTable(place, "its colour is " + Quoted(colourText) + ", not three numbers from 0 to 1; correct it");
    }
    label.colour =
      colour.empty() ? AnatomicalColour(label.name, label.value) : UnitColour(colour[0], colour[1], colour[2], place);
    collector.Add(std::move(label), place);
  }
  return collector.Take();
}

} // namespace rhombic
