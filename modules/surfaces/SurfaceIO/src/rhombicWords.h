#ifndef rhombicWords_h
#define rhombicWords_h

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace rhombic
{

/** The text without blanks at its beginning and end. */
inline std::string_view
Trimmed(std::string_view text)
{
  constexpr std::string_view blanks = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == text.npos ? std::string_view() : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/** The beginning of a text file without a byte order mark. */
inline std::string_view
WithoutMark(std::string_view beginning)
{
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return beginning.substr(0, mark.size()) == mark ? beginning.substr(mark.size()) : beginning;
}

inline std::string
LowerCase(std::string_view text)
{
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return lower;
}

/** Removes the next word from a line and returns it; empty if there is none. */
inline std::string_view
TakeWord(std::string_view & line)
{
  const auto isBlank = [](char letter) { return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n'; };
  std::size_t begin = 0;
  while (begin < line.size() && isBlank(line[begin]))
  {
    ++begin;
  }
  std::size_t end = begin;
  while (end < line.size() && !isBlank(line[end]))
  {
    ++end;
  }
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

/** The number that a whole word is, in any locale. A float that is too small becomes 0; one that is too large is none.
 */
template <typename TNumber>
std::optional<TNumber>
ParseNumber(std::string_view word)
{
  if (word.size() > 1 && word[0] == '+' && word[1] != '-')
  {
    word.remove_prefix(1);
  }
  TNumber number{};
  const char * const last = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data(), last, number);
  if constexpr (std::is_same_v<TNumber, float>)
  {
    if (error == std::errc::result_out_of_range)
    {
      const std::optional<double> precise = ParseNumber<double>(word);
      return precise && std::abs(*precise) < 1 ? std::optional<float>(static_cast<float>(*precise)) : std::nullopt;
    }
  }
  return error != std::errc() || end != last ? std::nullopt : std::optional<TNumber>(number);
}

/** Appends the shortest text that is read as the same number, in any locale. */
template <typename TNumber>
void
AppendNumber(TNumber number, std::string & text)
{
  char digits[64];
  text.append(digits, std::to_chars(digits, digits + sizeof(digits), number).ptr);
}

/** Whether a comment or header declares that coordinates are in RAS. */
inline bool
SaysRAS(std::string_view text)
{
  return text.find("SPACE=RAS") != text.npos;
}

} // namespace rhombic

#endif
