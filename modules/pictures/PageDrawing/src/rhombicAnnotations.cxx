#include "rhombicAnnotations.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

constexpr double TextShare = 0.018;     // of the picture's shorter side
constexpr double SmallestText = 11.0;   // pixels
constexpr double LegendShare = 0.4;     // of the picture's width, at most
constexpr double LegendRowPitch = 1.45; // the following are multiples of the text's size
constexpr double LongestName = 18.0;
constexpr double LetterSize = 1.5;
constexpr double FurtherLetterSize = 1.05;
constexpr double TitleSize = 1.35;
constexpr double FootnoteSize = 0.75;
constexpr double FigureSize = 5.5;
constexpr double OutlineWidth = 0.107;
constexpr double BarThickness = 0.16;
constexpr double BarShare = 0.3; // of the picture's width, at most

/** The inks of a picture's annotations. */
TextStyle
StyleOn(const Ink & background, double size)
{
  TextStyle style;
  style.size = size;
  style.ink = InkOn(background);
  const double opposite = style.ink.colour[0] < 0.5 ? 1.0 : 0.0;
  style.halo = { { opposite, opposite, opposite }, 0.7 };
  return style;
}

/** A legend's text size and columns, and the number of its rows that are shown. */
struct LegendLayout
{
  double size = 0.0;
  double nameWidth = 0.0;
  double volumeWidth = 0.0;
  std::size_t rows = 0; ///< in a column
  std::size_t columns = 0;
  std::size_t shown = 0; ///< rows of the legend; the last line counts the others

  double
  ColumnWidth() const
  {
    return 1.3 * size + nameWidth + (volumeWidth > 0.0 ? size + volumeWidth : 0.0);
  }
  double
  Width() const
  {
    return columns == 0 ? 0.0 : static_cast<double>(columns) * (ColumnWidth() + 1.5 * size) - 1.5 * size;
  }
};

LegendLayout
FitLegend(const Drawing & drawing,
          const std::vector<LegendRow> & legend,
          const TextStyle & style,
          const Rectangle & area)
{
  LegendLayout layout;
  if (legend.empty())
  {
    return layout;
  }
  double nameWidth = 0.0; // in multiples of the size
  double volumeWidth = 0.0;
  for (const LegendRow & row : legend)
  {
    nameWidth = std::max(nameWidth, drawing.WidthOf(row.name, style) / style.size);
    const double width = row.volume ? drawing.WidthOf(FormatVolume(*row.volume) + " ml", style) / style.size : 0.0;
    volumeWidth = std::max(volumeWidth, width);
  }
  nameWidth = std::min(nameWidth, LongestName);
  const double smallest = std::max(0.5 * style.size, std::min(style.size, 9.0));
  for (layout.size = style.size;; layout.size = std::max(0.97 * layout.size, smallest))
  {
    layout.nameWidth = 1.01 * nameWidth * layout.size;
    layout.volumeWidth = volumeWidth * layout.size;
    layout.rows = std::max<std::size_t>(1, static_cast<std::size_t>(area.height / (LegendRowPitch * layout.size)));
    layout.columns = (legend.size() + layout.rows - 1) / layout.rows;
    layout.shown = legend.size();
    if (layout.Width() <= area.width || layout.size <= smallest)
    {
      break;
    }
  }
  while (layout.columns > 1 && layout.Width() > area.width)
  {
    --layout.columns;
  }
  if (legend.size() > layout.columns * layout.rows)
  {
    layout.shown = layout.columns * layout.rows - 1;
  }
  return layout;
}

/** Where the annotations of a picture go. */
struct Arrangement
{
  TextStyle text;
  double padding = 0.0;
  double titleHeight = 0.0;
  double footnoteHeight = 0.0;
  double letterWidth = 0.0; ///< of the wider of left and right
  Rectangle scene;          ///< the part of the picture without annotations
  Rectangle legendArea;
  LegendLayout legend;
};

double
WidthOfLetters(const Drawing & drawing, const std::string & letters, TextStyle style)
{
  const double size = style.size;
  style.bold = true;
  style.size = LetterSize * size;
  const double first = drawing.WidthOf(letters.substr(0, 1), style);
  style.size = FurtherLetterSize * size;
  return first + (letters.size() > 1 ? drawing.WidthOf(letters.substr(1), style) : 0.0);
}

TextStyle
FootnoteStyle(TextStyle style)
{
  style.size *= FootnoteSize;
  style.ink.opacity *= 0.8;
  return style;
}

Arrangement
Arrange(const Drawing & drawing, const Rectangle & place, const ViewFrame & frame, const Annotations & annotations)
{
  Arrangement a;
  const double size = annotations.textSize > 0.0
                        ? annotations.textSize
                        : std::max(TextShare * std::min(place.width, place.height), SmallestText);
  a.text = StyleOn(annotations.background, size);
  a.padding = 0.9 * size;
  a.titleHeight = annotations.title.empty() ? 0.0 : (TitleSize + 0.7) * size;
  if (!annotations.footnote.empty())
  {
    double height = 0.0;
    for (const std::string & line : Split(annotations.footnote, "\n"))
    {
      height += drawing.HeightOf(line, place.width - 2.0 * a.padding, FootnoteStyle(a.text));
    }
    a.footnoteHeight = height + 0.5 * size;
  }
  const EdgeLetters letters = EdgeLettersOf(frame);
  a.letterWidth =
    std::max(WidthOfLetters(drawing, letters.left, a.text), WidthOfLetters(drawing, letters.right, a.text));
  const double top = place.top + a.padding + a.titleHeight;
  const double bottom = place.Bottom() - a.padding - a.footnoteHeight;
  a.legendArea = { 0.0, top, LegendShare * place.width - a.padding, bottom - top };
  a.legend = FitLegend(drawing, annotations.legend, a.text, a.legendArea);
  a.legendArea.width = a.legend.Width();
  a.legendArea.left = place.Right() - a.padding - a.legendArea.width;

  const double side = annotations.letters ? a.letterWidth + 1.6 * a.padding : 0.0;
  const double above = annotations.letters ? (LetterSize + 0.4) * size : 0.0;
  const double below = std::max(above, annotations.scaleBar ? 1.9 * size : 0.0);
  const double right = a.legend.columns > 0 ? a.legendArea.left - a.padding : place.Right();
  const bool isTopFree = a.titleHeight == 0.0 && above == 0.0;
  const bool isBottomFree = a.footnoteHeight == 0.0 && below == 0.0;
  a.scene.left = place.left + side;
  a.scene.width = right - side - a.scene.left;
  a.scene.top = isTopFree ? place.top : top + above;
  a.scene.height = (isBottomFree ? place.Bottom() : bottom - below) - a.scene.top;
  return a;
}

/** \a scale enlarges the picture's pixels to those of the drawing. */
void
DrawOutlines(Drawing & drawing,
             const Rectangle & place,
             double scale,
             const std::vector<ColouredOutline> & outlines,
             double textSize)
{
  LineStyle style;
  style.width = OutlineWidth * textSize;
  style.halo = { { 0.0, 0.0, 0.0 }, 0.35 };
  style.haloWidth = style.width / 3.0;
  drawing.Clip(place);
  for (const ColouredOutline & outline : outlines)
  {
    std::vector<PicturePosition> points = outline.points;
    for (PicturePosition & point : points)
    {
      point = { place.left + scale * point.x, place.top + scale * point.y };
    }
    style.ink = { outline.colour };
    drawing.Line(points, style, outline.isClosed);
  }
  drawing.Unclip();
}

/** Draws letters, the first one large, about a position: \a share 0 with their left end there, 0.5 their middle, 1
 * their right end. */
void
DrawLetters(Drawing & drawing, const std::string & letters, PicturePosition baseline, double share, TextStyle style)
{
  const double size = style.size;
  baseline.x -= share * WidthOfLetters(drawing, letters, style);
  style.bold = true;
  style.size = LetterSize * size;
  drawing.Text(letters.substr(0, 1), baseline, style);
  baseline.x += drawing.WidthOf(letters.substr(0, 1), style);
  style.size = FurtherLetterSize * size;
  drawing.Text(letters.substr(1), baseline, style);
}

void
DrawEdgeLetters(Drawing & drawing, const Rectangle & place, const ViewFrame & frame, const Arrangement & a)
{
  const EdgeLetters letters = EdgeLettersOf(frame);
  const double capitals = 0.73 * LetterSize * a.text.size;
  const double right = a.legend.columns > 0 ? a.legendArea.left - a.padding : place.Right() - a.padding;
  const double x = a.scene.left + 0.5 * a.scene.width;
  const double y = a.scene.top + 0.5 * (a.scene.height + capitals);
  DrawLetters(drawing, letters.left, { place.left + a.padding, y }, 0.0, a.text);
  DrawLetters(drawing, letters.right, { right, y }, 1.0, a.text);
  DrawLetters(drawing, letters.top, { x, place.top + a.padding + a.titleHeight + capitals }, 0.5, a.text);
  DrawLetters(drawing, letters.bottom, { x, place.Bottom() - a.padding - a.footnoteHeight }, 0.5, a.text);
}

/** The bar from \a left upwards from \a bottom, with its length above it. */
void
DrawScaleBar(Drawing & drawing, double left, double bottom, double pixelSize, double longest, const TextStyle & style)
{
  const double millimetres = ScaleBarLength(longest * pixelSize);
  const double length = millimetres / pixelSize;
  const double thickness = std::max(2.0, std::round(BarThickness * style.size));
  const Rectangle bar{ std::round(left), std::round(bottom) - thickness, length, thickness };
  const double tick = 2.0 * thickness;
  const std::vector<Rectangle> parts{ bar,
                                      { bar.left, bar.top - tick, 0.75 * thickness, tick },
                                      { bar.Right() - 0.75 * thickness, bar.top - tick, 0.75 * thickness, tick } };
  for (const Rectangle & part : parts)
  {
    drawing.Fill(part.Inset(-0.5 * thickness), style.halo);
  }
  for (const Rectangle & part : parts)
  {
    drawing.Fill(part, style.ink);
  }
  const std::string label = FormatLength(millimetres);
  const double inset = std::max(0.0, 0.5 * (length - drawing.WidthOf(label, style)));
  drawing.Text(label, { bar.left + inset, bar.top - thickness - 0.3 * style.size }, style);
}

void
DrawLegend(Drawing & drawing, const std::vector<LegendRow> & legend, const Arrangement & a)
{
  const LegendLayout & layout = a.legend;
  TextStyle name = a.text;
  name.size = layout.size;
  TextStyle volume = name;
  volume.alignment = Alignment::Right;
  name.largestWidth = layout.nameWidth;
  for (std::size_t i = 0; i < std::min(legend.size(), layout.shown + 1); ++i)
  {
    const double x =
      a.legendArea.left + static_cast<double>(i / layout.rows) * (layout.ColumnWidth() + 1.5 * layout.size);
    const double y = a.legendArea.top + (static_cast<double>(i % layout.rows) + 0.5) * LegendRowPitch * layout.size;
    if (i == layout.shown)
    {
      drawing.TextAbout("and " + std::to_string(legend.size() - layout.shown) + " more", { x, y }, name);
      return;
    }
    const Rectangle swatch{ x, y - 0.42 * layout.size, 0.84 * layout.size, 0.84 * layout.size };
    drawing.Fill(swatch.Inset(-0.07 * layout.size), a.text.halo, 0.2 * layout.size);
    drawing.Fill(swatch, { legend[i].colour }, 0.15 * layout.size);
    drawing.TextAbout(legend[i].name, { x + 1.3 * layout.size, y }, name);
    if (legend[i].volume)
    {
      drawing.TextAbout(FormatVolume(*legend[i].volume) + " ml", { x + layout.ColumnWidth(), y }, volume);
    }
  }
}

void
DrawTitle(Drawing & drawing, const Rectangle & place, const std::string & title, const Arrangement & a)
{
  TextStyle style = a.text;
  style.size *= TitleSize;
  style.bold = true;
  style.largestWidth = place.width - 2.0 * a.padding;
  drawing.Text(title, { place.left + a.padding, place.top + a.padding + 0.8 * style.size }, style);
}

void
DrawFootnote(Drawing & drawing, const Rectangle & place, const std::string & footnote, const Arrangement & a)
{
  double y = place.Bottom() - a.padding - a.footnoteHeight + 0.5 * a.text.size;
  for (const std::string & line : Split(footnote, "\n"))
  {
    y += drawing.Paragraph(line, { place.left + a.padding, y }, place.width - 2.0 * a.padding, FootnoteStyle(a.text));
  }
}

} // namespace

Margins
MarginsOf(const Annotations & annotations, int width, int height, const ViewFrame & frame)
{
  Drawing measuring(1, 1);
  const Rectangle place{ 0.0, 0.0, static_cast<double>(width), static_cast<double>(height) };
  const Rectangle scene = Arrange(measuring, place, frame, annotations).scene;
  return { scene.left, place.width - scene.Right(), scene.top, place.height - scene.Bottom() };
}

void
DrawAnnotations(Drawing & drawing,
                const Rectangle & place,
                const Projection & projection,
                const Annotations & annotations)
{
  if (projection.width < 1 || projection.height < 1 || !(projection.pixelSize > 0.0))
  {
    throw Failure(FailureKind::Internal, "A picture's projection has no size; set width, height and pixelSize.");
  }
  const Arrangement a = Arrange(drawing, place, projection.frame, annotations);
  const double bottom = place.Bottom() - a.padding - a.footnoteHeight;
  DrawOutlines(drawing, place, place.width / projection.width, annotations.outlines, a.text.size);
  if (annotations.figure)
  {
    const double size = FigureSize * a.text.size;
    const double right = a.legend.columns > 0 ? a.legendArea.left - a.padding : place.Right() - 0.6 * a.padding;
    DrawOrientationFigure(drawing, { right - size, bottom - size, size, size }, projection.frame, a.text.halo);
  }
  if (annotations.letters)
  {
    DrawEdgeLetters(drawing, place, projection.frame, a);
  }
  if (annotations.scaleBar)
  {
    const double pixelSize = projection.pixelSize * projection.width / place.width;
    const double left = place.left + a.padding;
    const double letter = a.scene.left + 0.5 * a.scene.width - 2.0 * a.text.size; // at the bottom edge
    DrawScaleBar(drawing, left, bottom, pixelSize, std::min(BarShare * place.width, letter - left), a.text);
  }
  DrawLegend(drawing, annotations.legend, a);
  if (!annotations.title.empty())
  {
    DrawTitle(drawing, place, annotations.title, a);
  }
  if (!annotations.footnote.empty())
  {
    DrawFootnote(drawing, place, annotations.footnote, a);
  }
}

void
Annotate(Picture & picture, const Projection & projection, const Annotations & annotations)
{
  Drawing drawing(picture.width, picture.height);
  DrawAnnotations(drawing,
                  { 0.0, 0.0, static_cast<double>(picture.width), static_cast<double>(picture.height) },
                  projection,
                  annotations);
  drawing.PutOnto(picture);
}

double
ScaleBarLength(double longest)
{
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  for (const double step : { 10.0, 5.0, 2.0 }) // 10 where the logarithm was rounded down
  {
    if (step * power <= longest)
    {
      return step * power;
    }
  }
  return power;
}

std::string
FormatLength(double millimetres)
{
  return millimetres < 9.5 ? FormatNumber(millimetres) + " mm" : FormatNumber(0.1 * millimetres) + " cm";
}

std::string
FormatVolume(double millilitres)
{
  return std::abs(millilitres) < 0.05 && millilitres != 0.0 ? "<0.1" : FormatFixed(millilitres, 1);
}

} // namespace rhombic
