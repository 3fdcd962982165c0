#include "rhombicWording.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numeric>

namespace rhombic
{
namespace
{

constexpr std::string_view Blanks = " \t\r\n\v\f";

/** std::to_chars() as a string: unlike printf and streams, it ignores the locale. */
template <typename... TFormat>
std::string
ToText(double value, TFormat... format)
{
  std::array<char, 512> text; // the largest double has 309 digits before the point
  return { text.data(), std::to_chars(text.data(), text.data() + text.size(), value, format...).ptr };
}

/** The least number of letters inserted, deleted, replaced or exchanged with a neighbour that turns one word into the
 * other (Damerau and Levenshtein; each letter changes once at most). */
std::size_t
EditDistance(const std::string & a, const std::string & b)
{
  std::vector<std::vector<std::size_t>> rows(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  std::iota(rows[0].begin(), rows[0].end(), 0u);
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    rows[i][0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t replaced = rows[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      rows[i][j] = std::min({ rows[i - 1][j] + 1, rows[i][j - 1] + 1, replaced });
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
      {
        rows[i][j] = std::min(rows[i][j], rows[i - 2][j - 2] + 1);
      }
    }
  }
  return rows.back().back();
}

/** The edit distance of two words in lower case, if they are near each other. */
std::optional<std::size_t>
NearDistance(const std::string & a, const std::string & b)
{
  constexpr std::size_t shortestPart = 3;
  const std::string & shorter = a.size() < b.size() ? a : b;
  const std::string & longer = a.size() < b.size() ? b : a;
  const std::size_t distance = EditDistance(a, b);
  const bool isPart = shorter.size() >= shortestPart && longer.find(shorter) != std::string::npos;
  return isPart || 3 * distance <= longer.size() ? std::optional(distance) : std::nullopt;
}

/** A unit of a measure. */
struct Unit
{
  const char * name;
  double perBase; ///< the factor from the unit of the value that is given
  double least;   ///< the smallest value, as given, that is written in this unit
  bool isRound;   ///< written with one decimal, else with three digits
};
using Units = std::array<Unit, 3>; ///< from the largest to the smallest

constexpr Units VolumeUnits{ { { "ml", 1.0, 0.05, true }, { "mm3", 1e3, 1e-6, false }, { "um3", 1e12, 0.0, false } } };
constexpr Units AreaUnits{ { { "cm2", 0.01, 5.0, true }, { "mm2", 1.0, 1e-3, false }, { "um2", 1e6, 0.0, false } } };
constexpr Units LengthUnits{ { { "mm", 1.0, 1.0, true }, { "mm", 1.0, 0.1, false }, { "um", 1e3, 0.0, false } } };

/** The largest unit in which a number is not too small; for 0 and no numbers the largest of all. */
const Unit &
FindUnit(double value, const Units & units)
{
  const double size = std::abs(value);
  const auto fits = [size](const Unit & unit) { return size >= unit.least; };
  return size > 0.0 ? *std::find_if(units.begin(), units.end(), fits) : units.front();
}

std::string
FormatIn(const Unit & unit, double value)
{
  constexpr int digits = 3;
  return unit.isRound ? FormatFixed(unit.perBase * value, 1) : FormatNumber(unit.perBase * value, digits);
}

std::string
FormatMeasure(double value, const Units & units)
{
  const Unit & unit = FindUnit(value, units);
  return FormatIn(unit, value) + ' ' + unit.name;
}

} // namespace

std::string
FormatFixed(double value, int decimals)
{
  std::string text = ToText(value, std::chars_format::fixed, decimals);
  const bool isZero = text.find_first_of("123456789in") == std::string::npos; // inf, nan
  return isZero && text[0] == '-' ? text.substr(1) : text;
}

std::string
FormatNumber(double value, int digits)
{
  return ToText(value, std::chars_format::general, digits);
}

std::string
FormatExact(double value)
{
  return ToText(value);
}

std::string
DescribeVolume(double millilitres)
{
  return FormatMeasure(millilitres, VolumeUnits);
}

std::string
DescribeVolume(double millilitres, double uncertainty)
{
  const Unit & unit = FindUnit(millilitres, VolumeUnits);
  return FormatIn(unit, millilitres) + " +- " + FormatIn(unit, uncertainty) + ' ' + unit.name;
}

std::string
DescribeArea(double squareMillimetres)
{
  return FormatMeasure(squareMillimetres, AreaUnits);
}

std::string
DescribeLength(double millimetres)
{
  return FormatMeasure(millimetres, LengthUnits);
}

void
ReplaceWords(std::string & text, const std::string & words, const std::string & by)
{
  const auto areInWord = [&text](std::size_t place) { // the bytes before and at a place
    const auto isLetter = [&text](std::size_t n) { return std::isalnum(static_cast<unsigned char>(text[n])) != 0; };
    return place > 0 && place < text.size() && isLetter(place - 1) && isLetter(place);
  };
  for (auto place = text.find(words); place != std::string::npos && !words.empty(); place = text.find(words, place))
  {
    const bool isInWord = areInWord(place) || areInWord(place + words.size());
    if (!isInWord)
    {
      text.replace(place, words.size(), by);
    }
    place += isInWord ? 1 : by.size();
  }
}

std::string
LowerCase(std::string_view text)
{
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  return lower;
}

std::string_view
Trim(std::string_view text)
{
  const std::size_t begin = text.find_first_not_of(Blanks);
  return begin == std::string_view::npos ? "" : text.substr(begin, text.find_last_not_of(Blanks) - begin + 1);
}

std::vector<std::string_view>
SplitWords(std::string_view text)
{
  std::vector<std::string_view> words;
  for (text = Trim(text); !text.empty(); text = Trim(text))
  {
    const std::size_t end = std::min(text.find_first_of(Blanks), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return words;
}

std::vector<std::string>
Split(std::string_view text, std::string_view separators)
{
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

bool
MatchesPattern(std::string_view pattern, std::string_view text)
{
  const std::string wanted = LowerCase(pattern);
  const std::string word = LowerCase(text);
  // After a mismatch the last star takes one more character.
  std::size_t at = 0;
  std::size_t star = std::string::npos;
  std::size_t afterStar = 0;
  for (std::size_t n = 0; n < word.size();)
  {
    if (at < wanted.size() && wanted[at] == '*')
    {
      star = at++;
      afterStar = n;
    }
    else if (at < wanted.size() && (wanted[at] == '?' || wanted[at] == word[n]))
    {
      ++at;
      ++n;
    }
    else if (star != std::string::npos)
    {
      at = star + 1;
      n = ++afterStar;
    }
    else
    {
      return false;
    }
  }
  return wanted.find_first_not_of('*', at) == std::string::npos;
}

std::string
HashText(std::string_view text)
{
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char letter : text)
  {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3u;
  }
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4)
  {
    digits += "0123456789abcdef"[hash >> shift & 15];
  }
  return digits;
}

std::string
Count(std::uintmax_t number, const std::string & noun, const std::string & plural)
{
  return std::to_string(number) + ' ' + (number == 1 ? noun : plural.empty() ? noun + 's' : plural);
}

std::string
Enumerate(const std::vector<std::string> & words, const std::string & conjunction)
{
  std::string text;
  for (std::size_t n = 0; n < words.size(); ++n)
  {
    text += (n == 0 ? "" : n + 1 < words.size() ? ", " : " " + conjunction + " ") + words[n];
  }
  return text;
}

std::string
NearestName(const std::string & word, const std::vector<std::string> & names)
{
  const std::string lowerCase = LowerCase(word);
  std::string nearest;
  std::optional<std::size_t> smallest;
  const auto compare = [&](const std::string & part, const std::string & name) {
    const auto distance = NearDistance(lowerCase, LowerCase(part));
    if (distance && (!smallest || *distance < *smallest))
    {
      smallest = distance;
      nearest = name;
    }
  };
  for (const std::string & name : names)
  {
    compare(name, name);
  }
  for (std::size_t n = 0; !smallest && n < names.size(); ++n) // one word of a name, as kidney of kidney_left
  {
    std::string part;
    for (const char letter : names[n] + '_')
    {
      const bool isLetter = std::isalnum(static_cast<unsigned char>(letter)) != 0;
      if (!isLetter && part.size() > 3)
      {
        compare(part, names[n]);
      }
      part = isLetter ? part + letter : "";
    }
  }
  return nearest;
}

std::string
DescribeUnknown(const std::string & what,
                const std::string & word,
                const std::vector<std::string> & names,
                const std::string & advice)
{
  const std::string nearest = NearestName(word, names);
  return "There is no " + what + " '" + word + "'; " +
         (nearest.empty() ? advice : "did you mean " + nearest + "? Otherwise " + advice) + ".";
}

} // namespace rhombic
