#include "rhombicSheetPlan.h"

#include "rhombicColourBar.h"
#include "rhombicFailure.h"
#include "rhombicNameColumns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rhombic
{
namespace
{

using namespace sheet;

constexpr double ShortSide = 210.0; // mm, of A4
constexpr double LongSide = 297.0;
constexpr double PictureShare = 0.62;      // of a landscape page's width
constexpr double WideTableShare = 0.4;     // of a portrait page's height, for rows with the wide pitch
constexpr double LargestTableShare = 0.47; // for others; longer tables go on on further pages
constexpr double RowPitch = 4.5;
constexpr double TightRowPitch = 3.6;
constexpr double RowTextShare = 0.62; // of the row pitch
constexpr double SmallestView = 40.0; // height
constexpr double SmallestViewWithNames = 52.0;
constexpr double UsualView = 80.0;         // height
constexpr double SmallestSlice = 35.0;     // width without the room for letters, of tall slices
constexpr double PreferenceOfOneRow = 0.9; // two rows fill the page better
constexpr std::size_t RowsBesideProvenance = 9;
constexpr std::size_t RowsOfTableApart = 20;

std::size_t
DivideUp(std::size_t a, std::size_t b)
{
  return (a + b - 1) / b;
}

/** The width of a column of the table. */
double
WidthOfColumn(const Sheet & s)
{
  std::size_t figures = s.headings.size();
  for (const auto figure : { &LegendRow::volume, &LegendRow::area, &LegendRow::mean })
  {
    figures += s.headings.empty() && HasFigure(s.rows, figure) ? 1 : 0;
  }
  return NameColumn + FigureColumn * static_cast<double>(figures);
}

/** How many columns fit beside each other. */
std::size_t
CountColumns(double width, const Sheet & s)
{
  const double column = WidthOfColumn(s);
  return std::max<std::size_t>(1, static_cast<std::size_t>((width + 2.0 * Gap) / (column + 2.0 * Gap)));
}

std::size_t
RowsIn(double height, double pitch)
{
  return static_cast<std::size_t>(std::max(0.0, (height - HeadingHeight) / pitch));
}

/** Places beside and under each other in an area, with room for a caption under each. */
std::vector<Rectangle>
Grid(const Rectangle & area, std::size_t count, std::size_t columns, double height)
{
  const double width = (area.width - Gap * static_cast<double>(columns - 1)) / static_cast<double>(columns);
  std::vector<Rectangle> places;
  for (std::size_t i = 0; i < count; ++i)
  {
    places.push_back({ area.left + static_cast<double>(i % columns) * (width + Gap),
                       area.top + static_cast<double>(i / columns) * (height + CaptionHeight + 0.5 * Gap),
                       width,
                       height });
  }
  return places;
}

/** The width of the letters and names at each side of a view. */
double
RoomBeside(const Sheet & s)
{
  if (!s.hasNames)
  {
    return RoomForLetters;
  }
  std::vector<PointedName> names;
  for (const LegendRow & row : s.rows)
  {
    names.push_back({ row.name });
  }
  TextStyle style;
  style.size = PointsOfPictures * s.pixelsPerInch / 72.0;
  Rectangle scene;
  TakeNameColumns(Drawing(1, 1), names, style, std::numeric_limits<double>::infinity(), scene);
  return RoomForLetters + scene.left * 25.4 / s.pixelsPerInch;
}

/** The height of a view whose scene is as wide as letters and names leave room. */
double
HeightFor(double width, double beside, const Sheet & s)
{
  const double height = s.viewAspect * std::max(0.0, width - 2.0 * beside) + 2.0 * RoomForLetters;
  return std::max(height, s.hasNames ? SmallestViewWithNames : 0.0);
}

/** The width of the scene in a view. */
double
SceneWidthIn(double width, double height, double beside, double aspect)
{
  return std::min(width - 2.0 * beside, (height - 2.0 * RoomForLetters) / aspect);
}

/** The width of the bar of colours; 0 without one. */
double
RoomForBar(const Sheet & s)
{
  constexpr double millimetresPerInch = 25.4;
  TextStyle style;
  style.size = PointsOfPictures * s.pixelsPerInch / 72.0;
  return s.scale ? FitColourBar(Drawing(1, 1), *s.scale, style).width * millimetresPerInch / s.pixelsPerInch : 0.0;
}

/** Places the views in one row or two at the top of an area. Returns the bottom edge of the views and captions. */
double
PlaceViews(const Sheet & s, const Rectangle & area, std::vector<Rectangle> & places)
{
  const std::size_t count = s.views.size();
  if (count == 0)
  {
    return area.top;
  }
  const double available = area.height - CaptionHeight - Gap;
  const double beside = RoomBeside(s);
  const double width = (area.width - Gap * 3.0) / 4.0;
  const double height = std::max(SmallestView, std::min(available, HeightFor(width, beside, s)));
  const double halfWidth = (area.width - Gap) / 2.0;
  const double halfHeight = std::min(0.5 * (available - CaptionHeight - 0.5 * Gap), HeightFor(halfWidth, beside, s));
  const double scale = SceneWidthIn(width, height, beside, s.viewAspect);
  const double halfScale = SceneWidthIn(halfWidth, halfHeight, beside, s.viewAspect);
  const bool isOneRow = count < 3 || PreferenceOfOneRow * scale >= halfScale;
  places = isOneRow ? Grid(area, count, std::max<std::size_t>(count, 2), height) : Grid(area, count, 2, halfHeight);
  return places.back().Bottom() + CaptionHeight + Gap;
}

/** The height of square places beside each other. */
double
SliceHeight(double width)
{
  return (width - 2.0 * Gap) / 3.0;
}

/** Places beside each other for slices of one scale, with room for letters about each; square places if the sizes of
 * slices are not known. The scale is in mm of paper per mm. The row is as high as preferred, or higher where slices
 * would be too small. Returns its height. */
double
PlaceSlices(const Sheet & s, const Rectangle & area, double preferred, SheetPlaces & places)
{
  const bool hasSizes = std::all_of(s.slices.begin(), s.slices.end(), [](const SheetPicture & slice) {
    return slice.width > 0.0 && slice.height > 0.0;
  });
  if (!hasSizes || s.slices.empty())
  {
    places.slices = Grid(area, s.slices.size(), 3, SliceHeight(area.width));
    return s.slices.empty() ? 0.0 : SliceHeight(area.width);
  }
  double widths = 0.0;
  double highest = 0.0;
  double narrowest = s.slices.front().width;
  for (const SheetPicture & slice : s.slices)
  {
    widths += slice.width;
    narrowest = std::min(narrowest, slice.width);
    highest = std::max(highest, slice.height);
  }
  const auto count = static_cast<double>(s.slices.size());
  const double free = area.width - Gap * (count - 1.0) - 2.0 * RoomForLetters * count;
  const auto scaleOfHeight = [highest](double height) { return (height - 2.0 * RoomForLetters) / highest; };
  const double ofHeight = scaleOfHeight(std::max(preferred, SliceHeight(area.width)));
  const double smallest = std::min(SmallestSlice / narrowest, scaleOfHeight(area.height));
  const double ofWidth = free / widths;
  const double ofSquares =
    (SliceHeight(area.width) - 2.0 * RoomForLetters) * count / widths; // one or two are no larger
  places.sliceScale = std::min({ std::max(ofHeight, smallest), ofWidth, ofSquares });
  const double beside = (std::min(ofWidth, ofSquares) - places.sliceScale) * widths / count;
  double left = area.left;
  for (const SheetPicture & slice : s.slices)
  {
    const double width = places.sliceScale * slice.width + 2.0 * RoomForLetters + beside;
    places.slices.push_back({ left, area.top, width, places.sliceScale * slice.height + 2.0 * RoomForLetters });
    left += width + Gap;
  }
  return places.sliceScale * highest + 2.0 * RoomForLetters;
}

/** Views over slices. Returns the bottom edge.
 * \param rows of views of the usual height, which the slices leave room for if they can */
double
PlacePictures(const Sheet & s, const Rectangle & area, int rows, SheetPlaces & places)
{
  const double row = s.views.empty() ? 0.0 : UsualView + CaptionHeight + Gap;
  const Rectangle largest{ area.left, area.top, area.width, area.height - row - CaptionHeight - Gap };
  const double height = PlaceSlices(s, largest, largest.height - (rows - 1) * row, places);
  const double slices = s.slices.empty() ? 0.0 : height + CaptionHeight + Gap;
  const double bar = RoomForBar(s);
  const double beside = bar > 0.0 ? bar + Gap : 0.0;
  const double top = PlaceViews(s, { area.left, area.top, area.width - beside, area.height - slices }, places.views);
  places.bar = { area.Right() - bar, area.top, bar, top - area.top - CaptionHeight - Gap };
  for (Rectangle & place : places.slices)
  {
    place.top += top - area.top;
  }
  return top + slices;
}

/** The height of each line of provenance in a column. */
std::vector<double>
MeasureProvenance(const Sheet & s, double width, double millimetre)
{
  const Drawing measuring(1, 1);
  TextStyle style;
  style.size = millimetre * ProvenanceText; // as it is drawn, because widths of letters are rounded
  std::vector<double> heights;
  for (const std::string & line : s.provenance)
  {
    const auto [name, value] = SplitProvenance(line);
    const double indent = name.empty() ? 0.0 : ProvenanceIndent;
    const double height = measuring.HeightOf(value, 0.99 * millimetre * (width - indent), style);
    heights.push_back(height / millimetre + ProvenanceSpace);
  }
  return heights;
}

/** Divides the lines into columns. Returns the height of the higher column. */
double
DivideProvenance(std::size_t columns, SheetPlan & plan)
{
  const std::vector<double> & heights = plan.provenanceHeights;
  const double total = std::accumulate(heights.begin(), heights.end(), 0.0);
  double first = 0.0;
  plan.provenanceRows = 0;
  while (first < total / static_cast<double>(columns) - 1e-9)
  {
    first += heights[plan.provenanceRows++];
  }
  return heights.empty() ? 0.0 : HeadingHeight + std::max(first, total - first);
}

/** Pictures on the first page; table, and provenance under it, on further ones. */
void
PlanApart(const Sheet & s, SheetPlan & plan)
{
  const Rectangle & content = plan.content;
  plan.isTableApart = true;
  plan.provenanceHeights = MeasureProvenance(s, 0.5 * content.width - Gap, plan.millimetre);
  const double provenance = DivideProvenance(2, plan);
  plan.provenance = { content.left, content.Bottom() - provenance, content.width, provenance };
  PlacePictures(s, content, s.views.size() > 2 ? 2 : 1, plan.places);
}

/** Table under the pictures, provenance beside it when the table is short, else under it. */
void
PlanPortrait(const Sheet & s, SheetPlan & plan)
{
  const Rectangle & content = plan.content;
  const double half = 0.5 * content.width - Gap;
  const bool isBeside = s.rows.size() <= RowsBesideProvenance && WidthOfColumn(s) <= half;
  plan.first.columns = isBeside ? 1 : CountColumns(content.width, s);
  plan.provenanceHeights = MeasureProvenance(s, half, plan.millimetre);
  const double provenance = DivideProvenance(isBeside ? 1 : 2, plan);
  const double rows = static_cast<double>(DivideUp(plan.lines.size(), plan.first.columns));
  double table = s.rows.empty() ? 0.0 : HeadingHeight + RowPitch * rows;
  if (table > WideTableShare * content.height)
  {
    table = std::min(HeadingHeight + TightRowPitch * rows, LargestTableShare * content.height);
  }
  const double below = isBeside ? std::max(table, provenance) : provenance + Gap + table;
  const double bottom =
    PlacePictures(s, { content.left, content.top, content.width, content.height - below }, 1, plan.places);
  const double width = isBeside ? half : content.width;
  plan.provenance = isBeside ? Rectangle{ content.Right() - half, bottom, half, provenance }
                             : Rectangle{ content.left, content.Bottom() - provenance, content.width, provenance };
  const double end = isBeside ? content.Bottom() : plan.provenance.top - Gap;
  plan.first.area = { content.left, bottom, width, end - bottom };
}

/** Table and provenance at the right of the pictures. */
void
PlanLandscape(const Sheet & s, SheetPlan & plan)
{
  const Rectangle & content = plan.content;
  const double width = PictureShare * content.width;
  PlacePictures(s, { content.left, content.top, width, content.height }, 1, plan.places);
  const double left = content.left + width + 2.0 * Gap;
  plan.provenanceHeights = MeasureProvenance(s, content.Right() - left, plan.millimetre);
  const double provenance = DivideProvenance(1, plan);
  plan.provenance = { left, content.Bottom() - provenance, content.Right() - left, provenance };
  plan.first.area = { left, content.top, plan.provenance.width, content.height - provenance - Gap };
  plan.first.columns = CountColumns(plan.first.area.width, s);
}

void
Scale(Rectangle & r, double factor)
{
  // whole pixels, so that pictures of the place's size are copied
  const double right = std::round(factor * r.Right());
  const double bottom = std::round(factor * r.Bottom());
  r.left = std::round(factor * r.left);
  r.top = std::round(factor * r.top);
  r.width = right - r.left;
  r.height = bottom - r.top;
}

void
ScaleToPixels(SheetPlan & plan)
{
  for (auto * const rectangles : { &plan.places.views, &plan.places.slices })
  {
    for (Rectangle & rectangle : *rectangles)
    {
      Scale(rectangle, plan.millimetre);
    }
  }
  for (Rectangle * const r :
       { &plan.content, &plan.first.area, &plan.further.area, &plan.provenance, &plan.places.bar })
  {
    Scale(*r, plan.millimetre);
  }
  for (double & height : plan.provenanceHeights)
  {
    height *= plan.millimetre;
  }
  plan.places.sliceScale *= plan.millimetre;
  plan.rowPitch *= plan.millimetre;
  plan.tableText = RowTextShare * plan.rowPitch;
}

} // namespace

std::pair<std::string, std::string>
SplitProvenance(const std::string & line)
{
  const std::size_t colon = line.find(": ");
  return colon == std::string::npos ? std::pair(std::string(), line)
                                    : std::pair(line.substr(0, colon), line.substr(colon + 2));
}

bool
HasFigure(const std::vector<LegendRow> & rows, std::optional<double> LegendRow::*figure)
{
  return std::any_of(rows.begin(), rows.end(), [figure](const LegendRow & row) { return (row.*figure).has_value(); });
}

SheetPlan
PlanSheet(const Sheet & s)
{
  if (s.views.size() > 4 || s.slices.size() > 3)
  {
    throw Failure(FailureKind::Usage, "A sheet has places for 4 views and 3 slices; leave out the others.");
  }
  SheetPlan plan;
  plan.millimetre = s.pixelsPerInch / 25.4;
  const double width = s.isLandscape ? LongSide : ShortSide;
  const double height = s.isLandscape ? ShortSide : LongSide;
  plan.places.width = static_cast<int>(std::lround(width * plan.millimetre));
  plan.places.height = static_cast<int>(std::lround(height * plan.millimetre));
  const double top = TopMargin + TitleHeight;
  plan.content = { SideMargin, top, width - 2.0 * SideMargin, height - top - FooterHeight };
  plan.lines = GroupLegend(s.rows);
  s.isLandscape                       ? PlanLandscape(s, plan)
  : s.rows.size() >= RowsOfTableApart ? PlanApart(s, plan)
                                      : PlanPortrait(s, plan);

  plan.further.area = plan.content;
  plan.further.area.height -= plan.isTableApart ? plan.provenance.height + Gap : 0.0;
  plan.further.columns = CountColumns(plan.content.width, s);
  const TableArea & table = plan.isTableApart ? plan.further : plan.first;
  const bool fits = table.columns * RowsIn(table.area.height, RowPitch) >= plan.lines.size();
  plan.rowPitch = fits ? RowPitch : TightRowPitch;
  plan.first.rows = RowsIn(plan.first.area.height, plan.rowPitch);
  plan.further.rows = RowsIn(plan.further.area.height, plan.rowPitch);
  ScaleToPixels(plan);
  return plan;
}

SheetPlaces
PlacesOn(const Sheet & sheet)
{
  return PlanSheet(sheet).places;
}

} // namespace rhombic
