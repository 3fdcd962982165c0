#include "rhombicSilhouette.h"

#include "rhombicSeenNumbers.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <unordered_map>
#include <utility>

namespace rhombic
{
namespace
{

/** Steps along the border of a surface: from the middle of the side between two pixels to the next one. Sides are
 * numbered by their first pixel, those towards x with even numbers, those towards y with odd ones. */
using Steps = std::unordered_map<std::size_t, std::size_t>;

/** Pixels of a row, with one more on either side. */
std::size_t
RowLength(const SeenNumbers & seen)
{
  return static_cast<std::size_t>(seen.width) + 2;
}

/** Adds the steps within a square of four pixels' centres, for each surface that some of them show. */
void
AddSteps(const SeenNumbers & seen, int x, int y, std::vector<Steps> & steps)
{
  const std::array<std::size_t, 4> corners{
    seen.At(x, y), seen.At(x + 1, y), seen.At(x + 1, y + 1), seen.At(x, y + 1)
  };
  const std::size_t width = RowLength(seen);
  const std::size_t first = static_cast<std::size_t>(y + 1) * width + static_cast<std::size_t>(x + 1);
  const std::array<std::size_t, 4> sides{
    2 * first, 2 * (first + 1) + 1, 2 * (first + width), 2 * first + 1
  }; // from each corner to the next
  for (std::size_t begin = 0; begin < corners.size(); ++begin)
  {
    const std::size_t before = (begin + 3) % 4;
    const std::size_t number = corners[begin];
    if (number == SeenNumbers::None || corners[before] == number)
    {
      continue;
    }
    std::size_t last = begin; // of the corners one after the other that show the surface
    while (corners[(last + 1) % 4] == number)
    {
      last = (last + 1) % 4;
    }
    steps[number][sides[before]] = sides[last];
  }
}

/** The middle of a side, in the picture's pixels. */
PicturePosition
MiddleOf(std::size_t side, std::size_t width)
{
  const std::size_t pixel = side / 2;
  const auto x = static_cast<double>(pixel % width) - 0.5; // of the centre; a pixel lies around the picture
  const auto y = static_cast<double>(pixel / width) - 0.5;
  return side % 2 == 0 ? PicturePosition{ x + 0.5, y } : PicturePosition{ x, y + 0.5 };
}

} // namespace

std::vector<ColouredOutline>
FindSilhouettes(const std::vector<SceneSurface> & surfaces, const Projection & projection, const Colour & ink)
{
  const SeenNumbers seen = FindSeenNumbers({ surfaces, {}, {} }, projection);
  std::vector<Steps> steps(surfaces.size());
  for (int y = -1; y < seen.height; ++y)
  {
    for (int x = -1; x < seen.width; ++x)
    {
      AddSteps(seen, x, y, steps);
    }
  }
  std::vector<ColouredOutline> outlines;
  for (Steps & ofSurface : steps)
  {
    std::vector<std::size_t> starts;
    std::transform(
      ofSurface.begin(), ofSurface.end(), std::back_inserter(starts), [](const auto & step) { return step.first; });
    std::sort(starts.begin(), starts.end()); // the same order in each run
    for (const std::size_t start : starts)
    {
      ColouredOutline outline{ {}, ink, true, false };
      for (auto step = ofSurface.find(start); step != ofSurface.end();)
      {
        const auto [side, next] = *step;
        outline.points.push_back(MiddleOf(side, RowLength(seen)));
        ofSurface.erase(step);
        step = ofSurface.find(next);
      }
      if (!outline.points.empty())
      {
        outlines.push_back(std::move(outline));
      }
    }
  }
  return outlines;
}

} // namespace rhombic
