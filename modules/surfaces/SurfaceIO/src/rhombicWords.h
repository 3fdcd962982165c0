#ifndef rhombicWords_h
#define rhombicWords_h

#include "rhombicInputFile.h"
#include "rhombicWording.h"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>

namespace rhombic
{

/** The beginning of a text file without a byte order mark. */
inline std::string_view
WithoutMark(std::string_view beginning)
{
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return beginning.substr(0, mark.size()) == mark ? beginning.substr(mark.size()) : beginning;
}

/** Removes the next word from a line and returns it; empty if there is none. */
inline std::string_view
TakeWord(std::string_view & line)
{
  constexpr std::string_view blanks = " \t\r\n";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

/** The number that a whole word is, perhaps with a plus sign. A float that is too small becomes 0; a float that is
 * too large is none. */
template <typename TNumber>
std::optional<TNumber>
ParseNumber(std::string_view word)
{
  if (word.size() > 1 && word[0] == '+' && word[1] != '-')
  {
    word.remove_prefix(1);
  }
  const auto number = ToNumber<TNumber>(word);
  if constexpr (std::is_same_v<TNumber, float>)
  {
    if (!number)
    {
      const auto precise = ToNumber<double>(word);
      return precise && std::abs(*precise) < 1 ? std::optional<float>(static_cast<float>(*precise)) : std::nullopt;
    }
  }
  return number;
}

/** The three numbers that begin a line. Throws Failure(Unreadable) with a reason if there are fewer. */
inline std::array<float, 3>
ParseTriple(std::string_view words, const InputStream & stream, const char * why)
{
  std::array<float, 3> triple;
  for (float & value : triple)
  {
    const auto number = ParseNumber<float>(TakeWord(words));
    if (!number)
    {
      stream.RefuseLine(why);
    }
    value = *number;
  }
  return triple;
}

} // namespace rhombic

#endif
