#include "rhombicLightbox.h"

#include "rhombicFailure.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rhombic
{
namespace
{

/** Copies a picture to a position in one of as many or more channels. */
void
Paste(const Picture & picture, int left, int top, Picture & page)
{
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < picture.width; ++x)
    {
      std::uint8_t * const pixel = page.pixels.data() + (page.At(left + x, top + y) - page.pixels.data());
      std::copy_n(picture.At(x, y), picture.channels, pixel);
      if (picture.channels < page.channels)
      {
        pixel[3] = 255;
      }
    }
  }
}

Picture
Blank(int width, int height, int channels, const Colour & background)
{
  Picture page(width, height, channels); // transparent with alpha
  for (std::size_t i = 0; channels == 3 && i < page.pixels.size(); ++i)
  {
    page.pixels[i] = static_cast<std::uint8_t>(std::lround(255.0 * background[i % 3]));
  }
  return page;
}

} // namespace

int
LightboxColumns(int count, int width, int height, double aspect)
{
  int best = 1;
  double smallest = INFINITY;
  for (int columns = 1; columns <= count; ++columns)
  {
    const int rows = (count + columns - 1) / columns;
    const double distance = std::abs(std::log(static_cast<double>(columns) * width / (rows * height * aspect)));
    const double emptiness = 2.0 * (columns * rows - count) / count;
    if (distance + emptiness < smallest)
    {
      smallest = distance + emptiness;
      best = columns;
    }
  }
  return best;
}

Picture
MakeLightbox(const std::vector<Picture> & pictures,
             int gap,
             const Colour & background,
             int columns,
             int pageWidth,
             int pageHeight)
{
  if (pictures.empty())
  {
    throw Failure(FailureKind::Usage, "Cannot make a lightbox without pictures; ask for at least one.");
  }
  int width = 0;
  int height = 0;
  int channels = 3;
  for (const Picture & picture : pictures)
  {
    width = std::max(width, picture.width);
    height = std::max(height, picture.height);
    channels = std::max(channels, picture.channels);
  }
  const int count = static_cast<int>(pictures.size());
  columns = columns > 0 ? std::min(columns, count) : LightboxColumns(count, width, height);
  const int rows = (count + columns - 1) / columns;
  Picture page = Blank(std::max(pageWidth, gap + columns * (width + gap)),
                       std::max(pageHeight, gap + rows * (height + gap)),
                       channels,
                       background);
  const auto placeIn = [gap](int cell, int cells, int side, int pageSide) {
    const int begin = gap + cell * (pageSide - gap) / cells;
    const int end = (cell + 1) * (pageSide - gap) / cells;
    return begin + (end - begin - side) / 2;
  };
  for (int i = 0; i < count; ++i)
  {
    const Picture & picture = pictures[static_cast<std::size_t>(i)];
    Paste(picture,
          placeIn(i % columns, columns, picture.width, page.width),
          placeIn(i / columns, rows, picture.height, page.height),
          page);
  }
  return page;
}

} // namespace rhombic
