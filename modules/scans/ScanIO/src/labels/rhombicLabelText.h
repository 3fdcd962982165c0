#ifndef rhombicLabelText_h
#define rhombicLabelText_h

#include "rhombicLabelTable.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rhombic
{

constexpr std::size_t LongestLabelTable = std::size_t{ 1 } << 20; ///< bytes; longer label tables are refused

/** A line of a label table. */
struct TextLine
{
  std::string_view text;  ///< without spaces at its ends
  std::size_t number = 0; ///< from 1
};

/** The source of a line, for messages: "Cannot read SOURCE, line 3: ..." */
struct TablePlace
{
  const std::string & source;
  std::size_t line = 0; ///< 0 for none
};

/** Throws Failure(Unreadable). \a why is the rest of a sentence, without a full stop. */
[[noreturn]] void
RefuseTable(const TablePlace & place, const std::string & why);

/** Up to 40 bytes of a text in quotes, for messages. */
std::string
Quoted(std::string_view text);

/** The lines of a text that are neither blank nor begin with '#'. Throws for more than
 * 100,000 lines. */
std::vector<TextLine>
LinesOfTable(std::string_view text, const std::string & source);

/** The fields of a line between separators, trimmed. Fields in double quotes may hold separators and doubled quotes.
 * Throws when a quote is not closed. */
std::vector<std::string>
FieldsOf(std::string_view line, char separator, const TablePlace & place);

/** A whole number in a range. Throws Failure otherwise; \a what is its name in the message. */
std::int32_t
WholeNumber(std::string_view text, std::int32_t lowest, std::int32_t highest, const char * what, const TablePlace &);

/** A finite number in a range. Throws Failure otherwise; \a what is its name in the message. */
double
RealNumber(std::string_view text, double lowest, double highest, const char * what, const TablePlace &);

/** The value of a label: any 32-bit integer. */
std::int32_t
LabelValue(std::string_view text, const TablePlace &);

/** A colour from red, green and blue from 0 to 255. */
std::array<std::uint8_t, 3>
ByteColour(std::string_view red, std::string_view green, std::string_view blue, const TablePlace &);

/** A colour from red, green and blue from 0 to 1. */
std::array<std::uint8_t, 3>
UnitColour(std::string_view red, std::string_view green, std::string_view blue, const TablePlace &);

/** \class LabelCollector
 * \brief Sorts labels into a table, and refuses values that occur twice. */
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
