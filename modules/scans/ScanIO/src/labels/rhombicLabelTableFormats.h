#ifndef rhombicLabelTableFormats_h
#define rhombicLabelTableFormats_h

#include "rhombicLabelTable.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rhombic
{

constexpr std::size_t LongestLabelTable = std::size_t{ 1 } << 20; ///< bytes; longer label tables are refused

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

/** A whole number in a range. Throws Failure otherwise; \a what is its name in the message. */
std::int32_t
WholeNumber(std::string_view text, std::int32_t lowest, std::int32_t highest, const char * what, const TablePlace &);

/** A finite number in a range. Throws Failure otherwise; \a what is its name in the message. */
double
RealNumber(std::string_view text, double lowest, double highest, const char * what, const TablePlace &);

/** The value of a label: any 32-bit integer. */
std::int32_t
LabelValue(std::string_view text, const TablePlace &);

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

/** How a file became a label table: by a user who named it, or by its own name. */
enum class TableChoice
{
  Named,
  Found
};

/** The labels of a text; nothing when it is no label table (see ParseLabelTable()). A text that was found is none
 * either if it may as well be notes, measures, or the description of another data set: lines of a number and words,
 * columns called "value" or "label" and "name", a dataset.json of other tasks. Throws Failure(Unreadable) for a table
 * with mistakes. */
std::optional<LabelTable>
ParseIfLabelTable(std::string_view text, const std::string & source, TableChoice choice);

/** The segments of one \a layer of a 3D Slicer segmentation (.seg.nrrd), from the key/value pairs of its NRRD header
 * (Segment0_Name, Segment0_LabelValue, ...); each layer numbers its segments independently. Empty when there are none.
 * \a source is for messages. Throws Failure(Unreadable), naming the key. */
LabelTable
LabelsOfSegments(const std::map<std::string, std::string> & keyValues, const std::string & source, int layer = 0);

/** Whether the key/value pairs of a NRRD header describe segments. */
bool
HasSegments(const std::map<std::string, std::string> & keyValues);

/** The labels in XML as Caret and Connectome Workbench write it:
 * `<LabelTable><Label Key="1" Red="1" Green="0" Blue="0" Alpha="1">liver</Label>`, colours from 0 to 1; empty when
 * there are none. \a source is for messages. Throws Failure(Unreadable) for XML that is damaged, declares a document
 * type, or is longer than 1 MiB. */
LabelTable
ParseCaretLabels(std::string_view xml, const std::string & source);

/** The label table in a NIfTI file's header extension (a Caret LabelTable, as TotalSegmentator writes it), if there is
 * one. Throws Failure(Unreadable) when it is damaged. */
std::optional<LabelTable>
ReadNIfTILabelTable(const std::filesystem::path & path);

} // namespace rhombic

#endif
