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

/** The formats of label tables. */
enum class LabelTableFormat
{
  None,
  ITKSNAP,
  SlicerText,
  SlicerProcedural, ///< colours of a scale, not of labels: refused
  FreeSurfer,
  Columns,      ///< with a header: 3D Slicer's .csv, BIDS, and others
  ValueAndName, ///< lines as `1 liver`
  DatasetJSON   ///< nnU-Net
};

/** Recognises a text's format by its comments, its header or its first row, and by the extension of \a source where
 * these are ambiguous. \a lines are those of LinesOfTable(). */
LabelTableFormat
RecogniseLabelTable(std::string_view text, const std::vector<TextLine> & lines, const std::string & source);

/** Whether a text of that format is a table of labels and nothing else: not lines of a number and words, nor columns
 * called "value" or "label" and "name", which may be notes or measures, nor a dataset.json of other tasks. */
bool
IsSurelyLabelTable(LabelTableFormat format, std::string_view text, const std::vector<TextLine> & lines);

/** Parses all lines as rows `IDX R G B A VIS MSH "LABEL"`. A label is visible if VIS and MSH are set. */
LabelTable
ParseITKSNAPTable(const std::vector<TextLine> & lines, const std::string & source);

/** Parses all lines as rows `index name r g b a`; a is the opacity from 0 to 255 (3D Slicer), or the transparency
 * (FreeSurfer). */
LabelTable
ParseNamedTable(const std::vector<TextLine> & lines, const std::string & source, bool isTransparency);

/** Parses a header and rows with at least a value (LabelValue, index, label or value) and a name; Color_R, _G and _B,
 * and Color_A (opacity), or color (#rrggbb) may be missing. The separator is the header's. */
LabelTable
ParseColumnTable(const std::vector<TextLine> & lines, const std::string & source);

/** Parses all lines as rows `value name`. */
LabelTable
ParseValuesAndNames(const std::vector<TextLine> & lines, const std::string & source);

/** Parses the labels of nnU-Net's dataset.json: names with values, or, as before version 2, values with names. Throws
 * for labels that are regions of several values. */
LabelTable
ParseDatasetJSON(std::string_view json, const std::string & source);

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
