#ifndef rhombicLabelTableFormats_h
#define rhombicLabelTableFormats_h

#include "rhombicLabelText.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rhombic
{

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

/** Parses all lines as rows `index name r g b a`; a is the opacity from 0 to 255. */
LabelTable
ParseSlicerTable(const std::vector<TextLine> & lines, const std::string & source);

/** Parses all lines as rows `No. name R G B A`; A is the transparency from 0 to 255. */
LabelTable
ParseFreeSurferTable(const std::vector<TextLine> & lines, const std::string & source);

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
