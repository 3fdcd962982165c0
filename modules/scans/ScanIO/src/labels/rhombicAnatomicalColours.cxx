#include "rhombicLabelTable.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rhombic
{
namespace
{

using LabelColour = std::array<std::uint8_t, 3>;

/** A line of data/anatomical-colours.tsv, which explains it. */
struct Rule
{
  std::string_view word;
  std::string_view second;
  LabelColour colour;
};

constexpr Rule Rules[] = {
#include "rhombicAnatomicalColourRules.inc" // from data/anatomical-colours.tsv
};

bool
IsLetter(char letter)
{
  return letter >= 'a' && letter <= 'z';
}

bool
IsDigit(char letter)
{
  return letter >= '0' && letter <= '9';
}

/** The words of a name in lower case. A new word begins at a capital after a small letter and at a digit: leftKidney,
 * T12. */
std::vector<std::string>
WordsOfName(const std::string & name)
{
  std::vector<std::string> words(1);
  char previous = ' ';
  for (const char letter : name)
  {
    const bool isCapital = letter >= 'A' && letter <= 'Z';
    const char lower = isCapital ? static_cast<char>(letter - 'A' + 'a') : letter;
    const bool isHump = isCapital && IsLetter(previous);
    const bool isNumber = IsDigit(letter) && !IsDigit(previous);
    if (isHump || isNumber || !(IsLetter(lower) || IsDigit(lower)))
    {
      words.emplace_back();
    }
    if (IsLetter(lower) || IsDigit(lower))
    {
      words.back() += lower;
    }
    previous = letter;
  }
  return words;
}

bool
HasWord(const std::vector<std::string> & words, std::string_view wanted)
{
  const bool isWhole = wanted.back() == '.';
  wanted.remove_suffix(isWhole ? 1 : 0);
  return std::any_of(words.begin(), words.end(), [&](const std::string & word) {
    return word.compare(0, wanted.size(), wanted) == 0 && (!isWhole || word.size() == wanted.size());
  });
}

bool
HasOddNumber(const std::vector<std::string> & words)
{
  const auto number = std::find_if(
    words.rbegin(), words.rend(), [](const std::string & word) { return !word.empty() && IsDigit(word.back()); });
  return number != words.rend() && (number->back() - '0') % 2 == 1;
}

/** A colour by its hue (in turns), saturation and brightness (from 0 to 1). */
LabelColour
ColourOfHue(double turns, double saturation, double brightness)
{
  const auto component = [&](double offset) {
    const double position = std::fmod(turns + offset, 1.0) * 6;
    const double share = std::clamp(std::abs(position - 3) - 1, 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255 * brightness * (1 - saturation * (1 - share))));
  };
  return { component(0), component(2.0 / 3), component(1.0 / 3) };
}

/** A colour whose hue is a golden angle from that of the previous value. Values with nearly the same hue (5, 8 and 13
 * apart) differ in saturation or brightness. */
LabelColour
ColourOfValue(std::int32_t value)
{
  constexpr double goldenAngle = 0.381966011250105; // turns
  constexpr double saturations[3] = { 0.62, 0.4, 0.82 };
  constexpr double brightnesses[5] = { 0.92, 0.7, 0.84, 0.6, 0.77 };
  const std::int64_t number = std::int64_t{ value } - std::numeric_limits<std::int32_t>::min();
  const double turns = std::fmod(static_cast<double>(number) * goldenAngle, 1.0);
  return ColourOfHue(turns, saturations[number % 3], brightnesses[number % 5]);
}

} // namespace

std::array<std::uint8_t, 3>
Lighten(std::array<std::uint8_t, 3> colour, double fraction)
{
  for (std::uint8_t & component : colour)
  {
    const double target = fraction > 0 ? 255 : 0;
    component = static_cast<std::uint8_t>(std::lround(component + std::abs(fraction) * (target - component)));
  }
  return colour;
}

std::optional<std::array<std::uint8_t, 3>>
FindAnatomicalColour(const std::string & name)
{
  const std::vector<std::string> words = WordsOfName(name);
  const auto * const rule = std::find_if(std::begin(Rules), std::end(Rules), [&words](const Rule & candidate) {
    return HasWord(words, candidate.word) && (candidate.second.empty() || HasWord(words, candidate.second));
  });
  if (rule == std::end(Rules))
  {
    return std::nullopt;
  }
  const bool beginsWithL = words.size() > 1 && words[0] == "l" && !IsDigit(words[1][0]); // L1 is a vertebra
  const bool isLeft = HasWord(words, "left.") || HasWord(words, "sinist") || words.back() == "l" || beginsWithL;
  const LabelColour sided = Lighten(rule->colour, isLeft ? 0.2 : 0.0);
  return Lighten(sided, HasOddNumber(words) ? -0.1 : 0.0);
}

std::array<std::uint8_t, 3>
AnatomicalColour(const std::string & name, std::int32_t value)
{
  return FindAnatomicalColour(name).value_or(ColourOfValue(value));
}

} // namespace rhombic
