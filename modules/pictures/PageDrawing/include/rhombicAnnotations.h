#ifndef rhombicAnnotations_h
#define rhombicAnnotations_h

#include "rhombicColourScale.h"
#include "rhombicDrawing.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** One surface in a legend. */
struct LegendRow
{
  std::string name;
  Colour colour{ 0.8, 0.8, 0.8 };
  std::optional<double> volume;          ///< ml
  std::optional<double> area;            ///< cm2; on sheets
  std::optional<double> mean;            ///< mean value of the scan inside the surface; on sheets
  std::string group;                     ///< heading of long legends: "bones", "vessels"; empty: "other"
  std::vector<std::string> figures = {}; ///< on sheets with headings of their own, in place of volume, area and mean
};

/** A line over a picture, in its pixels: the edge of a surface in a slice. */
struct ColouredOutline
{
  std::vector<PicturePosition> points;
  Colour colour{ 1.0, 1.0, 1.0 };
  bool isClosed = true;
  bool hasHalo = true; ///< dark, on both sides of the line
};

/** A name beside a picture, with a line to the surface that has it. */
struct PointedName
{
  std::string name;
  Colour colour{ 1.0, 1.0, 1.0 };
  PicturePosition anchor{ 0.0, 0.0 }; ///< on the surface, in pixels of the picture
  double seen = 0.0;                  ///< share of the picture in which the surface is seen
  double left = 0.0;                  ///< ends of what is seen of the surface, in pixels of the picture
  double right = 0.0;
};

/** Where a PointedName is drawn, in pixels of the picture. */
struct PlacedName
{
  std::size_t number = 0;              ///< in Annotations::names
  Rectangle box;                       ///< of the name, which is shortened if it is longer
  bool isLeft = false;                 ///< of the scene
  std::array<PicturePosition, 3> line; ///< from the anchor to the height of the name, and to the name
};

/** The letters, bars and lines that are drawn over a picture. */
struct Annotations
{
  bool letters = true;              ///< the anatomical directions at the four edges
  bool scaleBar = true;             ///< at the bottom left
  bool figure = true;               ///< a small human figure as the view sees it, at the bottom right
  std::string title;                ///< one line at the top left
  std::string footnote;             ///< at the bottom left, small; lines end with \n
  std::vector<LegendRow> legend;    ///< names and volumes in a column at the right
  std::optional<ColourScale> scale; ///< a bar of colours and numbers in a column at the right, in place of the legend
  std::vector<ColouredOutline> outlines;
  std::vector<PointedName> names; ///< in columns at both sides of what they name; of too many, those that are seen most
  Ink background{ { 0.0, 0.0, 0.0 } }; ///< of the picture: text is white on a dark picture, else black
  double textSize = 0.0;               ///< pixels; 0: 1.8 % of the picture's shorter side, at least 11
};

/** The pixels that the annotations of a picture need at its edges. The figure needs none: it covers a corner. The
 * column of the legend takes at most a fifth of the width. */
Margins
MarginsOf(const Annotations & annotations, int width, int height, const ViewFrame & frame);

/** Where the names of a picture go, those at the left first, from top to bottom. Names do not overlap, and lines do not
 * cross. */
std::vector<PlacedName>
PlaceNames(const Projection & projection, const Annotations & annotations);

/** The colour of a line over a dark picture: of lightness 65 or more (CIE L*, D65), with the same hue and, as far as
 * sRGB has it, the same chroma. */
Colour
LineColourOnDark(const Colour & colour);

/** Draws the annotations of a picture that \a projection describes and that lies at \a place. The text of long legends
 * is smaller; the legend's last line counts rows that have no place. Outlines have dark halos. */
void
DrawAnnotations(Drawing & drawing,
                const Rectangle & place,
                const Projection & projection,
                const Annotations & annotations);

/** Draws annotations over a picture of the projection's size. The column of the legend gets the background, whatever
 * the picture has there. */
void
Annotate(Picture & picture, const Projection & projection, const Annotations & annotations);

/** Draws a standing human figure as a view sees it, in a square place. The face is light, so that front and back
 * differ. */
void
DrawOrientationFigure(Drawing & drawing, const Rectangle & place, const ViewFrame & frame, const Ink & outline);

/** The length of a scale bar in mm: the largest of 1, 2 or 5 times a power of ten that is at most \a longest mm. */
double
ScaleBarLength(double longest);

/** "5 cm", "2 mm" or "0.5 mm". */
std::string
FormatLength(double millimetres);

/** Volumes of at least 0.05 with one decimal, smaller ones as "<0.1". */
std::string
FormatVolume(double millilitres);

} // namespace rhombic

#endif
