#include "rhombicAnnotations.h"

#include "rhombicColourBar.h"
#include "rhombicFailure.h"
#include "rhombicLegend.h"
#include "rhombicNameColumns.h"
#include "rhombicWording.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rhombic
{
namespace
{

constexpr double TextShare = 0.018;   // of the picture's shorter side
constexpr double SmallestText = 11.0; // pixels
constexpr double LegendShare = 0.2;   // of the picture's width, at most, with the padding
constexpr double LetterSize = 1.5;    // the following are multiples of the text's size
constexpr double FurtherLetterSize = 1.05;
constexpr double TitleSize = 1.35;
constexpr double FootnoteSize = 0.75;
constexpr double FigureSize = 5.5;
constexpr double OutlineWidth = 0.107;
constexpr double SmallestOutlineWidth = 2.0; // pixels
constexpr double OutlineHaloOpacity = 0.55;
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

/** Where the annotations of a picture go. */
struct Arrangement
{
  TextStyle text;
  double padding = 0.0;
  double titleHeight = 0.0;
  double footnoteHeight = 0.0;
  double letterWidth = 0.0; ///< of the wider of left and right
  Rectangle picture;        ///< the place without the legend's column
  Rectangle scene;          ///< the part of the picture without annotations
  NameColumns names;
  LegendLayout legend;
  ColourBarLayout bar;
  double top = 0.0;    ///< of the legend or bar
  double bottom = 0.0; ///< of the same
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
  double column = 0.0;
  if (annotations.scale)
  {
    a.bar = FitColourBar(drawing, *annotations.scale, a.text);
    column = a.bar.width + 2.0 * a.padding;
  }
  else
  {
    const double widest = LegendShare * place.width - 2.0 * a.padding;
    a.legend = FitLegend(drawing, annotations.legend, a.text, widest, bottom - top);
    column = a.legend.lines.empty() ? 0.0 : a.legend.Width() + 2.0 * a.padding;
  }
  a.picture = { place.left, place.top, place.width - column, place.height };
  a.top = top;
  a.bottom = bottom;

  const double side = annotations.letters ? a.letterWidth + 1.6 * a.padding : 0.0;
  const double above = annotations.letters ? (LetterSize + 0.4) * size : 0.0;
  const double below = std::max(above, annotations.scaleBar ? 1.9 * size : 0.0);
  const bool isTopFree = a.titleHeight == 0.0 && above == 0.0;
  const bool isBottomFree = a.footnoteHeight == 0.0 && below == 0.0;
  a.scene.left = place.left + side;
  a.scene.width = a.picture.Right() - side - a.scene.left;
  a.scene.top = isTopFree ? place.top : top + above;
  a.scene.height = (isBottomFree ? place.Bottom() : bottom - below) - a.scene.top;
  a.names = TakeNameColumns(drawing, annotations.names, a.text, place.width, a.scene);
  a.names.right.height -= annotations.figure ? FigureSize * size : 0.0;
  return a;
}

/** Draws the lines over the halos of all. \a scale enlarges the picture's pixels to those of the drawing. */
void
DrawOutlines(Drawing & drawing, const Arrangement & a, double scale, const std::vector<ColouredOutline> & outlines)
{
  const double width = std::max(SmallestOutlineWidth, OutlineWidth * a.text.size);
  drawing.Clip(a.picture);
  for (const bool isHalo : { true, false })
  {
    for (const ColouredOutline & outline : outlines)
    {
      if (isHalo && !outline.hasHalo)
      {
        continue;
      }
      std::vector<PicturePosition> points = outline.points;
      for (PicturePosition & point : points)
      {
        point = { a.picture.left + scale * point.x, a.picture.top + scale * point.y };
      }
      LineStyle style;
      style.width = isHalo ? 2.0 * width : width;
      style.ink = isHalo ? Ink{ { 0.0, 0.0, 0.0 }, OutlineHaloOpacity } : Ink{ outline.colour };
      drawing.Line(points, style, outline.isClosed);
    }
  }
  drawing.Unclip();
}

/** The names with anchors on the drawing. \a scale enlarges the picture's pixels to those of the drawing. */
std::vector<PointedName>
NamesOn(const Rectangle & place, double scale, std::vector<PointedName> names)
{
  for (PointedName & name : names)
  {
    name.anchor = { place.left + scale * name.anchor.x, place.top + scale * name.anchor.y };
    name.left = place.left + scale * name.left;
    name.right = place.left + scale * name.right;
  }
  return names;
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
  const double right = a.picture.Right() - a.padding;
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

/** Linear components of sRGB to and from CIE XYZ, relative to the white D65. */
constexpr double XYZOfRGB[3][3] = { { 0.4338892, 0.3762261, 0.1898847 },
                                    { 0.2126729, 0.7151522, 0.0721750 },
                                    { 0.0177567, 0.1094713, 0.8727720 } };
constexpr double RGBOfXYZ[3][3] = { { 3.0799327, -1.5371500, -0.5427816 },
                                    { -0.9212350, 1.8759900, 0.0452442 },
                                    { 0.0528898, -0.2040261, 1.1511366 } };

std::array<double, 3>
Multiply(const double (&matrix)[3][3], const std::array<double, 3> & vector)
{
  std::array<double, 3> product{};
  for (std::size_t row = 0; row < 3; ++row)
  {
    product[row] = matrix[row][0] * vector[0] + matrix[row][1] * vector[1] + matrix[row][2] * vector[2];
  }
  return product;
}

/** CIE L*, a* and b* of an sRGB colour. */
std::array<double, 3>
ToLab(const Colour & colour)
{
  std::array<double, 3> xyz =
    Multiply(XYZOfRGB, { SRGBToLinear(colour[0]), SRGBToLinear(colour[1]), SRGBToLinear(colour[2]) });
  for (double & component : xyz)
  {
    component = component > 216.0 / 24389.0 ? std::cbrt(component) : (24389.0 / 27.0 * component + 16.0) / 116.0;
  }
  return { 116.0 * xyz[1] - 16.0, 500.0 * (xyz[0] - xyz[1]), 200.0 * (xyz[1] - xyz[2]) };
}

/** Linear components, which may be out of range. */
Colour
FromLab(const std::array<double, 3> & lab)
{
  const double y = (lab[0] + 16.0) / 116.0;
  std::array<double, 3> xyz{ y + lab[1] / 500.0, y, y - lab[2] / 200.0 };
  for (double & component : xyz)
  {
    component =
      component > 6.0 / 29.0 ? component * component * component : (116.0 * component - 16.0) * 27.0 / 24389.0;
  }
  return Multiply(RGBOfXYZ, xyz);
}

bool
IsInSRGB(const Colour & linear)
{
  constexpr double rounding = 1e-4;
  return std::all_of(linear.begin(), linear.end(), [](double component) {
    return component >= -rounding && component <= 1.0 + rounding;
  });
}

/** Fills the columns from \a first on with a colour. */
void
EraseColumns(int first, const Ink & ink, Picture & picture)
{
  const auto bytes = ToBytes(ink.colour);
  const std::array<std::uint8_t, 4> pixel{ bytes[0], bytes[1], bytes[2], ToByte(ink.opacity) };
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = first; x < picture.width; ++x)
    {
      std::copy_n(pixel.begin(), picture.channels, picture.pixels.begin() + (picture.At(x, y) - picture.pixels.data()));
    }
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

std::vector<PlacedName>
PlaceNames(const Projection & projection, const Annotations & annotations)
{
  const Drawing measuring(1, 1);
  const Rectangle place{ 0.0, 0.0, static_cast<double>(projection.width), static_cast<double>(projection.height) };
  const Arrangement a = Arrange(measuring, place, projection.frame, annotations);
  return PlaceInColumns(measuring, annotations.names, a.names);
}

Colour
LineColourOnDark(const Colour & colour)
{
  constexpr double least = 65.1; // L*: components are rounded to bytes later
  constexpr int halvings = 20;
  const std::array<double, 3> lab = ToLab(colour);
  if (lab[0] >= least)
  {
    return colour;
  }
  double share = 1.0; // of the chroma, as much as there is in sRGB
  double none = 0.0;
  for (int n = 0; n < halvings && !IsInSRGB(FromLab({ least, share * lab[1], share * lab[2] })); ++n)
  {
    const double middle = 0.5 * (none + share);
    (IsInSRGB(FromLab({ least, middle * lab[1], middle * lab[2] })) ? none : share) = middle;
  }
  Colour line = FromLab({ least, share * lab[1], share * lab[2] });
  if (!IsInSRGB(line))
  {
    line = FromLab({ least, none * lab[1], none * lab[2] });
  }
  std::transform(line.begin(), line.end(), line.begin(), LinearToSRGB);
  return line;
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
  DrawOutlines(drawing, a, place.width / projection.width, annotations.outlines);
  const std::vector<PointedName> names = NamesOn(place, place.width / projection.width, annotations.names);
  DrawNames(drawing,
            names,
            PlaceInColumns(drawing, names, a.names),
            a.names.text,
            InkOn(annotations.background).colour[0] > 0.5);
  if (annotations.figure)
  {
    const double size = FigureSize * a.text.size;
    const double right = a.picture.Right() - 0.6 * a.padding;
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
  if (annotations.scale)
  {
    const Rectangle column{ a.picture.Right() + a.padding, a.top, a.bar.width, a.bottom - a.top };
    DrawColourBar(drawing, *annotations.scale, a.bar, column, a.text);
  }
  else
  {
    DrawLegend(drawing, a.legend, { a.picture.Right() + a.padding, a.top }, a.text);
  }
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
  const Rectangle place{ 0.0, 0.0, static_cast<double>(picture.width), static_cast<double>(picture.height) };
  const double end = Arrange(drawing, place, projection.frame, annotations).picture.Right();
  EraseColumns(static_cast<int>(std::ceil(end)), annotations.background, picture);
  DrawAnnotations(drawing, place, projection, annotations);
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
