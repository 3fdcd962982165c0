#include "rhombicOpenTiles.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

/** The tile at a position in tiles. */
int
TileAt(double position, int count)
{
  return static_cast<int>(std::clamp(std::floor(position), 0.0, static_cast<double>(count - 1)));
}

} // namespace

Footprint
FootprintOf(const std::array<float, 3> & lowest, const std::array<float, 3> & highest, const Camera & camera)
{
  constexpr float slack = 1e-4f;
  const auto matrix = camera.Matrix();
  Footprint box{ 2.0f, -1.0f, 2.0f, -1.0f, 1.0f, 0.0f };
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    std::array<float, 4> clip{ matrix[12], matrix[13], matrix[14], matrix[15] };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const float coordinate = (corner >> axis & 1U) != 0 ? highest[axis] : lowest[axis];
      for (std::size_t row = 0; row < 4; ++row)
      {
        clip[row] += matrix[4 * axis + row] * (coordinate - static_cast<float>(camera.centre[axis]));
      }
    }
    if (clip[3] <= 0.0f) // beside or behind the viewer
    {
      return {};
    }
    box.left = std::min(box.left, 0.5f + 0.5f * clip[0] / clip[3] - slack);
    box.right = std::max(box.right, 0.5f + 0.5f * clip[0] / clip[3] + slack);
    box.bottom = std::min(box.bottom, 0.5f + 0.5f * clip[1] / clip[3] - slack);
    box.top = std::max(box.top, 0.5f + 0.5f * clip[1] / clip[3] + slack);
    box.nearest = std::min(box.nearest, 0.5f + 0.5f * clip[2] / clip[3]);
    box.farthest = std::max(box.farthest, 0.5f + 0.5f * clip[2] / clip[3] + slack);
  }
  return box;
}

bool
OpenTiles::MayShow(const Footprint & footprint) const
{
  if (footprint.right < 0.0f || footprint.left > 1.0f || footprint.top < 0.0f || footprint.bottom > 1.0f)
  {
    return false;
  }
  const int lastColumn = TileAt(footprint.right * width, columns);
  const int lastRow = TileAt(footprint.top * height, rows);
  for (int row = TileAt(footprint.bottom * height, rows); row <= lastRow; ++row)
  {
    for (int column = TileAt(footprint.left * width, columns); column <= lastColumn; ++column)
    {
      if (depths[static_cast<std::size_t>(row * columns + column)] < footprint.farthest)
      {
        return true;
      }
    }
  }
  return false;
}

bool
OpenTiles::AllAreClosed() const
{
  return std::all_of(depths.begin(), depths.end(), [](float depth) { return depth == Closed; });
}

} // namespace rhombic
