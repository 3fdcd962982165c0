#include "rhombicNameColumns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace rhombic
{
namespace
{

constexpr double NameSize = 0.78;         // of the picture's text
constexpr double SmallestNameText = 10.0; // pixels
constexpr double LargestNameShare = 0.22; // of the picture's width, of each column
constexpr double NamePitch = 1.3;         // the following, but for pixels and shares, are multiples of the names' size
constexpr double TurnWidth = 1.6;         // between a column and the scene, where lines turn
constexpr double NameGap = 0.35;          // between a name and its line
constexpr double LineWidth = 0.085;
constexpr double SmallestLineWidth = 1.1; // pixels
constexpr double HaloShare = 0.65;        // of the line's width, at each side
constexpr double DotSize = 0.17;
constexpr double HaloOpacityOnDark = 0.6;
constexpr double HaloOpacityOnLight = 0.4;

/** Positions of names in a column, from top to bottom: as near to the wanted ones, which ascend, as their pitch allows
 * (the mean of each run of names that touch), and between two ends. */
std::vector<double>
SpreadApart(const std::vector<double> & wanted, double pitch, double first, double last)
{
  struct Run
  {
    double sum; ///< of the wanted positions, less the pitches before them
    std::size_t count;
  };
  const auto meanOf = [](const Run & run) { return run.sum / static_cast<double>(run.count); };
  std::vector<Run> runs;
  for (std::size_t n = 0; n < wanted.size(); ++n)
  {
    runs.push_back({ wanted[n] - pitch * static_cast<double>(n), 1 });
    while (runs.size() > 1 && meanOf(runs[runs.size() - 2]) > meanOf(runs.back()))
    {
      const Run below = runs.back();
      runs.pop_back();
      runs.back().sum += below.sum;
      runs.back().count += below.count;
    }
  }
  const double highest = std::max(first, last - pitch * (static_cast<double>(wanted.size()) - 1.0));
  std::vector<double> positions;
  for (const Run & run : runs)
  {
    for (std::size_t n = 0; n < run.count; ++n)
    {
      positions.push_back(std::clamp(meanOf(run), first, highest) + pitch * static_cast<double>(positions.size()));
    }
  }
  return positions;
}

/** Whether c is to the left of the line from a to b (positive), or to its right. */
double
SideOf(const PicturePosition & a, const PicturePosition & b, const PicturePosition & c)
{
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool
DoCross(const PicturePosition & a, const PicturePosition & b, const PicturePosition & c, const PicturePosition & d)
{
  return SideOf(a, b, c) * SideOf(a, b, d) < 0.0 && SideOf(c, d, a) * SideOf(c, d, b) < 0.0;
}

/** Exchanges the ends of lines that cross until none do. Each exchange makes the lines shorter, so there is an end. */
void
Uncross(const std::vector<PicturePosition> & anchors, std::vector<PicturePosition> & ends)
{
  for (bool isChanged = true; isChanged;)
  {
    isChanged = false;
    for (std::size_t a = 0; a < ends.size(); ++a)
    {
      for (std::size_t b = a + 1; b < ends.size(); ++b)
      {
        if (DoCross(anchors[a], ends[a], anchors[b], ends[b]))
        {
          std::swap(ends[a], ends[b]);
          isChanged = true;
        }
      }
    }
  }
}

/** Moves the columns towards each other, as far as nothing that is named is under them or where lines turn. */
void
MoveToScene(const std::vector<PointedName> & names, NameColumns & columns)
{
  double left = std::numeric_limits<double>::infinity();
  double right = -left;
  for (const PointedName & name : names)
  {
    left = std::min({ left, name.left, name.anchor.x });
    right = std::max({ right, name.right, name.anchor.x });
  }
  const double turn = 2.0 * TurnWidth * columns.text.size;
  columns.left.left = std::max(columns.left.left, left - turn - columns.left.width);
  columns.right.left = std::min(columns.right.left, right + turn);
}

std::size_t
CapacityOf(const Rectangle & column, double pitch)
{
  return static_cast<std::size_t>(std::max(0.0, column.height / pitch));
}

/** Adds the names of one column. */
void
PlaceColumn(const Drawing & drawing,
            const std::vector<PointedName> & names,
            std::vector<std::size_t> numbers,
            const NameColumns & columns,
            bool isLeft,
            std::vector<PlacedName> & placed)
{
  const Rectangle & column = isLeft ? columns.left : columns.right;
  const auto anchorOf = [&names](std::size_t number) { return names[number].anchor; };
  std::stable_sort(numbers.begin(), numbers.end(), [&anchorOf](std::size_t a, std::size_t b) {
    return anchorOf(a).y < anchorOf(b).y;
  });
  std::vector<PicturePosition> anchors;
  std::vector<double> heights;
  for (const std::size_t number : numbers)
  {
    anchors.push_back(anchorOf(number));
    heights.push_back(anchors.back().y);
  }
  const double half = 0.5 * columns.pitch;
  heights = SpreadApart(heights, columns.pitch, column.top + half, column.Bottom() - half);
  const double turn = TurnWidth * columns.text.size;
  std::vector<PicturePosition> ends;
  for (const double height : heights)
  {
    ends.push_back({ isLeft ? column.Right() + turn : column.left - turn, height });
  }
  Uncross(anchors, ends);
  std::vector<std::size_t> order(numbers.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::sort(order.begin(), order.end(), [&ends](std::size_t a, std::size_t b) { return ends[a].y < ends[b].y; });
  for (const std::size_t n : order)
  {
    const double width = drawing.WidthOf(names[numbers[n]].name, columns.text);
    PlacedName name;
    name.number = numbers[n];
    name.isLeft = isLeft;
    name.box = { isLeft ? column.Right() - width : column.left, ends[n].y - half, width, columns.pitch };
    const double gap = NameGap * columns.text.size;
    name.line = { anchors[n], ends[n], { isLeft ? column.Right() + gap : column.left - gap, ends[n].y } };
    placed.push_back(name);
  }
}

} // namespace

NameColumns
TakeNameColumns(const Drawing & drawing,
                const std::vector<PointedName> & names,
                const TextStyle & style,
                double width,
                Rectangle & scene)
{
  NameColumns columns;
  if (names.empty())
  {
    return columns;
  }
  columns.text = style;
  columns.text.size = std::min(style.size, std::max(NameSize * style.size, SmallestNameText));
  columns.pitch = NamePitch * columns.text.size;
  double widest = 0.0;
  for (const PointedName & name : names)
  {
    widest = std::max(widest, drawing.WidthOf(name.name, columns.text));
  }
  columns.text.largestWidth = std::ceil(std::min(widest, LargestNameShare * width)) + 1.0;
  const double beside = columns.text.largestWidth + TurnWidth * columns.text.size;
  columns.left = { scene.left, scene.top, columns.text.largestWidth, scene.height };
  columns.right = { scene.Right() - columns.text.largestWidth, scene.top, columns.text.largestWidth, scene.height };
  scene.left += beside;
  scene.width -= 2.0 * beside;
  return columns;
}

std::vector<PlacedName>
PlaceInColumns(const Drawing & drawing, const std::vector<PointedName> & names, NameColumns columns)
{
  std::vector<PlacedName> placed;
  if (names.empty())
  {
    return placed;
  }
  MoveToScene(names, columns);
  std::vector<std::size_t> numbers(names.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{ 0 });
  std::stable_sort(
    numbers.begin(), numbers.end(), [&names](std::size_t a, std::size_t b) { return names[a].seen > names[b].seen; });
  const std::size_t atLeft = CapacityOf(columns.left, columns.pitch);
  const std::size_t atRight = CapacityOf(columns.right, columns.pitch);
  numbers.resize(std::min(numbers.size(), atLeft + atRight));
  std::stable_sort(numbers.begin(), numbers.end(), [&names](std::size_t a, std::size_t b) {
    return names[a].anchor.x < names[b].anchor.x;
  });
  const double middle = 0.5 * (columns.left.left + columns.right.Right());
  const auto inLeftHalf = static_cast<std::size_t>(
    std::count_if(numbers.begin(), numbers.end(), [&](std::size_t number) { return names[number].anchor.x < middle; }));
  const std::size_t fewest = numbers.size() - std::min(numbers.size(), atRight);
  const auto split =
    numbers.begin() + static_cast<std::ptrdiff_t>(std::clamp(inLeftHalf, fewest, std::min(numbers.size(), atLeft)));
  PlaceColumn(drawing, names, { numbers.begin(), split }, columns, true, placed);
  PlaceColumn(drawing, names, { split, numbers.end() }, columns, false, placed);
  return placed;
}

void
DrawNames(Drawing & drawing,
          const std::vector<PointedName> & names,
          const std::vector<PlacedName> & placed,
          const TextStyle & text,
          bool isDark)
{
  const auto colourOf = [&](const PlacedName & name) {
    const Colour & colour = names[name.number].colour;
    return isDark ? LineColourOnDark(colour) : colour;
  };
  const double size = text.size;
  const double width = std::max(SmallestLineWidth, LineWidth * size);
  const double halo = HaloShare * width;
  for (const bool isHalo : { true, false })
  {
    for (const PlacedName & name : placed)
    {
      const Ink ink =
        isHalo ? Ink{ { 0.0, 0.0, 0.0 }, isDark ? HaloOpacityOnDark : HaloOpacityOnLight } : Ink{ colourOf(name) };
      LineStyle style;
      style.width = isHalo ? width + 2.0 * halo : width;
      style.ink = ink;
      drawing.Line({ name.line.begin(), name.line.end() }, style);
      const double radius = std::max(2.0, DotSize * size) + (isHalo ? halo : 0.0);
      drawing.Ellipse(name.line[0], { radius, 0.0 }, { 0.0, radius }, ink);
    }
  }
  TextStyle style = text;
  for (const PlacedName & name : placed)
  {
    style.alignment = name.isLeft ? Alignment::Right : Alignment::Left;
    style.ink.colour = isDark ? colourOf(name) : text.ink.colour;
    const double x = name.isLeft ? name.box.Right() : name.box.left;
    drawing.TextAbout(names[name.number].name, { x, name.box.top + 0.5 * name.box.height }, style);
  }
}

} // namespace rhombic
