#include "rhombicLabelTable.h"

#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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
  std::string_view group;
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

/** The first rule that fits the words; null if none does. */
const Rule *
FindRule(const std::vector<std::string> & words)
{
  const auto * const rule = std::find_if(std::begin(Rules), std::end(Rules), [&words](const Rule & candidate) {
    return HasWord(words, candidate.word) && (candidate.second.empty() || HasWord(words, candidate.second));
  });
  return rule == std::end(Rules) ? nullptr : rule;
}

bool
HasOddNumber(const std::vector<std::string> & words)
{
  const auto number = std::find_if(
    words.rbegin(), words.rend(), [](const std::string & word) { return !word.empty() && IsDigit(word.back()); });
  return number != words.rend() && (number->back() - '0') % 2 == 1;
}

bool
IsLeftWord(const std::string & word)
{
  return word == "left" || word.rfind("sinist", 0) == 0;
}

bool
IsRightWord(const std::string & word)
{
  return word == "right" || word.rfind("dext", 0) == 0;
}

/** A structure's name without its side. */
struct SidedName
{
  std::string rest; ///< the other words, with blanks between them
  bool isLeft = false;
  bool isRight = false;
};

/** Finds the side: left, sinistra, right, dexter, or l or r as the first or last word (but L1 is a vertebra). */
SidedName
FindSide(const std::vector<std::string> & words)
{
  SidedName name;
  for (std::size_t n = 0; n < words.size(); ++n)
  {
    const std::string & word = words[n];
    const bool isEnd = n + 1 == words.size() || (n == 0 && !IsDigit(words[1][0]));
    const bool isLeft = IsLeftWord(word) || (isEnd && word == "l");
    const bool isRight = IsRightWord(word) || (isEnd && word == "r");
    name.isLeft = name.isLeft || isLeft;
    name.isRight = name.isRight || isRight;
    name.rest += isLeft || isRight ? "" : word + " ";
  }
  return name;
}

/** One of 16 quiet colours, whose CIEDE2000 differences are 16 and more, then lighter and darker ones. They were found
 * by exchange in CIELAB: lightness 44 to 84, chroma up to 38, but 28 in blue and green, 20 in cyan and red, 12 in
 * violet and pink. */
LabelColour
ColourOfNumber(std::uint32_t number)
{
  constexpr LabelColour quiet[] = { { 251, 199, 165 }, { 19, 112, 144 },  { 90, 111, 47 },   { 145, 105, 126 },
                                    { 156, 223, 195 }, { 132, 188, 231 }, { 163, 121, 65 },  { 191, 177, 198 },
                                    { 216, 213, 140 }, { 204, 138, 131 }, { 104, 104, 104 }, { 156, 85, 61 },
                                    { 115, 148, 152 }, { 132, 164, 119 }, { 61, 113, 103 },  { 177, 168, 147 } };
  constexpr double lightening[] = { 0.0, 0.3, -0.25, 0.15, -0.12, 0.45, -0.38 };
  return Lighten(quiet[number % std::size(quiet)], lightening[number / std::size(quiet) % std::size(lightening)]);
}

constexpr double LighteningOfLeft = 0.2;

/** A quiet colour: of the value, or for names with a side of the other words, so that both sides have one hue. */
LabelColour
ColourOfUnknown(const std::vector<std::string> & words, std::int32_t value)
{
  const SidedName name = FindSide(words);
  if (!name.isLeft && !name.isRight)
  {
    return ColourOfNumber(static_cast<std::uint32_t>(value));
  }
  constexpr int hexadecimal = 16;
  const auto number = static_cast<std::uint32_t>(std::stoul(HashText(name.rest).substr(8), nullptr, hexadecimal));
  return Lighten(ColourOfNumber(number), name.isLeft ? LighteningOfLeft : 0.0);
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
  const Rule * const rule = FindRule(words);
  if (rule == nullptr)
  {
    return std::nullopt;
  }
  const LabelColour sided = Lighten(rule->colour, FindSide(words).isLeft ? LighteningOfLeft : 0.0);
  return Lighten(sided, HasOddNumber(words) ? -0.1 : 0.0);
}

std::string
FindAnatomicalGroup(const std::string & name)
{
  const Rule * const rule = FindRule(WordsOfName(name));
  return rule == nullptr ? std::string() : std::string(rule->group);
}

std::array<std::uint8_t, 3>
AnatomicalColour(const std::string & name, std::int32_t value)
{
  return FindAnatomicalColour(name).value_or(ColourOfUnknown(WordsOfName(name), value));
}

} // namespace rhombic
