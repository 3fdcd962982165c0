#include "rhombicLegend.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

constexpr std::size_t FewestRowsOfGroups = 10;
constexpr double LegendPitch = 1.4;            // this and the next two are multiples of the text's size
constexpr double LegendIndent = 1.3;           // of names behind their swatches
constexpr double LegendGap = 0.8;              // between names and volumes
constexpr double SmallestLegendShare = 0.42;   // of the style's size
constexpr double SmallestLegendText = 9.0;     // pixels
constexpr double SmallestNameShrinking = 0.78; // of a name that is too wide: Drawing::Text() shortens it below 0.75

LegendLayout
FitText(const Drawing & drawing,
        const std::vector<LegendLine> & lines,
        const TextStyle & style,
        double largestWidth,
        double height,
        bool hasVolumes)
{
  double nameWidth = 0.0; // in multiples of the size
  double volumeWidth = 0.0;
  for (const LegendLine & line : lines)
  {
    nameWidth =
      std::max(nameWidth, 1.01 * drawing.WidthOf(line.row ? line.row->name : line.heading, style) / style.size);
    if (hasVolumes && line.row && line.row->volume)
    {
      volumeWidth = std::max(volumeWidth, drawing.WidthOf(FormatVolume(*line.row->volume) + " ml", style) / style.size);
    }
  }
  const double beside = LegendIndent + (volumeWidth > 0.0 ? LegendGap + volumeWidth : 0.0);
  const double smallest = std::min(style.size, std::max(SmallestLegendShare * style.size, SmallestLegendText));
  LegendLayout layout;
  layout.lines = lines;
  for (layout.size = style.size;; layout.size = std::max(0.97 * layout.size, smallest))
  {
    const double available = largestWidth - beside * layout.size;
    layout.nameWidth = std::max(1.0, std::min(nameWidth * layout.size, available));
    layout.volumeWidth = volumeWidth * layout.size;
    layout.shortensNames = layout.nameWidth < SmallestNameShrinking * nameWidth * layout.size;
    layout.shown = static_cast<std::size_t>(std::max(1.0, height / (LegendPitch * layout.size)));
    if ((!layout.shortensNames && layout.shown >= lines.size()) || layout.size <= smallest)
    {
      break;
    }
  }
  layout.shown = std::min(layout.shown, lines.size());
  return layout;
}

} // namespace

std::vector<LegendLine>
GroupLegend(const std::vector<LegendRow> & rows)
{
  std::vector<std::string> groups;
  for (const LegendRow & row : rows)
  {
    if (!row.group.empty() && std::find(groups.begin(), groups.end(), row.group) == groups.end())
    {
      groups.push_back(row.group);
    }
  }
  groups.emplace_back();
  std::vector<std::vector<LegendLine>> linesOf(groups.size());
  for (const LegendRow & row : rows)
  {
    const auto group = std::find(groups.begin(), groups.end(), row.group) - groups.begin();
    linesOf[static_cast<std::size_t>(group)].push_back({ "", &row });
  }
  const auto used = std::count_if(linesOf.begin(), linesOf.end(), [](const auto & lines) { return !lines.empty(); });
  const bool hasHeadings = rows.size() >= FewestRowsOfGroups && used > 1;
  std::vector<LegendLine> all;
  for (std::size_t n = 0; n < groups.size(); ++n)
  {
    if (hasHeadings && !linesOf[n].empty())
    {
      all.push_back({ groups[n].empty() ? "other" : groups[n], nullptr });
    }
    all.insert(all.end(), linesOf[n].begin(), linesOf[n].end());
  }
  return all;
}

double
LegendLayout::Width() const
{
  return lines.empty() ? 0.0
                       : LegendIndent * size + nameWidth + (volumeWidth > 0.0 ? LegendGap * size + volumeWidth : 0.0);
}

LegendLayout
FitLegend(const Drawing & drawing,
          const std::vector<LegendRow> & legend,
          const TextStyle & style,
          double largestWidth,
          double height)
{
  if (legend.empty())
  {
    return {};
  }
  const std::vector<LegendLine> lines = GroupLegend(legend);
  const LegendLayout layout = FitText(drawing, lines, style, largestWidth, height, true);
  return layout.shortensNames ? FitText(drawing, lines, style, largestWidth, height, false) : layout;
}

void
DrawLegend(Drawing & drawing, const LegendLayout & layout, const PicturePosition & topLeft, const TextStyle & style)
{
  TextStyle name = style;
  name.size = layout.size;
  TextStyle volume = name;
  volume.alignment = Alignment::Right;
  TextStyle heading = name;
  heading.ink.opacity *= 0.75;
  name.largestWidth = layout.nameWidth;
  const bool isWhole = layout.shown == layout.lines.size();
  for (std::size_t i = 0; i < layout.shown; ++i)
  {
    const LegendLine & line = layout.lines[i];
    const double x = topLeft.x;
    const double y = topLeft.y + (static_cast<double>(i) + 0.5) * LegendPitch * layout.size;
    if (!isWhole && i + 1 == layout.shown)
    {
      const auto isRow = [](const LegendLine & other) { return other.row != nullptr; };
      const auto left = std::count_if(layout.lines.begin() + static_cast<std::ptrdiff_t>(i), layout.lines.end(), isRow);
      drawing.TextAbout("and " + std::to_string(left) + " more", { x, y }, name);
    }
    else if (!line.row)
    {
      heading.largestWidth = layout.Width();
      drawing.TextAbout(line.heading, { x, y + 0.1 * layout.size }, heading);
    }
    else
    {
      const Rectangle swatch{ x, y - 0.42 * layout.size, 0.84 * layout.size, 0.84 * layout.size };
      drawing.Fill(swatch.Inset(-0.07 * layout.size), style.halo, 0.2 * layout.size);
      drawing.Fill(swatch, { line.row->colour }, 0.15 * layout.size);
      drawing.TextAbout(line.row->name, { x + LegendIndent * layout.size, y }, name);
      if (layout.volumeWidth > 0.0 && line.row->volume)
      {
        drawing.TextAbout(FormatVolume(*line.row->volume) + " ml", { x + layout.Width(), y }, volume);
      }
    }
  }
}

} // namespace rhombic
