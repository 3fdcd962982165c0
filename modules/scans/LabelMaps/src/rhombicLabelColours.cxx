#include "rhombicLabelColours.h"

#include "rhombicColour.h"
#include "rhombicLabelTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace rhombic
{
namespace
{

using ByteColour = std::array<std::uint8_t, 3>;
using TouchingLabels = std::map<std::int32_t, std::set<std::int32_t>>;

/** Smallest distance, in OKLab, of the colours of labels that touch. */
constexpr double NotableDistance = 0.045;

/** Calls add(value, other value) for the voxels of a layer that share a face. */
template <typename TImage, typename TAdd>
void
AddTouching(const TImage & image, const TAdd & add)
{
  const auto & size = image.GetBufferedRegion().GetSize();
  const auto * const voxels = image.GetBufferPointer();
  const std::size_t row = size[0];
  const std::size_t slice = row * size[1];
  for (std::size_t k = 0; k < size[2]; ++k)
  {
    for (std::size_t j = 0; j < size[1]; ++j)
    {
      const auto * const begin = voxels + row * j + slice * k;
      for (std::size_t i = 0; i < size[0]; ++i)
      {
        if (i + 1 < size[0])
        {
          add(begin[i], begin[i + 1]);
        }
        if (j + 1 < size[1])
        {
          add(begin[i], begin[i + row]);
        }
        if (k + 1 < size[2])
        {
          add(begin[i], begin[i + slice]);
        }
      }
    }
  }
}

/** The values that touch or overlap each other, without the background. */
TouchingLabels
FindTouchingLabels(const Scan & scan)
{
  const std::vector<ScanImage> layers = LayersOf(scan);
  std::set<std::pair<std::int32_t, std::int32_t>> pairs;
  std::pair<std::int32_t, std::int32_t> last{ 0, 0 }; // neighbours in a row mostly repeat it
  const auto add = [&pairs, &last](auto first, auto second) {
    const std::pair pair{ static_cast<std::int32_t>(first), static_cast<std::int32_t>(second) };
    if (pair.first != pair.second && pair.first != 0 && pair.second != 0 && pair != last)
    {
      pairs.insert(pair);
      last = pair;
    }
  };
  for (std::size_t n = 0; n < layers.size(); ++n)
  {
    std::visit([&add](const auto & image) { AddTouching(*image, add); }, layers[n]);
    for (std::size_t other = 0; other < n; ++other)
    {
      const auto addOverlapping = [&add](const auto & a, const auto & b) {
        for (std::size_t voxel = 0; voxel < a->GetBufferedRegion().GetNumberOfPixels(); ++voxel)
        {
          add(a->GetBufferPointer()[voxel], b->GetBufferPointer()[voxel]);
        }
      };
      std::visit(addOverlapping, layers[n], layers[other]);
    }
  }
  TouchingLabels touching;
  for (const auto & [first, second] : pairs)
  {
    touching[first].insert(second);
    touching[second].insert(first);
  }
  return touching;
}

/** A colour in OKLab, in which equal distances look about equally different (B. Ottosson 2020, the constants of CSS
 * Color Module Level 4). */
std::array<double, 3>
ToOKLab(const ByteColour & colour)
{
  std::array<double, 3> linear;
  for (std::size_t n = 0; n < 3; ++n)
  {
    linear[n] = SRGBToLinear(colour[n] / 255.0);
  }
  const auto cone = [&linear](double red, double green, double blue) {
    return std::cbrt(red * linear[0] + green * linear[1] + blue * linear[2]);
  };
  const double l = cone(0.4122214708, 0.5363325363, 0.0514459929);
  const double m = cone(0.2119034982, 0.6806995451, 0.1073969566);
  const double s = cone(0.0883024619, 0.2817188376, 0.6299787005);
  return { 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
           1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
           0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s };
}

double
Distance(const ByteColour & a, const ByteColour & b)
{
  const auto first = ToOKLab(a);
  const auto second = ToOKLab(b);
  return std::hypot(first[0] - second[0], first[1] - second[1], first[2] - second[2]);
}

/** The smallest distance of a colour from others; large if there are none. */
double
SmallestDistance(const ByteColour & colour, const std::vector<ByteColour> & others)
{
  double smallest = std::numeric_limits<double>::max();
  for (const ByteColour & other : others)
  {
    smallest = std::min(smallest, Distance(colour, other));
  }
  return smallest;
}

/** The colour, lighter or darker by as little as makes it notably different from the others. */
ByteColour
MakeDifferent(const ByteColour & colour, const std::vector<ByteColour> & others)
{
  ByteColour best = colour;
  double bestDistance = -1.0;
  for (const double fraction : { 0.0, 0.12, -0.12, 0.22, -0.22, 0.32, -0.32, 0.45, -0.45, 0.6 })
  {
    const ByteColour changed = Lighten(colour, fraction);
    const double distance = std::min(NotableDistance, SmallestDistance(changed, others)); // more is no better
    if (distance > bestDistance)
    {
      best = changed;
      bestDistance = distance;
    }
  }
  return best;
}

/** Eight colours for everybody (M. Okabe and K. Ito 2008, grey in place of black), then lighter and darker ones. */
std::vector<ByteColour>
MakeColourBlindPalette()
{
  constexpr std::array<ByteColour, 8> colours{ { { 230, 159, 0 },
                                                 { 86, 180, 233 },
                                                 { 0, 158, 115 },
                                                 { 240, 228, 66 },
                                                 { 0, 114, 178 },
                                                 { 213, 94, 0 },
                                                 { 204, 121, 167 },
                                                 { 153, 153, 153 } } };
  std::vector<ByteColour> palette;
  for (const double fraction : { 0.0, 0.45, -0.4 })
  {
    for (const ByteColour & colour : colours)
    {
      palette.push_back(Lighten(colour, fraction));
    }
  }
  return palette;
}

/** The first colour of the palette that differs from the others most, of those that were used least. */
ByteColour
TakeFromPalette(const std::vector<ByteColour> & palette,
                const std::vector<ByteColour> & others,
                std::vector<std::size_t> & uses)
{
  std::size_t chosen = palette.size();
  for (std::size_t n = 0; n < palette.size(); ++n)
  {
    const bool isFree = std::find(others.begin(), others.end(), palette[n]) == others.end();
    if (isFree && (chosen == palette.size() || uses[n] < uses[chosen]))
    {
      chosen = n;
    }
  }
  chosen = std::min(chosen, palette.size() - 1);
  ++uses[chosen];
  return palette[chosen];
}

} // namespace

void
ColourLabels(LabelMap & map, LabelColours colours)
{
  if (colours == LabelColours::Table)
  {
    return;
  }
  const TouchingLabels touching = FindTouchingLabels(map.scan);
  const std::vector<ByteColour> palette = MakeColourBlindPalette();
  std::vector<std::size_t> uses(palette.size(), 0);
  std::map<std::int32_t, ByteColour> done;
  for (LabelSummary & summary : map.labels)
  {
    Label & label = summary.label;
    std::vector<ByteColour> others;
    if (const auto neighbours = touching.find(label.value); neighbours != touching.end())
    {
      for (const std::int32_t neighbour : neighbours->second)
      {
        if (const auto found = done.find(neighbour); found != done.end())
        {
          others.push_back(found->second);
        }
      }
    }
    label.colour = colours == LabelColours::ColourBlind
                     ? TakeFromPalette(palette, others, uses)
                     : MakeDifferent(FindAnatomicalColour(label.name).value_or(label.colour), others);
    done[label.value] = label.colour;
  }
}

} // namespace rhombic
