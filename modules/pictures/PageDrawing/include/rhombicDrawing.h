#ifndef rhombicDrawing_h
#define rhombicDrawing_h

#include "rhombicPicture.h"
#include "rhombicProjection.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace rhombic
{

/** A colour that covers what is under it with an opacity from 0 (nothing is drawn) to 1. */
struct Ink
{
  Colour colour{ 0.0, 0.0, 0.0 };
  double opacity = 1.0;
};

/** Part of a page, in pixels. */
struct Rectangle
{
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;

  /** The right edge. */
  double
  Right() const
  {
    return left + width;
  }
  /** The lower edge. */
  double
  Bottom() const
  {
    return top + height;
  }
  /** Smaller by \a margin at each edge. */
  Rectangle
  Inset(double margin) const
  {
    return { left + margin, top + margin, width - 2.0 * margin, height - 2.0 * margin };
  }
};

/** Where a text lies about its position. */
enum class Alignment
{
  Left,
  Centre,
  Right
};

/** How a text looks. */
struct TextStyle
{
  double size = 16.0; ///< height of the font (its em) in pixels; capital letters have 0.73 of it
  Ink ink;
  Ink halo{ {}, 0.0 }; ///< around the letters, for contrast with any background
  bool bold = false;
  Alignment alignment = Alignment::Left;

  /** In pixels: wider text is set smaller, to three quarters, then shortened in the middle; 0: no limit. */
  double largestWidth = 0.0;
};

/** How a line looks. */
struct LineStyle
{
  double width = 1.0; ///< pixels
  Ink ink;
  Ink halo{ {}, 0.0 };    ///< on both sides of the line
  double haloWidth = 1.0; ///< pixels, on each side
};

/** The document information of a PDF. Empty strings are left out. */
struct PdfProperties
{
  std::string title;
  std::string software; ///< the program and its version
};

/** \class Drawing
 * \brief Text, lines and pictures, drawn by cairo and pango on transparent pages of one size: pictures, or pages of a
 * PDF or an SVG file with lines and text that stay sharp.
 *
 * Lengths are in pixels, positions in pixels from the outer corner of the page's top left pixel. Text is UTF-8 in the
 * font DejaVu Sans; letters that it lacks come from other installed fonts. The same calls give the same bytes on one
 * machine: files have no dates.
 *
 * Thread safety: one thread per object. */
class Drawing
{
public:
  /** Begins the first page of a drawing that becomes pictures. Throws Failure: Usage when a side is not 1 to 32767
   * pixels, Memory when there is too little, Display when there is no font. */
  Drawing(int width, int height);

  /** Begins the first page of a PDF, on which \a pixelsPerInch pixels make an inch. Throws as the constructor for
   * pictures does. */
  Drawing(int width, int height, double pixelsPerInch, const PdfProperties & properties);

  /** A drawing that becomes an SVG file of one page. An id in the file counts the drawings of the process. Throws as
   * the constructors do. */
  static Drawing
  ForSvg(int width, int height);

  ~Drawing();
  Drawing(Drawing &&) noexcept;
  Drawing &
  operator=(Drawing &&) noexcept;

  int
  GetWidth() const;

  /** Draws one line of text. \a baseline is on the line under its capital letters, at its left end, middle or right
   * end. Control characters become blanks. */
  void
  Text(const std::string & text, const PicturePosition & baseline, const TextStyle & style);

  /** Text() with capital letters whose middle is at \a middle. */
  void
  TextAbout(const std::string & text, const PicturePosition & middle, const TextStyle & style);

  /** The width of one line of text, in pixels, of at most TextStyle::largestWidth. */
  double
  WidthOf(const std::string & text, const TextStyle & style) const;

  /** Draws text broken into lines of at most \a width pixels, from \a topLeft. Returns its height in pixels. */
  double
  Paragraph(const std::string & text, const PicturePosition & topLeft, double width, const TextStyle & style);

  /** The height in pixels of a text that Paragraph() draws. */
  double
  HeightOf(const std::string & text, double width, const TextStyle & style) const;

  /** A line through points, with round corners. */
  void
  Line(const std::vector<PicturePosition> & points, const LineStyle & style, bool isClosed = false);

  /** The filled area inside a closed line. */
  void
  Polygon(const std::vector<PicturePosition> & points, const Ink & ink);

  /** The filled ellipse about \a centre with the half axes \a a and \a b, which need not be at right angles. */
  void
  Ellipse(const PicturePosition & centre, const PicturePosition & a, const PicturePosition & b, const Ink & ink);

  /** A filled rectangle, perhaps with round corners. */
  void
  Fill(const Rectangle & rectangle, const Ink & ink, double cornerRadius = 0.0);

  /** The rectangle's edges, inside of it. */
  void
  Frame(const Rectangle & rectangle, const LineStyle & style);

  /** A picture, filtered to the size of \a place. A PDF keeps all its pixels. */
  void
  Place(const Picture & picture, const Rectangle & place);

  /** Lines, polygons, text and pictures up to the matching Unclip() are drawn in \a rectangle alone. */
  void
  Clip(const Rectangle & rectangle);
  /** Ends Clip(). */
  void
  Unclip();

  /** Begins a new page. */
  void
  NextPage();

  /** The number of pages begun. */
  std::size_t
  GetNumberOfPages() const;

  /** Draws the last page over a picture of its size, with 3 or 4 channels. Not for PDF. */
  void
  PutOnto(Picture & picture) const;

  /** All pages, over \a paper: with 4 channels when that is not opaque. Ends the drawing. Not for PDF. */
  std::vector<Picture>
  TakePictures(const Ink & paper);

  /** The bytes of the PDF or SVG file; ends the drawing. */
  std::string
  TakeDocument();

private:
  struct Surface;
  explicit Drawing(std::unique_ptr<Surface> surface);

  std::unique_ptr<Surface> m_Surface;
};

/** Nearly black or nearly white, whichever has more contrast with a background; black on a transparent one. */
Ink
InkOn(const Ink & background);

} // namespace rhombic

#endif
