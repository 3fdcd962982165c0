#include "rhombicGif.h"

#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>

namespace rhombic
{
namespace
{

constexpr std::size_t LargestPalette = 256;
constexpr std::size_t MostAreaColours = 96;
constexpr std::size_t NumberOfColours = std::size_t{ 1 } << 24;

/** A colour as a number of 24 bits, and how many pixels have it. */
struct CountedColour
{
  std::uint32_t colour = 0;
  std::uint64_t count = 0;

  int
  Component(int channel) const
  {
    return static_cast<int>(colour >> (16 - 8 * channel) & 255U);
  }
};

std::uint32_t
ColourAt(const Picture & picture, int x, int y)
{
  const std::uint8_t * const pixel = picture.At(x, y);
  return static_cast<std::uint32_t>(pixel[0] << 16 | pixel[1] << 8 | pixel[2]);
}

/** The colours of all pixels, or of those with the same colour as the pixels on their left and above, ascending. */
std::vector<CountedColour>
CountColours(const PictureFile & contents, bool onlyInAreas)
{
  std::vector<std::uint32_t> counts(NumberOfColours, 0);
  for (std::size_t n = 0; n < contents.count; ++n)
  {
    const Picture & picture = contents.pictures[n];
    for (int y = onlyInAreas ? 1 : 0; y < picture.height; ++y)
    {
      for (int x = onlyInAreas ? 1 : 0; x < picture.width; ++x)
      {
        const std::uint32_t colour = ColourAt(picture, x, y);
        const bool isInArea =
          !onlyInAreas || (ColourAt(picture, x - 1, y) == colour && ColourAt(picture, x, y - 1) == colour);
        counts[colour] += isInArea ? 1 : 0;
      }
    }
  }
  std::vector<CountedColour> colours;
  for (std::uint32_t colour = 0; colour < NumberOfColours; ++colour)
  {
    if (counts[colour] > 0)
    {
      colours.push_back({ colour, counts[colour] });
    }
  }
  return colours;
}

/** A part of a list of colours, for median cut. */
struct ColourBox
{
  std::vector<CountedColour>::iterator begin;
  std::vector<CountedColour>::iterator end;
  std::uint64_t count = 0;
  int channel = 0; ///< in which the colours differ most
  int extent = 0;  ///< in this channel
};

ColourBox
MakeBox(std::vector<CountedColour>::iterator begin, std::vector<CountedColour>::iterator end)
{
  ColourBox box{ begin, end };
  for (int channel = 0; channel < 3; ++channel)
  {
    const auto [least, most] = std::minmax_element(
      begin, end, [channel](const auto & a, const auto & b) { return a.Component(channel) < b.Component(channel); });
    const int extent = most->Component(channel) - least->Component(channel);
    if (extent > box.extent)
    {
      box.extent = extent;
      box.channel = channel;
    }
  }
  box.count = std::accumulate(
    begin, end, std::uint64_t{ 0 }, [](std::uint64_t sum, const CountedColour & c) { return sum + c.count; });
  return box;
}

/** Where the box's colours, sorted by its channel, have half of the pixels on each side; both parts get a colour. */
std::vector<CountedColour>::iterator
FindMedian(const ColourBox & box)
{
  std::stable_sort(box.begin, box.end, [&box](const CountedColour & a, const CountedColour & b) {
    return a.Component(box.channel) < b.Component(box.channel);
  });
  std::uint64_t count = 0;
  auto median = box.begin;
  do
  {
    count += median->count;
    ++median;
  } while (median + 1 != box.end && 2 * count < box.count);
  return median;
}

std::uint32_t
MeanOf(const ColourBox & box)
{
  std::uint32_t mean = 0;
  for (int channel = 0; channel < 3; ++channel)
  {
    double sum = 0.0;
    std::for_each(box.begin, box.end, [&sum, channel](const CountedColour & c) {
      sum += static_cast<double>(c.count) * c.Component(channel);
    });
    mean = mean << 8 | static_cast<std::uint32_t>(std::lround(sum / static_cast<double>(box.count)));
  }
  return mean;
}

/** The mean colours of boxes: that with the largest product of pixels and extent is cut at its median until there are
 * enough. */
std::vector<std::uint32_t>
CutAtMedians(std::vector<CountedColour> colours, std::size_t number)
{
  std::vector<ColourBox> boxes;
  if (!colours.empty())
  {
    boxes.push_back(MakeBox(colours.begin(), colours.end()));
  }
  const auto weightOf = [](const ColourBox & box) { return static_cast<double>(box.count) * box.extent; };
  while (!boxes.empty() && boxes.size() < number)
  {
    const auto largest = std::max_element(
      boxes.begin(), boxes.end(), [&](const ColourBox & a, const ColourBox & b) { return weightOf(a) < weightOf(b); });
    if (largest->extent == 0)
    {
      break;
    }
    const ColourBox box = *largest;
    const auto median = FindMedian(box);
    *largest = MakeBox(box.begin, median);
    boxes.push_back(MakeBox(median, box.end));
  }
  std::vector<std::uint32_t> palette(boxes.size());
  std::transform(boxes.begin(), boxes.end(), palette.begin(), MeanOf);
  return palette;
}

/** The palette of all frames. */
std::vector<std::uint32_t>
MakePalette(const PictureFile & contents, const std::vector<CountedColour> & colours)
{
  std::vector<CountedColour> areas = CountColours(contents, true);
  std::stable_sort(areas.begin(), areas.end(), [](const auto & a, const auto & b) { return a.count > b.count; });
  areas.resize(std::min(areas.size(), MostAreaColours));
  std::vector<std::uint32_t> palette;
  for (const CountedColour & area : areas)
  {
    palette.push_back(area.colour);
  }
  std::vector<CountedColour> others;
  std::copy_if(colours.begin(), colours.end(), std::back_inserter(others), [&palette](const CountedColour & c) {
    return std::find(palette.begin(), palette.end(), c.colour) == palette.end();
  });
  const std::vector<std::uint32_t> cut = CutAtMedians(std::move(others), LargestPalette - palette.size());
  palette.insert(palette.end(), cut.begin(), cut.end());
  return palette;
}

/** For each colour of the frames the number of the nearest one in the palette. */
std::vector<std::uint8_t>
FindNearest(const std::vector<CountedColour> & colours, const std::vector<std::uint32_t> & palette)
{
  std::vector<std::uint8_t> nearest(NumberOfColours, 0);
  for (const CountedColour & colour : colours)
  {
    int smallest = std::numeric_limits<int>::max();
    for (std::size_t n = 0; n < palette.size(); ++n)
    {
      const CountedColour entry{ palette[n] };
      int distance = 0;
      for (int channel = 0; channel < 3; ++channel)
      {
        const int difference = colour.Component(channel) - entry.Component(channel);
        distance += difference * difference;
      }
      if (distance < smallest)
      {
        smallest = distance;
        nearest[colour.colour] = static_cast<std::uint8_t>(n);
      }
    }
  }
  return nearest;
}

int
Append(GifFileType * file, const GifByteType * bytes, int count)
{
  auto & all = *static_cast<std::vector<unsigned char> *>(file->UserData);
  all.insert(all.end(), bytes, bytes + count);
  return count;
}

void
FreeMap(ColorMapObject * map)
{
  GifFreeMapObject(map);
}
using ColourMap = std::unique_ptr<ColorMapObject, decltype(&FreeMap)>;

/** The palette, filled up to 256 colours with black. */
ColourMap
MakeMap(const std::vector<std::uint32_t> & palette)
{
  ColourMap map(GifMakeMapObject(static_cast<int>(LargestPalette), nullptr), FreeMap);
  for (std::size_t n = 0; map && n < palette.size(); ++n)
  {
    const CountedColour colour{ palette[n] };
    const auto byteOf = [&colour](int channel) { return static_cast<GifByteType>(colour.Component(channel)); };
    map->Colors[n] = { byteOf(0), byteOf(1), byteOf(2) };
  }
  return map;
}

/** The header, with the palette and the extension that makes programs repeat the frames for ever. */
bool
PutHeader(GifFileType * file, const Picture & first, const ColorMapObject * map)
{
  constexpr int bits = 8;
  constexpr std::array<GifByteType, 3> loop{ 1, 0, 0 }; // a block of that kind; 0 times is for ever
  constexpr char name[] = "NETSCAPE2.0";
  EGifSetGifVersion(file, true);
  return EGifPutScreenDesc(file, first.width, first.height, bits, 0, map) == GIF_OK &&
         EGifPutExtensionLeader(file, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
         EGifPutExtensionBlock(file, sizeof(name) - 1, name) == GIF_OK &&
         EGifPutExtensionBlock(file, static_cast<int>(loop.size()), loop.data()) == GIF_OK &&
         EGifPutExtensionTrailer(file) == GIF_OK;
}

bool
PutFrame(GifFileType * file, const Picture & frame, int hundredths, const std::vector<std::uint8_t> & nearest)
{
  const GraphicsControlBlock control{ DISPOSE_DO_NOT, false, hundredths, NO_TRANSPARENT_COLOR };
  std::array<GifByteType, 4> extension{};
  EGifGCBToExtension(&control, extension.data());
  bool isGood = EGifPutExtension(file, GRAPHICS_EXT_FUNC_CODE, extension.size(), extension.data()) == GIF_OK &&
                EGifPutImageDesc(file, 0, 0, frame.width, frame.height, false, nullptr) == GIF_OK;
  std::vector<GifPixelType> row(static_cast<std::size_t>(frame.width));
  for (int y = 0; isGood && y < frame.height; ++y)
  {
    for (int x = 0; x < frame.width; ++x)
    {
      row[static_cast<std::size_t>(x)] = nearest[ColourAt(frame, x, y)];
    }
    isGood = EGifPutLine(file, row.data(), frame.width) == GIF_OK;
  }
  return isGood;
}

} // namespace

std::string
EncodeGif(const PictureFile & contents, std::vector<unsigned char> & bytes)
{
  const std::vector<CountedColour> colours = CountColours(contents, false);
  const std::vector<std::uint32_t> palette = MakePalette(contents, colours);
  const std::vector<std::uint8_t> nearest = FindNearest(colours, palette);
  const ColourMap map = MakeMap(palette);
  const int hundredths = static_cast<int>(std::lround(100.0 * contents.secondsPerFrame));
  int error = 0;
  GifFileType * const file = EGifOpen(&bytes, Append, &error);
  bool isGood = file != nullptr && map && PutHeader(file, contents.pictures[0], map.get());
  for (std::size_t n = 0; isGood && n < contents.count; ++n)
  {
    isGood = PutFrame(file, contents.pictures[n], hundredths, nearest);
  }
  if (!isGood && file != nullptr)
  {
    error = file->Error;
  }
  int closing = 0;
  if (file != nullptr && EGifCloseFile(file, &closing) != GIF_OK && isGood)
  {
    isGood = false;
    error = closing;
  }
  const char * const reason = isGood ? "" : GifErrorString(error);
  return reason != nullptr ? reason : "giflib gives no reason";
}

} // namespace rhombic
