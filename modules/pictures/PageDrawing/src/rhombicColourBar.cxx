#include "rhombicColourBar.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

constexpr double BarWidth = 1.3;       // of the text's size, and next
constexpr double BarGap = 0.6;         // between the bar and its numbers
constexpr double MostBarHeight = 20.0; // of the bar
constexpr double BarTitleHeight = 2.0;

} // namespace

ColourBarLayout
FitColourBar(const Drawing & drawing, const ColourScale & scale, const TextStyle & style)
{
  ColourBarLayout layout;
  layout.numbers = NumbersOnBar(scale);
  double widest = 0.0;
  for (const std::string & number : layout.numbers)
  {
    widest = std::max(widest, drawing.WidthOf(number, style));
  }
  const double bar = (BarWidth + BarGap) * style.size + widest;
  layout.width = std::max(bar, drawing.WidthOf(scale.title, style));
  return layout;
}

void
DrawColourBar(Drawing & drawing,
              const ColourScale & scale,
              const ColourBarLayout & layout,
              const Rectangle & place,
              const TextStyle & style)
{
  const double size = style.size;
  const double height = std::min(place.height - (BarTitleHeight + 1.0) * size, MostBarHeight * size);
  const double top = place.top + BarTitleHeight * size;
  drawing.Text(scale.title, { place.left, place.top + size }, style);
  if (height < 2.0 * size)
  {
    return;
  }
  const int rows = std::max(2, static_cast<int>(std::lround(height)));
  Picture colours(1, rows);
  for (int row = 0; row < rows; ++row)
  {
    const double share = 1.0 - (row + 0.5) / rows;
    const auto bytes = ToBytes(ColourOf(scale, scale.low + share * (scale.high - scale.low)));
    std::copy(bytes.begin(), bytes.end(), colours.pixels.begin() + static_cast<std::ptrdiff_t>(3 * row));
  }
  const Rectangle bar{ place.left, top, BarWidth * size, height };
  drawing.Place(colours, bar);
  LineStyle frame;
  frame.ink = style.ink;
  drawing.Frame(bar, frame);
  for (const double mark : scale.marks)
  {
    const double share = (mark - scale.low) / (scale.high - scale.low);
    if (share > 0.0 && share < 1.0)
    {
      const double y = bar.Bottom() - share * height;
      drawing.Line({ { bar.left, y }, { bar.Right(), y } }, frame);
    }
  }
  for (std::size_t n = 0; n < layout.numbers.size(); ++n)
  {
    const double share = static_cast<double>(n) / static_cast<double>(layout.numbers.size() - 1);
    drawing.TextAbout(layout.numbers[n], { bar.Right() + BarGap * size, bar.Bottom() - share * height }, style);
  }
}

} // namespace rhombic
