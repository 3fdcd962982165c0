#ifndef rhombicLabelTableFormats_h
#define rhombicLabelTableFormats_h

#include "rhombicLabelText.h"

#include <string>
#include <vector>

namespace rhombic
{

/** Label tables that can be told apart. */
enum class LabelTableFormat
{
  None,
  ITKSNAP,
  SlicerText,
  SlicerProcedural, ///< colours along a scale, not of labels
  SlicerCSV,
  FreeSurfer,
  BIDS
};

/** What a text is, by its comments, its header or its first row; by the extension of \a source where these leave it
 * open. \a lines are those of LinesOfTable(). */
LabelTableFormat
RecogniseLabelTable(std::string_view text, const std::vector<TextLine> & lines, const std::string & source);

/** Parses all lines as rows `IDX R G B A VIS MSH "LABEL"`. A label is visible if VIS and MSH are set. */
LabelTable
ParseITKSNAPTable(const std::vector<TextLine> & lines, const std::string & source);

/** Parses all lines as rows `index name r g b a`; a is the opacity from 0 to 255. */
LabelTable
ParseSlicerTable(const std::vector<TextLine> & lines, const std::string & source);

/** Parses all lines as rows `No. name R G B A`; A is the transparency from 0 to 255. */
LabelTable
ParseFreeSurferTable(const std::vector<TextLine> & lines, const std::string & source);

/** Parses a header and rows with at least LabelValue and Name; Color_R, _G and _B, and Color_A (opacity) may be
 * missing. */
LabelTable
ParseSlicerCSV(const std::vector<TextLine> & lines, const std::string & source);

/** Parses a header and rows with at least index and name; color (#rrggbb) may be missing. */
LabelTable
ParseBIDSTable(const std::vector<TextLine> & lines, const std::string & source);

} // namespace rhombic

#endif
