#include "rhombicLabelTableFormats.h"

#include "rhombicFiles.h"
#include "rhombicWording.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>
#include <utility>

namespace rhombic
{
namespace
{

/** A line of a label table. */
struct TextLine
{
  std::string_view text;  ///< without blanks at its ends
  std::size_t number = 0; ///< from 1
};

/** The lines of a text that are neither blank nor begin with '#'. Throws for more than 100,000 lines.
 * \param isOfTabs whether a tab at the beginning of a line ends an empty field: then it stays */
std::vector<TextLine>
LinesOfTable(std::string_view text, const std::string & source, bool isOfTabs)
{
  constexpr std::size_t mostLines = 100'000;
  std::vector<TextLine> lines;
  for (std::size_t number = 1; !text.empty(); ++number)
  {
    if (number > mostLines)
    {
      RefuseTable({ source }, "it has more than 100,000 lines, too many for a label table; check that it is one");
    }
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    std::string_view line = Trim(text.substr(0, end));
    const std::size_t tab = text.find_first_not_of(' ');
    if (isOfTabs && !line.empty() && text[tab] == '\t')
    {
      line = text.substr(tab, static_cast<std::size_t>(line.data() + line.size() - text.data()) - tab);
    }
    if (!line.empty() && line.front() != '#')
    {
      lines.push_back({ line, number });
    }
    const bool isPair = text.substr(end, 2) == "\r\n";
    text.remove_prefix(std::min(end + (isPair ? 2 : 1), text.size()));
  }
  return lines;
}

/** The fields of a line between separators, trimmed. Fields in double quotes may hold separators and doubled quotes.
 * Throws when a quote is not closed. */
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

/** A colour from red, green and blue from 0 to 255. */
std::array<std::uint8_t, 3>
ByteColour(std::string_view red, std::string_view green, std::string_view blue, const TablePlace & place)
{
  return { static_cast<std::uint8_t>(WholeNumber(red, 0, 255, "red", place)),
           static_cast<std::uint8_t>(WholeNumber(green, 0, 255, "green", place)),
           static_cast<std::uint8_t>(WholeNumber(blue, 0, 255, "blue", place)) };
}

/** The table of the labels that \a parseRow returns for each line. */
template <typename TParseRow>
LabelTable
CollectRows(const std::vector<TextLine> & lines, const std::string & source, const TParseRow & parseRow)
{
  LabelCollector collector;
  for (const TextLine & line : lines)
  {
    const TablePlace place{ source, line.number };
    collector.Add(parseRow(line.text, place), place);
  }
  return collector.Take();
}

std::string_view
WithoutQuotes(std::string_view text)
{
  const bool isQuoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return isQuoted ? text.substr(1, text.size() - 2) : text;
}

std::array<std::uint8_t, 3>
HexColour(std::string_view text, const TablePlace & place)
{
  unsigned int number = 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), number, 16);
  if (text.size() != 7 || text[0] != '#' || error != std::errc() || end != text.data() + text.size())
  {
    RefuseTable(place, "its colour is " + Quoted(text) + ", not like #1a2b3c; correct it");
  }
  return { static_cast<std::uint8_t>(number >> 16),
           static_cast<std::uint8_t>(number >> 8),
           static_cast<std::uint8_t>(number) };
}

bool
IsNumber(std::string_view word)
{
  return !word.empty() && word.find_first_not_of("0123456789.-") == std::string_view::npos;
}

bool
LooksLikeITKSNAPRow(std::string_view line)
{
  const std::vector<std::string_view> words = SplitWords(line);
  return words.size() >= 8 && std::all_of(words.begin(), words.begin() + 7, IsNumber) && words[7].front() == '"';
}

bool
LooksLikeNamedRow(std::string_view line)
{
  const std::vector<std::string_view> words = SplitWords(line);
  return words.size() >= 6 && IsNumber(words[0]) && !IsNumber(words[1]) &&
         std::all_of(words.end() - 4, words.end(), IsNumber);
}

/** Whether every label would be invisible if the last number were the opacity. */
bool
IsAlphaAlwaysZero(const std::vector<TextLine> & lines)
{
  return std::all_of(
    lines.begin(), lines.end(), [](const TextLine & line) { return SplitWords(line.text).back() == "0"; });
}

/** The separator of a header's columns, their names in lower case, and that of the column of values. */
struct LabelColumns
{
  char separator;
  std::vector<std::string> names;
  std::string value;
};

/** Nothing for a line that does not name columns of values and names. */
std::optional<LabelColumns>
FindLabelColumns(std::string_view header)
{
  const std::string lower = LowerCase(header);
  if (std::count(lower.begin(), lower.end(), '"') % 2 != 0)
  {
    return std::nullopt;
  }
  for (const char separator : { ',', ';', '\t' })
  {
    const std::vector<std::string> names = FieldsOf(lower, separator, { lower });
    for (const char * const value : { "labelvalue", "index", "label", "value" })
    {
      if (std::count(names.begin(), names.end(), value) > 0 && std::count(names.begin(), names.end(), "name") > 0)
      {
        return LabelColumns{ separator, names, value };
      }
    }
  }
  return std::nullopt;
}

/** The value of "labels" in a dataset.json; null if there is none. */
nlohmann::json
LabelsOfDataset(std::string_view json)
{
  const auto dataset = nlohmann::json::parse(json.begin(), json.end(), nullptr, false);
  return dataset.is_object() ? dataset.value("labels", nlohmann::json()) : nlohmann::json();
}

/** Whether a name in a dataset.json is that of several values. */
bool
IsRegion(const nlohmann::json & value)
{
  return value.is_array() && value.size() > 1;
}

/** Whether a line is a whole number and a name, not a row of numbers. */
bool
LooksLikeValueAndName(const TextLine & line)
{
  const std::vector<std::string_view> words = SplitWords(line.text);
  return words.size() >= 2 && ToNumber<std::int32_t>(words[0]) && !IsNumber(words[1]) &&
         (words.size() < 4 || !std::all_of(words.end() - 2, words.end(), IsNumber));
}

/** Parses all lines as rows `IDX R G B A VIS MSH "LABEL"`. A label is visible if VIS and MSH are set. */
LabelTable
ParseITKSNAPTable(const std::vector<TextLine> & lines, const std::string & source)
{
  return CollectRows(lines, source, [](std::string_view line, const TablePlace & place) {
    const std::size_t quote = std::min(line.find('"'), line.size());
    const std::vector<std::string_view> words = SplitWords(line.substr(0, quote));
    const std::string_view name = line.substr(quote);
    if (words.size() != 7 || name.size() < 2 || name.back() != '"')
    {
      RefuseTable(place, "it is not like `1 255 0 0 1 1 1 \"liver\"`; write it like this");
    }
    Label label = NamedLabel(LabelValue(words[0], place), WithoutQuotes(name));
    label.colour = ByteColour(words[1], words[2], words[3], place);
    label.opacity = RealNumber(words[4], 0, 1, "the opacity", place);
    const bool isShown = WholeNumber(words[5], 0, 1, "the visibility", place) == 1;
    const bool isShownAsMesh = WholeNumber(words[6], 0, 1, "the visibility of the mesh", place) == 1;
    label.isVisible = isShown && isShownAsMesh;
    return label;
  });
}

/** Parses all lines as rows `index name r g b a`; the name may have spaces, and a is the opacity from 0 to 255 (3D
 * Slicer), or the transparency (FreeSurfer). */
LabelTable
ParseNamedTable(const std::vector<TextLine> & lines, const std::string & source, bool isTransparency)
{
  return CollectRows(lines, source, [isTransparency](std::string_view line, const TablePlace & place) {
    const std::vector<std::string_view> words = SplitWords(line);
    if (words.size() < 6)
    {
      RefuseTable(place,
                  "it has " + std::to_string(words.size()) +
                    " words, not a value, a name, red, green, blue and alpha; add what is missing");
    }
    const auto * const numbers = &words[words.size() - 4];
    const auto * const nameBegin = words[1].data();
    const auto * const nameEnd = numbers[-1].data() + numbers[-1].size();
    const std::string_view name(nameBegin, static_cast<std::size_t>(nameEnd - nameBegin));

    Label label = NamedLabel(LabelValue(words[0], place), WithoutQuotes(name));
    label.colour = ByteColour(numbers[0], numbers[1], numbers[2], place);
    const double alpha = WholeNumber(numbers[3], 0, 255, "alpha", place) / 255.0;
    label.opacity = isTransparency ? 1 - alpha : alpha;
    label.isVisible = label.opacity > 0;
    return label;
  });
}

/** Parses a header and rows with at least a value (LabelValue, index, label or value) and a name; Color_R, _G and _B,
 * and Color_A (opacity), or color (#rrggbb) may be missing. */
LabelTable
ParseColumnTable(const std::vector<TextLine> & lines, const LabelColumns & columns, const std::string & source)
{
  return CollectRows({ lines.begin() + 1, lines.end() }, source, [&](std::string_view line, const TablePlace & place) {
    const std::vector<std::string> fields = FieldsOf(line, columns.separator, place);
    if (fields.size() > columns.names.size())
    {
      RefuseTable(place,
                  "it has " + std::to_string(fields.size()) + " fields, more than the header's " +
                    std::to_string(columns.names.size()) + "; put texts with separators in double quotes");
    }
    // The table may lack the column, and a row may end early.
    const auto get = [&](const std::string & name) {
      const auto end = columns.names.begin() + static_cast<std::ptrdiff_t>(fields.size());
      const auto column = std::find(columns.names.begin(), end, name);
      return column != end ? fields[static_cast<std::size_t>(column - columns.names.begin())] : "";
    };
    const std::string red = get("color_r");
    const std::string green = get("color_g");
    const std::string blue = get("color_b");
    const std::string alpha = get("color_a");
    const std::string colour = get("color");

    Label label = NamedLabel(LabelValue(get(columns.value), place), get("name"));
    label.colour = !red.empty() || !green.empty() || !blue.empty() ? ByteColour(red, green, blue, place)
                   : !colour.empty() && colour != "n/a"            ? HexColour(colour, place)
                                                                   : label.colour;
    label.opacity = alpha.empty() ? 1 : WholeNumber(alpha, 0, 255, "alpha", place) / 255.0;
    label.isVisible = label.opacity > 0;
    return label;
  });
}

/** Parses all lines as rows `value name`. */
LabelTable
ParseValuesAndNames(const std::vector<TextLine> & lines, const std::string & source)
{
  return CollectRows(lines, source, [](std::string_view line, const TablePlace & place) {
    const std::string_view value = SplitWords(line).front();
    return NamedLabel(LabelValue(value, place), WithoutQuotes(Trim(line.substr(value.size()))));
  });
}

/** Parses the labels of nnU-Net's dataset.json: names with values, or, as before version 2, values with names. Throws
 * for labels that are regions of several values. */
LabelTable
ParseDatasetJSON(const nlohmann::json & labels, const std::string & source)
{
  if (!labels.is_object())
  {
    RefuseTable({ source }, "it has no object \"labels\", as a dataset.json of nnU-Net has; check that it is one");
  }
  LabelCollector collector;
  for (const auto & [key, value] : labels.items())
  {
    const auto & number = value.is_array() && value.size() == 1 ? value.front() : value;
    if (IsRegion(value))
    {
      RefuseTable({ source },
                  "its label " + Quoted(key) +
                    " is a region of several values, and a label map has one value in a voxel; give a label table "
                    "with a name for each value");
    }
    if (number.is_string()) // "1": "liver"
    {
      const auto name = number.get<std::string>();
      const auto [text, what] = ToNumber<std::int32_t>(name) ? std::pair(name, key) : std::pair(key, name);
      collector.Add(NamedLabel(LabelValue(text, { source }), what), { source });
    }
    else if (number.is_number_integer())
    {
      collector.Add(NamedLabel(LabelValue(number.dump(), { source }), key), { source });
    }
    else
    {
      RefuseTable({ source }, "its label " + Quoted(key) + " has no whole number; correct it");
    }
  }
  return collector.Take();
}

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

std::optional<LabelTable>
ParseIfLabelTable(std::string_view text, const std::string & source, TableChoice choice)
{
  if (text.size() > LongestLabelTable)
  {
    return std::nullopt;
  }
  text = WithoutByteOrderMark(text, source);
  const std::vector<TextLine> lines = LinesOfTable(text, source, false);
  if (lines.empty() || text.find('\0') != std::string_view::npos)
  {
    return std::nullopt;
  }
  const bool isNamed = choice == TableChoice::Named;
  const std::string_view first = lines.front().text;
  if (first.front() == '{' && text.find("\"labels\"") != std::string_view::npos)
  {
    const auto labels = LabelsOfDataset(text);
    const bool isSure = labels.is_object() && std::none_of(labels.begin(), labels.end(), IsRegion);
    return isNamed || isSure ? std::make_optional(ParseDatasetJSON(labels, source)) : std::nullopt;
  }
  if (const auto columns = FindLabelColumns(first))
  {
    const bool isSure = columns->value == "labelvalue" || columns->value == "index";
    return isNamed || isSure ? std::make_optional(ParseColumnTable(
                                 LinesOfTable(text, source, columns->separator == '\t'), *columns, source))
                             : std::nullopt;
  }

  constexpr std::size_t longestBeginning = 4096;
  const std::string beginning = LowerCase(text.substr(0, longestBeginning));
  const auto says = [&beginning](const char * words) { return beginning.find(words) != std::string::npos; };
  if (says("itk-snap label description") || LooksLikeITKSNAPRow(first))
  {
    return ParseITKSNAPTable(lines, source);
  }
  if (says("# color procedural file"))
  {
    RefuseTable({ source }, "its colours are those of a scale, not of labels; choose a table of labels");
  }
  const bool isSlicer =
    says("# color table file") || LowerCase(std::filesystem::path(source).extension().string()) == ".ctbl";
  const bool isFreeSurfer = says("#no. label name") || says("# freesurfer");
  if (isSlicer || isFreeSurfer || LooksLikeNamedRow(first))
  {
    return ParseNamedTable(lines, source, !isSlicer && (isFreeSurfer || IsAlphaAlwaysZero(lines)));
  }
  return isNamed && std::all_of(lines.begin(), lines.end(), LooksLikeValueAndName)
           ? std::make_optional(ParseValuesAndNames(lines, source))
           : std::nullopt;
}

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
    Label label = NamedLabel(isOld ? 1 : LabelValue(get("_LabelValue"), place), get("_Name"));
    const std::string colourText = get("_Color");
    const std::vector<std::string_view> colour = SplitWords(colourText);
    if (colour.size() != 3 && !colour.empty())
    {
      RefuseTable(place, "its colour is " + Quoted(colourText) + ", not three numbers from 0 to 1; correct it");
    }
    label.colour = colour.empty() ? label.colour : UnitColour(colour[0], colour[1], colour[2], place);
    collector.Add(std::move(label), place);
  }
  return collector.Take();
}

} // namespace rhombic
