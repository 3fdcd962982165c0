#ifndef rhombicLabelText_h
#define rhombicLabelText_h

#include "rhombicLabelTable.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rhombic
{

/** Longer label tables are refused. */
constexpr std::size_t LongestLabelTable = std::size_t{ 1 } << 20; // bytes

/** A line of a label table. */
struct TextLine
{
  std::string_view text;  ///< without spaces at its ends
  std::size_t number = 0; ///< from 1
};

/** Where a table was found, for messages: "Cannot read SOURCE, line 3: ..." */
struct TablePlace
{
  const std::string & source;
  std::size_t line = 0; ///< 0 for none
};

/** Throws Failure(Unreadable). \a why is the rest of a sentence, without a full stop. */
[[noreturn]] void
RefuseTable(const TablePlace & place, const std::string & why);

/** Up to 40 bytes of a file as part of a sentence, in quotes. */
std::string
Quoted(std::string_view text);

/** Without spaces, tabs and line ends at its ends. */
std::string_view
Trimmed(std::string_view text);

/** In lower case, ASCII only. */
std::string
LowerCase(std::string_view text);

/** The lines of a text that are neither blank nor begin with '#', without byte order mark. Throws for more than 100,000
 * lines. */
std::vector<TextLine>
LinesOfTable(std::string_view text, const std::string & source);

/** The words of a line, which spaces and tabs separate. */
std::vector<std::string_view>
WordsOf(std::string_view line);

/** The fields of a line between separators, trimmed. Fields in double quotes may hold separators and doubled quotes.
 * Throws when a quote is not closed. */
std::vector<std::string>
FieldsOf(std::string_view line, char separator, const TablePlace & place);

/** A whole number, or a refusal that calls it \a what. */
std::int32_t
WholeNumber(std::string_view text, std::int32_t lowest, std::int32_t highest, const char * what, const TablePlace &);

/** A finite number, with a point whatever the locale, or a refusal that calls it \a what. */
double
RealNumber(std::string_view text, double lowest, double highest, const char * what, const TablePlace &);

/** Any label value. */
std::int32_t
LabelValue(std::string_view text, const TablePlace &);

/** Red, green and blue from 0 to 255. */
std::array<std::uint8_t, 3>
ByteColour(std::string_view red, std::string_view green, std::string_view blue, const TablePlace &);

/** Red, green and blue from 0 to 1. */
std::array<std::uint8_t, 3>
UnitColour(std::string_view red, std::string_view green, std::string_view blue, const TablePlace &);

/** \class LabelCollector
 * \brief Makes a table of labels in any order, and refuses values that come twice. */
class LabelCollector
{
public:
  void
  Add(Label label, const TablePlace & place);

  LabelTable
  Take();

private:
  struct Entry
  {
    Label label;
    std::size_t line;
  };
  std::map<std::int32_t, Entry> m_Entries;
};

} // namespace rhombic

#endif
