#ifndef rhombicLegend_h
#define rhombicLegend_h

#include "rhombicAnnotations.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rhombic
{

/** A line of a legend or table: the heading of a group, or a row. */
struct LegendLine
{
  std::string heading;
  const LegendRow * row = nullptr; ///< null: a heading
};

/** The rows, which have to outlive the lines, in groups with headings where there are ten rows or more of several
 * groups. Groups are in the order of their first rows; rows without a group are the last, under "other". */
std::vector<LegendLine>
GroupLegend(const std::vector<LegendRow> & rows);

/** A legend's lines, the size of its text, and its columns. */
struct LegendLayout
{
  std::vector<LegendLine> lines;
  double size = 0.0;          ///< of the text, in pixels
  double nameWidth = 0.0;     ///< pixels
  double volumeWidth = 0.0;   ///< pixels; 0 without volumes
  bool shortensNames = false; ///< whether a name does not fit
  std::size_t shown = 0;      ///< lines that fit; the last of them counts the other rows if there are any

  /** In pixels; 0 without lines. */
  double
  Width() const;
};

/** Fits a legend into a width and height in pixels. The text becomes smaller first, to 0.42 of the style's size but not
 * below 9 pixels; then volumes are left out; then names are shortened, and rows left out. */
LegendLayout
FitLegend(const Drawing & drawing,
          const std::vector<LegendRow> & legend,
          const TextStyle & style,
          double largestWidth,
          double height);

/** Draws a legend from its top left corner. */
void
DrawLegend(Drawing & drawing, const LegendLayout & layout, const PicturePosition & topLeft, const TextStyle & style);

} // namespace rhombic

#endif
