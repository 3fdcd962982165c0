#include "rhombicSheetPlan.h"

#include "rhombicColourBar.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

Ink
Grey(double brightness)
{
  return { { brightness, brightness, brightness }, 1.0 };
}

/** Draws the pages of a sheet, in the order of its functions. */
class SheetPainter
{
public:
  SheetPainter(const Sheet & sheet, Drawing & drawing)
    : m_Sheet(sheet)
    , m_Plan(PlanSheet(sheet))
    , m_Drawing(drawing)
  {}

  void
  DrawPages()
  {
    const std::size_t first = m_Plan.first.columns * m_Plan.first.rows;
    const std::size_t further = m_Plan.further.columns * m_Plan.further.rows;
    const std::size_t count = m_Plan.lines.size();
    m_Pages = 1 + (count > first ? (count - first + further - 1) / further : 0);
    BeginPage(1);
    DrawPictures(m_Sheet.views, m_Plan.places.views, m_Sheet.scaleBar, m_Sheet.scaleBar);
    if (m_Sheet.scale && !m_Sheet.views.empty())
    {
      const TextStyle style = TextOf(sheet::PointsOfPictures, m_Ink);
      const ColourBarLayout layout = FitColourBar(m_Drawing, *m_Sheet.scale, style);
      DrawColourBar(m_Drawing, *m_Sheet.scale, layout, m_Plan.places.bar, style);
    }
    const bool hasOneScale = m_Plan.places.sliceScale > 0.0;
    DrawPictures(m_Sheet.slices, m_Plan.places.slices, m_Sheet.scaleBar, m_Sheet.scaleBar && !hasOneScale);
    std::size_t drawn = DrawTable(0, m_Plan.first);
    if (!m_Plan.isTableApart)
    {
      DrawProvenance();
    }
    for (std::size_t page = 2; page <= m_Pages; ++page)
    {
      m_Drawing.NextPage();
      BeginPage(page);
      drawn = DrawTable(drawn, m_Plan.further);
      if (m_Plan.isTableApart && page == m_Pages)
      {
        DrawProvenance();
      }
    }
  }

private:
  /** A text whose size is given in points. */
  TextStyle
  TextOf(double points, const Ink & ink) const
  {
    TextStyle style;
    style.size = points * m_Point;
    style.ink = ink;
    return style;
  }

  double
  Millimetres(double length) const
  {
    return length * m_Plan.millimetre;
  }

  void
  Rule(double left, double right, double y, const Ink & ink)
  {
    LineStyle style;
    style.width = 0.5 * m_Point;
    style.ink = ink;
    m_Drawing.Line({ { left, y }, { right, y } }, style);
  }

  /** Paper, title and footer. */
  void
  BeginPage(std::size_t page)
  {
    const Rectangle & content = m_Plan.content;
    const double width = m_Plan.places.width;
    m_Drawing.Fill({ 0.0, 0.0, width, static_cast<double>(m_Plan.places.height) }, m_Paper);
    TextStyle subtitle = TextOf(8.5, m_Grey);
    subtitle.alignment = Alignment::Right;
    subtitle.largestWidth = 0.45 * content.width;
    const double used = m_Sheet.subtitle.empty() ? 0.0 : m_Drawing.WidthOf(m_Sheet.subtitle, subtitle) + Millimetres(6);
    TextStyle title = TextOf(page == 1 ? 16.0 : 11.0, m_Ink);
    title.bold = true;
    title.largestWidth = content.width - used;
    const double baseline = content.top - Millimetres(7.0);
    m_Drawing.Text(m_Sheet.title + (page > 1 ? " (continued)" : ""), { content.left, baseline }, title);
    m_Drawing.Text(m_Sheet.subtitle, { content.Right(), baseline }, subtitle);
    Rule(content.left, content.Right(), content.top - Millimetres(3.8), m_Ink);
    if (m_Pages > 1)
    {
      TextStyle number = TextOf(7.0, m_Grey);
      number.alignment = Alignment::Right;
      m_Drawing.Text(std::to_string(page) + " / " + std::to_string(m_Pages),
                     { content.Right(), content.Bottom() + Millimetres(6.5) },
                     number);
    }
  }

  void
  DrawPictures(const std::vector<SheetPicture> & pictures,
               const std::vector<Rectangle> & places,
               bool firstHasBar,
               bool othersHaveBars)
  {
    for (std::size_t i = 0; i < pictures.size(); ++i)
    {
      DrawPicture(pictures[i], places[i], i == 0 ? firstHasBar : othersHaveBars);
      DrawCaption(pictures[i], places[i]);
    }
  }

  void
  DrawPicture(const SheetPicture & picture, const Rectangle & place, bool hasBar)
  {
    if (picture.picture.pixels.empty())
    {
      return;
    }
    m_Drawing.Fill(place, picture.background);
    const double scale = std::min(place.width / picture.picture.width, place.height / picture.picture.height);
    const double width = scale * picture.picture.width;
    const double height = scale * picture.picture.height;
    const Rectangle fitted{
      place.left + 0.5 * (place.width - width), place.top + 0.5 * (place.height - height), width, height
    };
    m_Drawing.Place(picture.picture, fitted);
    Annotations annotations;
    annotations.letters = m_Sheet.letters;
    annotations.scaleBar = hasBar;
    annotations.figure = false;
    annotations.outlines = picture.outlines;
    annotations.names = picture.names;
    annotations.background = picture.background;
    annotations.textSize = sheet::PointsOfPictures * m_Point;
    DrawAnnotations(m_Drawing, fitted, picture.projection, annotations);
  }

  void
  DrawCaption(const SheetPicture & picture, const Rectangle & place)
  {
    TextStyle style = TextOf(7.5, m_Ink);
    style.largestWidth = place.width;
    const double baseline = place.Bottom() + Millimetres(3.6);
    m_Drawing.Text(picture.caption, { place.left, baseline }, style);
    const double used = m_Drawing.WidthOf(picture.caption, style) + Millimetres(2.0);
    style = TextOf(7.5, m_Grey);
    style.largestWidth = std::max(1.0, place.width - used);
    m_Drawing.Text(picture.position, { place.left + used, baseline }, style);
  }

  /** The rows of even columns, or some more, so that no column ends with a heading. */
  std::size_t
  RowsOfColumns(std::size_t begin, std::size_t end, const TableArea & table) const
  {
    const std::size_t even = (end - begin + table.columns - 1) / table.columns;
    for (std::size_t rows = even; rows > 0 && rows <= table.rows; ++rows)
    {
      bool isGood = true;
      for (std::size_t next = begin + rows; next < end; next += rows)
      {
        isGood = isGood && m_Plan.lines[next - 1].row != nullptr;
      }
      if (isGood)
      {
        return rows;
      }
    }
    return even;
  }

  /** Draws rows from \a begin in the columns of an area. Returns the first row that is left. */
  std::size_t
  DrawTable(std::size_t begin, const TableArea & table)
  {
    const std::size_t end = std::min(m_Plan.lines.size(), begin + table.columns * table.rows);
    const std::size_t columns = table.columns;
    const std::size_t rows = RowsOfColumns(begin, end, table);
    const double gap = 2.0 * Millimetres(sheet::Gap);
    const double width = (table.area.width - gap * static_cast<double>(columns - 1)) / static_cast<double>(columns);
    for (std::size_t column = 0; column < columns && begin + column * rows < end; ++column)
    {
      Rectangle place = table.area;
      place.left += static_cast<double>(column) * (width + gap);
      place.width = width;
      DrawTableHeading(place);
      for (std::size_t row = 0; row < rows && begin + column * rows + row < end; ++row)
      {
        place.top = table.area.top + Millimetres(sheet::HeadingHeight) + static_cast<double>(row) * m_Plan.rowPitch;
        DrawTableLine(m_Plan.lines[begin + column * rows + row], place);
      }
    }
    return end;
  }

  /** The figures of a row, one for each column of figures that any row has, or their headings without a row. */
  std::vector<std::string>
  FiguresOf(const LegendRow * row) const
  {
    if (!m_Sheet.headings.empty())
    {
      return row ? row->figures : m_Sheet.headings;
    }
    std::vector<std::string> figures;
    const auto add = [&](std::optional<double> LegendRow::*figure, const std::string & heading, bool isSize) {
      if (HasFigure(m_Sheet.rows, figure))
      {
        const std::optional<double> value = row ? row->*figure : std::nullopt;
        figures.push_back(!row ? heading : !value ? "\u2013" : isSize ? FormatVolume(*value) : FormatFixed(*value, 1));
      }
    };
    add(&LegendRow::volume, "volume ml", true);
    add(&LegendRow::area, "area cm\u00b2", true);
    add(&LegendRow::mean, m_Sheet.meanUnit.empty() ? "mean" : "mean " + m_Sheet.meanUnit, false);
    return figures;
  }

  void
  DrawFigures(const std::vector<std::string> & figures, const Rectangle & place, double middle, TextStyle style)
  {
    style.alignment = Alignment::Right;
    style.largestWidth = Millimetres(sheet::FigureColumn - 1.0);
    for (std::size_t i = 0; i < figures.size(); ++i)
    {
      const double right =
        place.Right() - static_cast<double>(figures.size() - 1 - i) * Millimetres(sheet::FigureColumn);
      m_Drawing.TextAbout(figures[i], { right, middle }, style);
    }
  }

  void
  DrawTableHeading(const Rectangle & place)
  {
    const TextStyle style = TextOf(6.5, m_Grey);
    const double middle = place.top + 0.4 * Millimetres(sheet::HeadingHeight);
    m_Drawing.TextAbout("structure", { place.left, middle }, style);
    DrawFigures(FiguresOf(nullptr), place, middle, style);
    Rule(place.left, place.Right(), place.top + Millimetres(sheet::HeadingHeight), m_Grey);
  }

  void
  DrawTableLine(const LegendLine & line, const Rectangle & place)
  {
    if (line.row)
    {
      DrawTableRow(*line.row, place);
      return;
    }
    TextStyle style = TextOf(1.0, m_Grey);
    style.size = m_Plan.tableText;
    style.bold = true;
    m_Drawing.TextAbout(line.heading, { place.left, place.top + 0.55 * m_Plan.rowPitch }, style);
  }

  void
  DrawTableRow(const LegendRow & row, const Rectangle & place)
  {
    const double size = m_Plan.tableText;
    TextStyle style = TextOf(1.0, m_Ink);
    style.size = size;
    const double middle = place.top + 0.5 * m_Plan.rowPitch;
    const double swatch = 0.95 * size;
    m_Drawing.Fill({ place.left, middle - 0.5 * swatch, swatch, swatch }, { row.colour }, 0.18 * swatch);
    const std::vector<std::string> figures = FiguresOf(&row);
    DrawFigures(figures, place, middle, style);
    const double left = place.left + 1.6 * size;
    style.largestWidth = place.Right() - static_cast<double>(figures.size()) * Millimetres(sheet::FigureColumn) - left;
    m_Drawing.TextAbout(row.name, { left, middle }, style);
    Rule(place.left, place.Right(), place.top + m_Plan.rowPitch, m_Hairline);
  }

  /** Lines of a grey name and a value, in columns. */
  void
  DrawProvenance()
  {
    const std::vector<std::string> & lines = m_Sheet.provenance;
    if (lines.empty())
    {
      return;
    }
    const Rectangle & area = m_Plan.provenance;
    const double heading = Millimetres(sheet::HeadingHeight);
    m_Drawing.TextAbout("scan and method", { area.left, area.top + 0.4 * heading }, TextOf(6.5, m_Grey));
    Rule(area.left, area.Right(), area.top + heading, m_Grey);
    const double columnWidth = area.width / 2.0 - Millimetres(sheet::Gap);
    const double width = m_Plan.provenanceRows < lines.size() ? columnWidth : area.width;
    PicturePosition topLeft{ area.left, area.top + heading + Millimetres(sheet::ProvenanceSpace) };
    for (std::size_t i = 0; i < lines.size(); ++i)
    {
      if (i == m_Plan.provenanceRows)
      {
        topLeft = { area.Right() - width, area.top + heading + Millimetres(sheet::ProvenanceSpace) };
      }
      DrawProvenanceLine(lines[i], topLeft, width);
      topLeft.y += m_Plan.provenanceHeights[i];
    }
  }

  void
  DrawProvenanceLine(const std::string & line, const PicturePosition & topLeft, double width)
  {
    const auto [name, value] = SplitProvenance(line);
    const double indent = name.empty() ? 0.0 : Millimetres(sheet::ProvenanceIndent);
    TextStyle style = TextOf(1.0, m_Grey);
    style.size = Millimetres(sheet::ProvenanceText);
    m_Drawing.Paragraph(name, topLeft, indent, style);
    style.ink = m_Ink;
    m_Drawing.Paragraph(value, { topLeft.x + indent, topLeft.y }, width - indent, style);
  }

  const Sheet & m_Sheet;
  const SheetPlan m_Plan;
  const Ink m_Paper = PaperOf(m_Sheet);
  const Ink m_Ink = InkOn(m_Paper);
  const Ink m_Grey = m_Sheet.isDark ? Grey(0.62) : Grey(0.42);
  const Ink m_Hairline = m_Sheet.isDark ? Grey(0.27) : Grey(0.82);
  const double m_Point = m_Sheet.pixelsPerInch / 72.0; ///< 1/72 inch, in pixels
  Drawing & m_Drawing;
  std::size_t m_Pages = 1;
};

} // namespace

Ink
PaperOf(const Sheet & sheet)
{
  return sheet.isDark ? Grey(0.06) : Grey(1.0);
}

std::vector<Picture>
DrawSheet(const Sheet & sheet)
{
  const SheetPlaces places = PlacesOn(sheet);
  Drawing drawing(places.width, places.height);
  SheetPainter(sheet, drawing).DrawPages();
  return drawing.TakePictures(PaperOf(sheet));
}

PdfPages
DrawSheetPdf(const Sheet & sheet, const std::string & software)
{
  const SheetPlaces places = PlacesOn(sheet);
  Drawing drawing(places.width, places.height, sheet.pixelsPerInch, { sheet.title, software });
  SheetPainter(sheet, drawing).DrawPages();
  const std::size_t count = drawing.GetNumberOfPages();
  return { drawing.TakeDocument(), count };
}

} // namespace rhombic
