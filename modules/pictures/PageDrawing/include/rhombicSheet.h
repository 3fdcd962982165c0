#ifndef rhombicSheet_h
#define rhombicSheet_h

#include "rhombicAnnotations.h"

#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** One picture of a sheet. It may have more or fewer pixels than its place, into which it is fitted. */
struct SheetPicture
{
  Picture picture;
  Projection projection;               ///< of the picture, for letters and scale bar
  Ink background{ { 0.0, 0.0, 0.0 } }; ///< of the picture, for the colour of letters
  std::string caption;                 ///< "anterior", "axial"
  std::string position;                ///< beside the caption, grey: "z = -123.4 mm"
  double width = 0.0;                  ///< of a slice, in mm
  double height = 0.0;                 ///< of a slice, in mm
  std::vector<ColouredOutline> outlines;
  std::vector<PointedName> names; ///< beside the scene of a view
};

/** \class Sheet
 * \brief A4 pages about a segmentation: views, slices, a table of surfaces, and lines about their origin.
 *
 * A table of 20 rows or more begins on the second page, with the lines about the origin; in landscape one that is too
 * long for the first page goes on there. Long tables have headings of groups. Slices whose widths and heights are all
 * known have one scale, and the first has the scale bar of all. */
struct Sheet
{
  std::string title;
  std::string subtitle;
  std::vector<SheetPicture> views;  ///< up to 4, side by side or two by two, whichever shows the scene larger
  std::vector<SheetPicture> slices; ///< up to 3; in square places, if not all of their sizes are known
  double viewAspect = 1.3;          ///< height of the scene in the views, divided by its width
  std::vector<LegendRow> rows;
  std::vector<std::string> headings;   ///< of LegendRow::figures; empty: the rows have volume, area and mean
  std::string meanUnit;                ///< of LegendRow::mean: "HU"
  std::vector<std::string> provenance; ///< lines about scan, lattice and program; a colon ends the grey name of a value
  bool letters = true;                 ///< at the edges of the pictures
  bool scaleBar = true;                ///< in each view, and in slices
  bool hasNames = false;               ///< views have room for the names of the rows beside the scene
  bool isLandscape = false;
  bool isDark = false;
  double pixelsPerInch = 200.0;
  std::optional<ColourScale> scale; ///< of the surfaces in views; a bar at their right
};

/** Where a sheet's pictures go on its first page, in pixels. */
struct SheetPlaces
{
  int width = 0; ///< of all pages
  int height = 0;
  std::vector<Rectangle> views;
  std::vector<Rectangle> slices;
  double sliceScale = 0.0; ///< pixels per mm of all slices, each in the middle of its place; 0: each fits its place
  Rectangle bar;           ///< of Sheet::scale
};

/** The places of Sheet::views and Sheet::slices. All members of the sheet but the pictures' pixels decide about the
 * places: set these members first, then draw each picture as large as its place, or a multiple of that size. */
SheetPlaces
PlacesOn(const Sheet & sheet);

/** The colour of the sheet's paper: the best background for views. */
Ink
PaperOf(const Sheet & sheet);

/** The pages as pictures. Throws Failure(Usage) for more than 4 views or 3 slices. */
std::vector<Picture>
DrawSheet(const Sheet & sheet);

/** A PDF file's bytes, and its pages. */
struct PdfPages
{
  std::string bytes;
  std::size_t count = 0;
};

/** The pages as PDF, with text and lines that stay sharp, and all pixels of the pictures. */
PdfPages
DrawSheetPdf(const Sheet & sheet, const std::string & software);

} // namespace rhombic

#endif
