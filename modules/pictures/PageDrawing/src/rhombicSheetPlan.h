#ifndef rhombicSheetPlan_h
#define rhombicSheetPlan_h

#include "rhombicLegend.h"
#include "rhombicSheet.h"

#include <utility>

namespace rhombic
{

/** The columns of a table on one page. */
struct TableArea
{
  Rectangle area;
  std::size_t columns = 1;
  std::size_t rows = 0; ///< that fit in a column, without its heading
};

/** Where everything goes on a sheet. Lengths are in pixels. */
struct SheetPlan
{
  double millimetre = 0.0; ///< in pixels
  SheetPlaces places;
  Rectangle content; ///< of all pages, between title and footer
  double rowPitch = 0.0;
  double tableText = 0.0;        ///< size of the table's text
  TableArea first;               ///< on the first page
  TableArea further;             ///< on the other pages
  std::vector<LegendLine> lines; ///< of the table
  Rectangle provenance;
  bool isTableApart = false;             ///< whether table and provenance are on further pages only
  std::vector<double> provenanceHeights; ///< of each line, which may be broken
  std::size_t provenanceRows = 0;        ///< lines in the first column; the others are in the second
};

namespace sheet
{
/** Lengths in mm. */
constexpr double SideMargin = 12.0;
constexpr double TopMargin = 8.0;
constexpr double TitleHeight = 13.5;
constexpr double FooterHeight = 13.0;
constexpr double Gap = 4.0; ///< between pictures, and between table columns
constexpr double CaptionHeight = 5.0;
constexpr double HeadingHeight = 5.0;     ///< of a table column
constexpr double ProvenanceText = 2.45;   ///< size of the font
constexpr double ProvenanceSpace = 0.7;   ///< between lines
constexpr double ProvenanceIndent = 22.0; ///< of values behind their names
constexpr double NameColumn = 43.0;       ///< with the swatch
constexpr double FigureColumn = 15.0;
constexpr double RoomForLetters = 7.0; ///< at each edge of a picture

constexpr double PointsOfPictures = 7.0; ///< size of the text over pictures, in points
} // namespace sheet

/** A line of provenance as name and value. The name is empty when there is no colon. */
std::pair<std::string, std::string>
SplitProvenance(const std::string & line);

/** Whether any row has a figure, which is a column of the table then. */
bool
HasFigure(const std::vector<LegendRow> & rows, std::optional<double> LegendRow::*figure);

/** Throws Failure(Usage) for more pictures than a sheet has places for. */
SheetPlan
PlanSheet(const Sheet & sheet);

} // namespace rhombic

#endif
