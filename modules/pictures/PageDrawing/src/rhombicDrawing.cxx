#include "rhombicDrawing.h"

#include "rhombicFailure.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rhombic
{
namespace
{

constexpr int LargestSide = 32767; // pixels; a limit of cairo
constexpr double PointsPerInch = 72.0;
constexpr double CapitalHeight = 0.729; // of DejaVu Sans, in ems
constexpr double SmallestShrinking = 0.75;
constexpr double TextHaloWidth = 0.12; // ems

template <typename TObject, void (*TRelease)(TObject *)>
struct Release
{
  void
  operator()(TObject * object) const
  {
    TRelease(object);
  }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, Release<cairo_surface_t, cairo_surface_destroy>>;
using CairoContext = std::unique_ptr<cairo_t, Release<cairo_t, cairo_destroy>>;
using CairoPattern = std::unique_ptr<cairo_pattern_t, Release<cairo_pattern_t, cairo_pattern_destroy>>;

void
ReleaseLayout(PangoLayout * layout)
{
  g_object_unref(layout);
}
using Layout = std::unique_ptr<PangoLayout, Release<PangoLayout, ReleaseLayout>>;

void
CheckSize(int width, int height)
{
  if (std::min(width, height) < 1 || std::max(width, height) > LargestSide)
  {
    throw Failure(FailureKind::Usage,
                  "Cannot draw a page of " + std::to_string(width) + " x " + std::to_string(height) +
                    " pixels; each side must have 1 to " + std::to_string(LargestSide) + ".");
  }
}

/** Pango lists the names that stand for a default font even if no font is installed. */
void
CheckFonts()
{
  PangoFontFamily ** families = nullptr;
  int count = 0;
  pango_font_map_list_families(pango_cairo_font_map_get_default(), &families, &count);
  const bool hasFonts = std::any_of(families, families + count, [](PangoFontFamily * family) {
    const std::string name = pango_font_family_get_name(family);
    return name != "Sans" && name != "Serif" && name != "Monospace" && name != "System-ui";
  });
  g_free(families);
  if (!hasFonts)
  {
    throw Failure(FailureKind::Display,
                  "Cannot draw text: no font is installed; install one, on Debian with apt install fonts-dejavu-core.");
  }
}

void
CheckStatus(cairo_status_t status)
{
  if (status != CAIRO_STATUS_SUCCESS)
  {
    throw Failure(status == CAIRO_STATUS_NO_MEMORY ? FailureKind::Memory : FailureKind::Internal,
                  std::string("Cannot draw the page: ") + cairo_status_to_string(status) + "; try a smaller one.");
  }
}

CairoSurface
NewImage(cairo_format_t format, int width, int height)
{
  CairoSurface image(cairo_image_surface_create(format, width, height));
  CheckStatus(cairo_surface_status(image.get()));
  return image;
}

/** The pixel in cairo's form: colours multiplied by alpha, in a number with alpha in the highest byte. */
std::uint32_t
ToCairo(const std::uint8_t * pixel, int channels)
{
  const std::uint32_t alpha = channels == 4 ? pixel[3] : 255;
  std::uint32_t word = alpha << 24;
  for (int channel = 0; channel < 3; ++channel)
  {
    word |= ((pixel[channel] * alpha + 127) / 255) << (16 - 8 * channel);
  }
  return word;
}

CairoSurface
ToImage(const Picture & picture)
{
  CairoSurface image =
    NewImage(picture.channels == 4 ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24, picture.width, picture.height);
  unsigned char * const bytes = cairo_image_surface_get_data(image.get());
  const int stride = cairo_image_surface_get_stride(image.get());
  std::vector<std::uint32_t> row(static_cast<std::size_t>(picture.width));
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < picture.width; ++x)
    {
      row[static_cast<std::size_t>(x)] = ToCairo(picture.At(x, y), picture.channels);
    }
    std::memcpy(bytes + static_cast<std::ptrdiff_t>(y) * stride, row.data(), row.size() * sizeof(row[0]));
  }
  cairo_surface_mark_dirty(image.get());
  return image;
}

/** Lays one pixel in cairo's form over a pixel with straight alpha. */
void
Composite(std::uint32_t over, std::uint8_t * pixel, int channels)
{
  const std::uint32_t alpha = over >> 24;
  if (alpha == 0)
  {
    return;
  }
  const std::uint32_t under = (channels == 4 ? pixel[3] : 255) * (255 - alpha); // share of what stays, times 255
  const std::uint32_t sum = 255 * alpha + under;
  for (int channel = 0; channel < 3; ++channel)
  {
    const std::uint32_t component = (over >> (16 - 8 * channel)) & 255; // times alpha
    pixel[channel] =
      static_cast<std::uint8_t>(std::min((component * 255 * 255 + pixel[channel] * under + sum / 2) / sum, 255u));
  }
  if (channels == 4)
  {
    pixel[3] = static_cast<std::uint8_t>((sum + 127) / 255);
  }
}

void
CompositeImage(cairo_surface_t * image, Picture & picture)
{
  cairo_surface_flush(image);
  const unsigned char * const bytes = cairo_image_surface_get_data(image);
  const int stride = cairo_image_surface_get_stride(image);
  std::vector<std::uint32_t> row(static_cast<std::size_t>(picture.width));
  std::uint8_t * pixel = picture.pixels.data();
  for (int y = 0; y < picture.height; ++y)
  {
    std::memcpy(row.data(), bytes + static_cast<std::ptrdiff_t>(y) * stride, row.size() * sizeof(row[0]));
    for (const std::uint32_t over : row)
    {
      Composite(over, pixel, picture.channels);
      pixel += picture.channels;
    }
  }
}

/** Text that pango takes without a warning. */
std::string
ToOneLine(const std::string & text)
{
  char * const valid = g_utf8_make_valid(text.data(), static_cast<gssize>(text.size()));
  std::string line = valid;
  g_free(valid);
  std::replace_if(
    line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, ' ');
  return line;
}

void
SetFont(PangoLayout * layout, double size, bool isBold)
{
  PangoFontDescription * const font = pango_font_description_from_string("DejaVu Sans");
  pango_font_description_set_absolute_size(font, size * PANGO_SCALE);
  pango_font_description_set_weight(font, isBold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
  pango_layout_set_font_description(layout, font);
  pango_font_description_free(font);
}

/** Width and height in pixels. */
Rectangle
ExtentsOf(const Layout & layout)
{
  PangoRectangle extents;
  pango_layout_get_extents(layout.get(), nullptr, &extents);
  return { 0.0, 0.0, pango_units_to_double(extents.width), pango_units_to_double(extents.height) };
}

Layout
NewLayout(cairo_t * context, const std::string & text, const TextStyle & style)
{
  Layout layout(pango_cairo_create_layout(context));
  pango_context_set_round_glyph_positions(pango_layout_get_context(layout.get()),
                                          FALSE); // gaps in words at small sizes
  const std::string line = ToOneLine(text);
  pango_layout_set_text(layout.get(), line.data(), static_cast<int>(line.size()));
  PangoAttrList * const attributes = pango_attr_list_new();
  pango_attr_list_insert(attributes, pango_attr_font_features_new("liga=0")); // words of a PDF with fi are found
  pango_layout_set_attributes(layout.get(), attributes);
  pango_attr_list_unref(attributes);
  SetFont(layout.get(), style.size, style.bold);
  return layout;
}

Layout
NewLine(cairo_t * context, const std::string & text, const TextStyle & style)
{
  Layout layout = NewLayout(context, text, style);
  const double width = ExtentsOf(layout).width;
  if (style.largestWidth > 0.0 && width > style.largestWidth)
  {
    const double shrinking = std::max(0.995 * style.largestWidth / width, SmallestShrinking);
    SetFont(layout.get(), style.size * shrinking, style.bold);
    if (ExtentsOf(layout).width <= style.largestWidth)
    {
      return layout;
    }
    pango_layout_set_width(layout.get(), static_cast<int>(style.largestWidth * PANGO_SCALE));
    pango_layout_set_ellipsize(layout.get(), PANGO_ELLIPSIZE_MIDDLE);
  }
  return layout;
}

Layout
NewParagraph(cairo_t * context, const std::string & text, double width, const TextStyle & style)
{
  Layout layout = NewLayout(context, text, style);
  pango_layout_set_width(layout.get(), static_cast<int>(width * PANGO_SCALE));
  pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
  return layout;
}

void
SetInk(cairo_t * context, const Ink & ink)
{
  cairo_set_source_rgba(context, ink.colour[0], ink.colour[1], ink.colour[2], ink.opacity);
}

/** The height of a layout above its first baseline. */
double
AscentOf(const Layout & layout)
{
  return pango_units_to_double(pango_layout_get_baseline(layout.get()));
}

/** Pango leaves out the letters of a font whose file cannot be read. */
void
CheckFontsOf(const Layout & layout)
{
  PangoLayoutIter * const place = pango_layout_get_iter(layout.get());
  bool isGood = true;
  do
  {
    const PangoLayoutRun * const run = pango_layout_iter_get_run_readonly(place); // null at the end of a line
    cairo_scaled_font_t * const font =
      run == nullptr ? nullptr : pango_cairo_font_get_scaled_font(PANGO_CAIRO_FONT(run->item->analysis.font));
    isGood = isGood && (run == nullptr || (font != nullptr && cairo_scaled_font_status(font) == CAIRO_STATUS_SUCCESS));
  } while (pango_layout_iter_next_run(place));
  pango_layout_iter_free(place);
  if (!isGood)
  {
    throw Failure(FailureKind::Display, "Cannot draw text: the file of a font cannot be read; install the font again.");
  }
}

/** Draws a layout whose first baseline begins at a position. */
void
ShowLayout(cairo_t * context, const Layout & layout, const PicturePosition & baseline, const TextStyle & style)
{
  CheckFontsOf(layout);
  const double ascent = AscentOf(layout);
  if (style.halo.opacity > 0.0)
  {
    cairo_move_to(context, baseline.x, baseline.y - ascent);
    pango_cairo_layout_path(context, layout.get());
    SetInk(context, style.halo);
    cairo_set_line_width(context, 2.0 * TextHaloWidth * style.size);
    cairo_stroke(context);
  }
  cairo_move_to(context, baseline.x, baseline.y - ascent);
  SetInk(context, style.ink);
  pango_cairo_show_layout(context, layout.get());
  cairo_new_path(context);
}

void
AddPath(cairo_t * context, const std::vector<PicturePosition> & points, bool isClosed)
{
  for (const PicturePosition & point : points)
  {
    cairo_line_to(context, point.x, point.y);
  }
  if (isClosed)
  {
    cairo_close_path(context);
  }
}

void
AddRectangle(cairo_t * context, const Rectangle & r)
{
  cairo_rectangle(context, r.left, r.top, r.width, r.height);
}

cairo_status_t
Append(void * text, const unsigned char * bytes, unsigned int length)
{
  static_cast<std::string *>(text)->append(reinterpret_cast<const char *>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

void
SetProperties(cairo_surface_t * pdf, const PdfProperties & properties)
{
  // Object streams, which later versions have, hide the number of pages from simple readers.
  cairo_pdf_surface_restrict_to_version(pdf, CAIRO_PDF_VERSION_1_4);
  cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_CREATE_DATE, nullptr); // the default is now
  if (!properties.title.empty())
  {
    cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_TITLE, ToOneLine(properties.title).c_str());
  }
  if (!properties.software.empty())
  {
    cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_CREATOR, ToOneLine(properties.software).c_str());
  }
}

} // namespace

struct Drawing::Surface
{
  const int width;
  const int height;
  std::size_t pages = 1;
  std::string document;             ///< bytes so far; outlives the surface that writes them
  std::vector<CairoSurface> images; ///< finished pages
  CairoSurface surface;
  CairoContext context;

  bool
  IsPdf() const
  {
    return cairo_surface_get_type(surface.get()) == CAIRO_SURFACE_TYPE_PDF;
  }

  /** Checks the size of the pages, and whether there is a font. */
  Surface(int pageWidth, int pageHeight)
    : width(pageWidth)
    , height(pageHeight)
  {
    CheckSize(width, height);
    CheckFonts();
  }

  /** Text without hinting, so that it has the same shape everywhere. */
  void
  Begin()
  {
    CheckStatus(cairo_surface_status(surface.get()));
    cairo_font_options_t * const options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    context.reset(cairo_create(surface.get()));
    cairo_set_font_options(context.get(), options);
    cairo_font_options_destroy(options);
    cairo_set_line_join(context.get(), CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(context.get(), CAIRO_LINE_CAP_ROUND);
    cairo_set_antialias(context.get(), CAIRO_ANTIALIAS_BEST);
  }
};

Drawing::Drawing(int width, int height)
  : m_Surface(std::make_unique<Surface>(width, height))
{
  m_Surface->surface = NewImage(CAIRO_FORMAT_ARGB32, width, height);
  m_Surface->Begin();
}

Drawing::Drawing(int width, int height, double pixelsPerInch, const PdfProperties & properties)
  : m_Surface(std::make_unique<Surface>(width, height))
{
  const double scale = PointsPerInch / pixelsPerInch;
  m_Surface->surface.reset(
    cairo_pdf_surface_create_for_stream(Append, &m_Surface->document, scale * width, scale * height));
  SetProperties(m_Surface->surface.get(), properties);
  m_Surface->Begin();
  cairo_scale(m_Surface->context.get(), scale, scale);
}

Drawing::Drawing(std::unique_ptr<Surface> surface)
  : m_Surface(std::move(surface))
{}

Drawing
Drawing::ForSvg(int width, int height)
{
  auto surface = std::make_unique<Surface>(width, height);
  surface->surface.reset(cairo_svg_surface_create_for_stream(Append, &surface->document, width, height));
  cairo_svg_surface_set_document_unit(surface->surface.get(), CAIRO_SVG_UNIT_PX);
  surface->Begin();
  return Drawing(std::move(surface));
}

Drawing::~Drawing() = default;
Drawing::Drawing(Drawing &&) noexcept = default;
Drawing &
Drawing::operator=(Drawing &&) noexcept = default;

int
Drawing::GetWidth() const
{
  return m_Surface->width;
}

void
Drawing::Text(const std::string & text, const PicturePosition & baseline, const TextStyle & style)
{
  cairo_t * const context = m_Surface->context.get();
  const Layout layout = NewLine(context, text, style);
  const double share = style.alignment == Alignment::Left ? 0.0 : style.alignment == Alignment::Centre ? 0.5 : 1.0;
  ShowLayout(context, layout, { baseline.x - share * ExtentsOf(layout).width, baseline.y }, style);
}

void
Drawing::TextAbout(const std::string & text, const PicturePosition & middle, const TextStyle & style)
{
  Text(text, { middle.x, middle.y + 0.5 * CapitalHeight * style.size }, style);
}

double
Drawing::WidthOf(const std::string & text, const TextStyle & style) const
{
  return ExtentsOf(NewLine(m_Surface->context.get(), text, style)).width;
}

double
Drawing::Paragraph(const std::string & text, const PicturePosition & topLeft, double width, const TextStyle & style)
{
  cairo_t * const context = m_Surface->context.get();
  const Layout layout = NewParagraph(context, text, width, style);
  ShowLayout(context, layout, { topLeft.x, topLeft.y + AscentOf(layout) }, style);
  return ExtentsOf(layout).height;
}

double
Drawing::HeightOf(const std::string & text, double width, const TextStyle & style) const
{
  return ExtentsOf(NewParagraph(m_Surface->context.get(), text, width, style)).height;
}

void
Drawing::Line(const std::vector<PicturePosition> & points, const LineStyle & style, bool isClosed)
{
  cairo_t * const context = m_Surface->context.get();
  AddPath(context, points, isClosed);
  if (style.halo.opacity > 0.0)
  {
    SetInk(context, style.halo);
    cairo_set_line_width(context, style.width + 2.0 * style.haloWidth);
    cairo_stroke_preserve(context);
  }
  SetInk(context, style.ink);
  cairo_set_line_width(context, style.width);
  cairo_stroke(context);
}

void
Drawing::Polygon(const std::vector<PicturePosition> & points, const Ink & ink)
{
  cairo_t * const context = m_Surface->context.get();
  AddPath(context, points, true);
  SetInk(context, ink);
  cairo_fill(context);
}

void
Drawing::Ellipse(const PicturePosition & centre, const PicturePosition & a, const PicturePosition & b, const Ink & ink)
{
  if (a.x * b.y == a.y * b.x)
  {
    return; // flat, which cairo takes for an error
  }
  cairo_t * const context = m_Surface->context.get();
  const cairo_matrix_t fromCircle{ a.x, a.y, b.x, b.y, centre.x, centre.y };
  cairo_save(context);
  cairo_transform(context, &fromCircle);
  cairo_new_path(context);
  cairo_arc(context, 0.0, 0.0, 1.0, 0.0, 2.0 * G_PI);
  cairo_restore(context);
  SetInk(context, ink);
  cairo_fill(context);
}

void
Drawing::Fill(const Rectangle & rectangle, const Ink & ink, double cornerRadius)
{
  cairo_t * const context = m_Surface->context.get();
  if (cornerRadius > 0.0)
  {
    const Rectangle r = rectangle.Inset(cornerRadius);
    cairo_new_path(context);
    cairo_arc(context, r.Right(), r.top, cornerRadius, -0.5 * G_PI, 0.0);
    cairo_arc(context, r.Right(), r.Bottom(), cornerRadius, 0.0, 0.5 * G_PI);
    cairo_arc(context, r.left, r.Bottom(), cornerRadius, 0.5 * G_PI, G_PI);
    cairo_arc(context, r.left, r.top, cornerRadius, G_PI, 1.5 * G_PI);
    cairo_close_path(context);
  }
  else
  {
    AddRectangle(context, rectangle);
  }
  SetInk(context, ink);
  cairo_fill(context);
}

void
Drawing::Frame(const Rectangle & rectangle, const LineStyle & style)
{
  const Rectangle r = rectangle.Inset(0.5 * style.width);
  Line({ { r.left, r.top }, { r.Right(), r.top }, { r.Right(), r.Bottom() }, { r.left, r.Bottom() } }, style, true);
}

void
Drawing::Place(const Picture & picture, const Rectangle & place)
{
  CheckSize(picture.width, picture.height);
  cairo_t * const context = m_Surface->context.get();
  const CairoSurface image = ToImage(picture);
  const CairoPattern pattern(cairo_pattern_create_for_surface(image.get()));
  cairo_pattern_set_filter(pattern.get(), CAIRO_FILTER_BEST);
  if (!m_Surface->IsPdf())
  {
    cairo_pattern_set_extend(pattern.get(), CAIRO_EXTEND_PAD); // edges stay sharp; a PDF would get a larger picture
  }
  const double scaleX = picture.width / place.width;
  const double scaleY = picture.height / place.height;
  const cairo_matrix_t toPicture{ scaleX, 0.0, 0.0, scaleY, -scaleX * place.left, -scaleY * place.top };
  cairo_pattern_set_matrix(pattern.get(), &toPicture);
  cairo_set_source(context, pattern.get());
  AddRectangle(context, place);
  cairo_fill(context);
}

void
Drawing::Clip(const Rectangle & rectangle)
{
  cairo_t * const context = m_Surface->context.get();
  cairo_save(context);
  AddRectangle(context, rectangle);
  cairo_clip(context);
}

void
Drawing::Unclip()
{
  cairo_restore(m_Surface->context.get());
}

void
Drawing::NextPage()
{
  ++m_Surface->pages;
  CheckStatus(cairo_status(m_Surface->context.get()));
  if (m_Surface->IsPdf())
  {
    cairo_show_page(m_Surface->context.get());
    return;
  }
  m_Surface->images.push_back(std::move(m_Surface->surface));
  m_Surface->surface = NewImage(CAIRO_FORMAT_ARGB32, m_Surface->width, m_Surface->height);
  m_Surface->Begin();
}

std::size_t
Drawing::GetNumberOfPages() const
{
  return m_Surface->pages;
}

void
Drawing::PutOnto(Picture & picture) const
{
  if (picture.width != m_Surface->width || picture.height != m_Surface->height || m_Surface->IsPdf())
  {
    throw Failure(FailureKind::Internal,
                  "A drawing and the picture under it differ in size; draw at the picture's size.");
  }
  CheckStatus(cairo_status(m_Surface->context.get()));
  CompositeImage(m_Surface->surface.get(), picture);
}

std::vector<Picture>
Drawing::TakePictures(const Ink & paper)
{
  CheckStatus(cairo_status(m_Surface->context.get()));
  m_Surface->images.push_back(std::move(m_Surface->surface));
  std::vector<Picture> pictures;
  for (CairoSurface & image : m_Surface->images)
  {
    Picture picture(m_Surface->width, m_Surface->height, paper.opacity < 1.0 ? 4 : 3);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    {
      const std::size_t channel = i % static_cast<std::size_t>(picture.channels);
      const double component = channel == 3 ? paper.opacity : paper.colour[channel];
      picture.pixels[i] = ToByte(component);
    }
    CompositeImage(image.get(), picture);
    image.reset();
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

std::string
Drawing::TakeDocument()
{
  CheckStatus(cairo_status(m_Surface->context.get()));
  cairo_surface_finish(m_Surface->surface.get());
  CheckStatus(cairo_surface_status(m_Surface->surface.get()));
  return std::move(m_Surface->document);
}

Ink
InkOn(const Ink & background)
{
  const Colour & colour = background.colour;
  const double luminance = // ITU-R BT.709
    0.2126 * std::pow(colour[0], 2.2) + 0.7152 * std::pow(colour[1], 2.2) + 0.0722 * std::pow(colour[2], 2.2);
  // At a luminance of 0.179 black and white have the same contrast (Web Content Accessibility Guidelines).
  const bool isDark = background.opacity >= 0.5 && luminance < 0.179;
  const double brightness = isDark ? 0.93 : 0.1;
  return { { brightness, brightness, brightness }, 1.0 };
}

} // namespace rhombic
