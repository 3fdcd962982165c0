#ifndef rhombicWording_h
#define rhombicWording_h

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace rhombic
{

/** \file
 * Text from numbers, numbers from text, and parts of sentences for users. Nothing here depends on the locale. */

/** A number with a fixed count of decimals, from 0 to 100: "12.30". Zero has no sign, also where it was rounded. */
std::string
FormatFixed(double value, int decimals);

/** A number of at most \a digits significant digits, without trailing zeros: "0.5", "1e+06", as printf's %g. */
std::string
FormatNumber(double value, int digits = 6);

/** Numbers of three axes with at most \a digits significant digits, as "512 x 512 x 138" or "0.7 x 0.7 x 2". */
template <typename TNumbers>
std::string
FormatProduct(const TNumbers & numbers, int digits = 6)
{
  const auto format = [digits](auto number) { return FormatNumber(static_cast<double>(number), digits); };
  return format(numbers[0]) + " x " + format(numbers[1]) + " x " + format(numbers[2]);
}

/** The shortest text that is read back as the same number. */
std::string
FormatExact(double value);

constexpr double CubicMillimetresPerMl = 1000.0;

/** A volume given in ml, with one decimal: "12.3 ml". Below 0.05 ml with three digits: "8.18 mm3", "523 um3". */
std::string
DescribeVolume(double millilitres);

/** A volume and its uncertainty, both given in ml, in one unit: "12.3 +- 0.1 ml". */
std::string
DescribeVolume(double millilitres, double uncertainty);

/** An area given in mm2, with one decimal: "12.3 cm2". Below 0.05 cm2 with three digits: "4.91 mm2", "523 um2". */
std::string
DescribeArea(double squareMillimetres);

/** A length given in mm, with one decimal: "12.3 mm". Below 1 mm with three digits: "0.398 mm", "39.8 um". */
std::string
DescribeLength(double millimetres);

/** The spacing of a grid, given in mm: "0.7 x 0.7 x 2 mm", or "5 x 5 x 5 um" if no axis has 0.1 mm. */
template <typename TNumbers>
std::string
DescribeSpacing(const TNumbers & spacing, int digits = 6)
{
  constexpr double shortest = 0.1; // mm
  constexpr double micrometres = 1000.0;
  if (spacing[0] < shortest && spacing[1] < shortest && spacing[2] < shortest)
  {
    const double scaled[] = { micrometres * spacing[0], micrometres * spacing[1], micrometres * spacing[2] };
    return FormatProduct(scaled, digits) + " um";
  }
  return FormatProduct(spacing, digits) + " mm";
}

/** The whole of \a text as a number. Nothing when it is none, has other characters, blanks or a plus sign, or is out of
 * the type's range. Floating-point numbers may be "inf" or "nan". */
template <typename TNumber>
std::optional<TNumber>
ToNumber(std::string_view text)
{
  TNumber number{};
  const char * const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc() && end == last ? std::optional<TNumber>(number) : std::nullopt;
}

/** Replaces words of a text wherever no letter or digit goes on with them: "g" stands alone in "g.mhd", not in "large".
 */
void
ReplaceWords(std::string & text, const std::string & words, const std::string & by);

/** \a text in lower case. Letters beyond ASCII stay as they are. */
std::string
LowerCase(std::string_view text);

/** \a text without blanks (spaces, tabs, line ends) at either end: a view into the same memory. */
std::string_view
Trim(std::string_view text);

/** The words of \a text, which blanks separate: views into the same memory. */
std::vector<std::string_view>
SplitWords(std::string_view text);

/** The parts of \a text between any of the characters \a separators. Parts may be empty; an empty text is one part. */
std::vector<std::string>
Split(std::string_view text, std::string_view separators);

/** Whether \a text fits a pattern, in which `*` stands for any characters and `?` for any one byte. Upper and lower
 * case are the same. */
bool
MatchesPattern(std::string_view pattern, std::string_view text);

/** The hash of a text (FNV-1a, 64 bits) in 16 hexadecimal digits. */
std::string
HashText(std::string_view text);

/** "1 label", "2 labels". \a plural is the noun with an s when it is empty. */
std::string
Count(std::uintmax_t number, const std::string & noun, const std::string & plural = {});

/** "lean, fine or octahedra", with \a conjunction before the last word. */
std::string
Enumerate(const std::vector<std::string> & words, const std::string & conjunction = "or");

/** The one of \a names that \a word was probably meant to be. A name is near when at most a third of its letters is
 * wrong, missing, added or exchanged with a neighbour, or when one of the two contains the other and that has three
 * letters or more. Upper and lower case are the same. Empty when no name is near. */
std::string
NearestName(const std::string & word, const std::vector<std::string> & names);

/** "There is no mode 'leen'; did you mean lean? Otherwise use lean or fine." \a what is a noun, \a advice what to do
 * when no name is near. */
std::string
DescribeUnknown(const std::string & what,
                const std::string & word,
                const std::vector<std::string> & names,
                const std::string & advice);

} // namespace rhombic

#endif
