#ifndef rhombicLabelTable_h
#define rhombicLabelTable_h

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rhombic
{

/** \file
 * Tables of names and colours for the values of label maps. */

/** \class Label
 * \brief Name and display properties of a value of a label map. */
struct Label
{
  std::int32_t value = 0;               ///< 0 is the background
  std::string name;                     ///< as SanitizeLabelName() leaves it
  std::array<std::uint8_t, 3> colour{}; ///< red, green and blue, sRGB
  double opacity = 1;                   ///< from 0 to 1
  bool isVisible = true;                ///< whether its surface is to be shown
};

/** Sorted by value, each value once. */
using LabelTable = std::vector<Label>;

/** Reads the text of a label table: an ITK-SNAP label description, a 3D Slicer colour table (.ctbl), a FreeSurfer
 * colour table, a table with a header that names the columns LabelValue, index, label or value, and Name, between
 * commas, semicolons or tabs (3D Slicer's .csv, BIDS' _dseg.tsv, and others), lines of a value and a name, or an
 * nnU-Net dataset.json. The format is recognised by the content, and by the extension of \a source where a 3D Slicer
 * and a FreeSurfer table look the same: the last number is the opacity in one and the transparency in the other. A byte
 * order mark of UTF-8 is skipped. \a source is the text's name in messages; it is not opened.
 *
 * Labels without a colour get one by their names (data/anatomical-colours.tsv). Throws Failure(Unreadable), naming the
 * line, for any other text, text in UTF-16, nnU-Net regions of several values, values out of range, values given twice,
 * more than 1 MiB, and more than 100,000 lines. */
LabelTable
ParseLabelTable(std::string_view text, const std::string & source);

/** ParseLabelTable() of a file. Throws Failure(NotFound) when there is none. */
LabelTable
ReadLabelTable(const std::filesystem::path & path);

/** The label table that belongs to a label map: the one in a NIfTI file itself, else that of a file beside it with the
 * same name and the extension .ctbl, .csv, .tsv, .label or .txt, the first that holds a label table. None when there is
 * neither. Throws Failure(Unreadable) for a table with mistakes. */
std::optional<LabelTable>
FindLabelTable(const std::filesystem::path & volumePath);

/** The labels of a dataset.json of nnU-Net in the folder of a label map or the one above, which is of all label maps
 * there. Throws as FindLabelTable() does. */
std::optional<LabelTable>
FindDatasetTable(const std::filesystem::path & volumePath);

/** Moves a colour (sRGB) towards white by a fraction, or towards black by a negative one. */
std::array<std::uint8_t, 3>
Lighten(std::array<std::uint8_t, 3> colour, double fraction);

/** The colour (sRGB) of an organ, bone, vessel, ... in anatomical illustrations, by its name in English or anatomical
 * Latin: "kidney_left", "Left-Kidney". The table is data/anatomical-colours.tsv. Left is lighter than right, and odd
 * vertebrae, ribs and teeth are darker than even ones. Nothing for other names. */
std::optional<std::array<std::uint8_t, 3>>
FindAnatomicalColour(const std::string & name);

/** The group of a structure, by its name as FindAnatomicalColour() takes it: "bones", "vessels", "organs", "muscles",
 * "brain and nerves", "tissues", "findings" or "devices", as the same table says. Empty for other names. */
std::string
FindAnatomicalGroup(const std::string & name);

/** FindAnatomicalColour(), or for other names one of 16 quiet colours, or of lighter and darker ones: by \a value, or
 * by the name where that has a side, so that left and right have one hue. */
std::array<std::uint8_t, 3>
AnatomicalColour(const std::string & name, std::int32_t value);

/** The name of a volume file without its folder and extensions: "liver" of "masks/liver.seg.nrrd". */
std::string
StemOfVolume(const std::filesystem::path & volumePath);

/** A label's name, safe to show: valid UTF-8 of at most 100 bytes without control characters, changes of writing
 * direction, or spaces at its ends or in a row. "label N" when nothing is left. */
std::string
SanitizeLabelName(std::string_view name, std::int32_t value);

/** A label with a name as SanitizeLabelName() leaves it, and the colour of that name. */
Label
NamedLabel(std::int32_t value, std::string_view name);

/** A label's name, safe as the beginning of a file's name: 1 to 100 of A-Z, a-z, 0-9, '.', '_' and '-', not beginning
 * with '.' or '-'. "label" when nothing is left. Different names may give the same stem. */
std::string
FileStemOf(std::string_view name);

} // namespace rhombic

#endif
