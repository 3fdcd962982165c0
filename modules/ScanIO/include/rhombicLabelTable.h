#ifndef rhombicLabelTable_h
#define rhombicLabelTable_h

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rhombic
{

/** \file
 * What the values of label maps mean. Thread safety: labels are values, and any number of threads may call
 * these functions at once. */

/** \class Label
 * \brief What a value of a label map means, and how to show it. */
struct Label
{
  std::int32_t value = 0;               ///< 0 is the background
  std::string name;                     ///< as SanitizeLabelName() leaves it
  std::array<std::uint8_t, 3> colour{}; ///< red, green and blue, sRGB
  double opacity = 1;                   ///< from 0 to 1
  bool isVisible = true;                ///< whether its surface is meant to be shown
};

/** Sorted by value, each value once. */
using LabelTable = std::vector<Label>;

/** Reads the text of a label table: an ITK-SNAP label description, a 3D Slicer colour table (.ctbl, or .csv with
 * columns LabelValue and Name), a FreeSurfer colour table, or a BIDS table (_dseg.tsv). They are told apart by content;
 * by the extension of \a source too where a 3D Slicer and a FreeSurfer table look the same but mean the opposite by
 * their last number. \a source is the text's name for messages and is not opened.
 *
 * Labels without a colour get that of AnatomicalColour(). Throws Failure(Unreadable), naming the line, for anything
 * else than such a table, values out of range, values given twice, more than 1 MiB and more than 100,000 lines. */
LabelTable
ParseLabelTable(std::string_view text, const std::string & source);

/** ParseLabelTable() of a file. Throws Failure(NotFound) too. */
LabelTable
ReadLabelTable(const std::filesystem::path & path);

/** The segments of a 3D Slicer segmentation (.seg.nrrd), from the key/value pairs of its NRRD header (Segment0_Name,
 * Segment0_LabelValue, ...). Only those in one \a layer, because layers number their segments independently; empty
 * when there are none. \a source is for messages. Throws Failure(Unreadable), naming the key. */
LabelTable
LabelsOfSegments(const std::map<std::string, std::string> & keyValues, const std::string & source, int layer = 0);

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

/** The label table that comes with a label map: in the file itself, else in a file beside it of the same name with
 * .ctbl, .csv, .tsv, .label or .txt, the first that holds a label table; none if there is neither. \a keyValues are
 * those of its NRRD header. Throws Failure(Unreadable) for a table with mistakes. */
std::optional<LabelTable>
FindLabelTable(const std::filesystem::path & volumePath, const std::map<std::string, std::string> & keyValues = {});

/** A name that is safe to show: valid UTF-8 without control characters or changes of writing direction, spaces joined
 * and trimmed, at most 100 bytes; "label N" when nothing is left of it. */
std::string
SanitizeLabelName(std::string_view name, std::int32_t value);

/** A name that is safe as the beginning of a file's name: 1 to 100 of A-Z, a-z, 0-9, '.', '_' and '-', the first no '.'
 * and no '-'; "label" when nothing is left of it. Different names may give the same. */
std::string
FileStemOf(std::string_view name);

} // namespace rhombic

#endif
