#include "rhombicPageVolume.h"

#include "rhombicForEachBlock.h"
#include "rhombicGreyWindow.h"
#include "rhombicPageBytes.h"
#include "rhombicSlicePicture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rhombic
{
namespace
{

constexpr int LargestSide = 256; // samples; each browser with WebGL2 takes 3D textures of this size

/** The grid, and how many samples along each axis are averaged for one of its samples. */
struct Grid
{
  std::array<int, 3> size{};
  std::array<int, 3> parts{};
  Vector3 lowest{};
  double fine = 1.0; ///< mm: the distance of averaged samples along x and y
  Vector3 spacing{};
};

/** The distance of samples along each patient axis: that of the side which is nearest to the axis. */
Vector3
SpacingAlongAxes(const SliceBox & box)
{
  Vector3 spacing{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    double nearest = -1.0;
    for (std::size_t side = 0; side < 3; ++side)
    {
      const double length = Length(box.sides[side]);
      const double share = length > 0.0 ? std::abs(box.sides[side][axis]) / length : 0.0;
      if (share > nearest)
      {
        nearest = share;
        spacing[axis] = box.spacing[side];
      }
    }
  }
  return spacing;
}

Grid
PlanGrid(const SliceBox & box)
{
  const Vector3 native = SpacingAlongAxes(box);
  Grid grid;
  grid.fine = std::min(native[0], native[1]);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    double lowest = box.corner[axis];
    double extent = 0.0;
    for (const Vector3 & side : box.sides)
    {
      lowest += std::min(0.0, side[axis]);
      extent += std::abs(side[axis]);
    }
    const double fine = axis == 2 ? native[2] : grid.fine;
    constexpr double rounding = 1e-6; // of an extent that is a whole number of samples
    const int samples = std::max(1, static_cast<int>(std::ceil(extent / fine - rounding)));
    const int wanted = std::max(1, static_cast<int>(std::floor(native[axis] / fine + rounding)));
    grid.parts[axis] = std::max(wanted, (samples + LargestSide - 1) / LargestSide);
    grid.size[axis] = (samples + grid.parts[axis] - 1) / grid.parts[axis];
    grid.spacing[axis] = grid.parts[axis] * fine;
    grid.lowest[axis] = lowest + 0.5 * (extent - grid.size[axis] * grid.spacing[axis]);
  }
  return grid;
}

/** The means of the scan's values at the samples of one slice of the grid; not a number outside. */
std::vector<float>
MeansOfSlice(const Scan & scan, const Grid & grid, int slice)
{
  Projection plane;
  plane.frame = FrameOf(SlicePlane::Axial);
  plane.pixelSize = grid.fine;
  plane.width = grid.size[0] * grid.parts[0];
  plane.height = grid.size[1] * grid.parts[1];
  const auto columns = static_cast<std::size_t>(grid.size[0]);
  std::vector<float> sums(columns * static_cast<std::size_t>(grid.size[1]));
  std::vector<int> counts(sums.size());
  for (int part = 0; part < grid.parts[2]; ++part)
  {
    const double z = grid.lowest[2] + (slice + (part + 0.5) / grid.parts[2]) * grid.spacing[2];
    plane.centre = { grid.lowest[0] + 0.5 * plane.width * grid.fine,
                     grid.lowest[1] + 0.5 * plane.height * grid.fine,
                     z };
    const std::vector<float> values = SliceValues(scan, plane);
    for (std::size_t n = 0; n < values.size(); ++n)
    {
      const std::size_t x = n % static_cast<std::size_t>(plane.width) / static_cast<std::size_t>(grid.parts[0]);
      const std::size_t y = n / static_cast<std::size_t>(plane.width) / static_cast<std::size_t>(grid.parts[1]);
      if (!std::isnan(values[n]))
      {
        sums[y * columns + x] += values[n];
        ++counts[y * columns + x];
      }
    }
  }
  for (std::size_t n = 0; n < sums.size(); ++n)
  {
    sums[n] = counts[n] > 0 ? sums[n] / static_cast<float>(counts[n]) : std::numeric_limits<float>::quiet_NaN();
  }
  return sums;
}

std::vector<double>
LevelsOfHounsfieldUnits()
{
  struct Range
  {
    double end;
    double step;
  };
  std::vector<double> levels{ -1000.0 };
  for (const Range & range : { Range{ -200.0, 12.5 }, Range{ 300.0, 4.0 }, Range{ 1500.0, 19.0 } })
  {
    while (levels.back() + range.step <= range.end + 0.5 * range.step)
    {
      levels.push_back(levels.back() + range.step);
    }
  }
  return levels;
}

/** Even levels between percentiles of a few slices' values. */
std::vector<double>
EvenLevels(const Scan & scan, const Grid & grid)
{
  constexpr int slices = 16;
  constexpr int count = 255;
  constexpr double share = 0.0005;
  std::vector<float> values;
  for (int n = 0; n < std::min(slices, grid.size[2]); ++n)
  {
    for (const float value :
         MeansOfSlice(scan, grid, (2 * n + 1) * grid.size[2] / (2 * std::min(slices, grid.size[2]))))
    {
      if (std::isfinite(value))
      {
        values.push_back(value);
      }
    }
  }
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size()) - 1.0;
  double lowest = values.empty() ? 0.0 : values[static_cast<std::size_t>(share * last)];
  double highest = values.empty() ? 1.0 : values[static_cast<std::size_t>((1.0 - share) * last)];
  highest = highest > lowest ? highest : lowest + 1.0;
  std::vector<double> levels;
  for (int n = 0; n < count; ++n)
  {
    levels.push_back(lowest + (highest - lowest) * n / (count - 1));
  }
  return levels;
}

std::uint8_t
NumberOf(double value, const std::vector<double> & levels)
{
  if (std::isnan(value))
  {
    return 0;
  }
  const auto above = std::lower_bound(levels.begin(), levels.end(), value);
  auto n = above - levels.begin();
  if (above == levels.end() || (n > 0 && value - levels[static_cast<std::size_t>(n - 1)] < *above - value))
  {
    --n;
  }
  return static_cast<std::uint8_t>(n + 1);
}

/** Half of the largest distance of neighbouring levels in the range of soft tissue, or of all. */
double
LargestErrorOf(const std::vector<double> & levels, bool isInHounsfieldUnits)
{
  double largest = 0.0;
  for (std::size_t n = 1; n < levels.size(); ++n)
  {
    if (!isInHounsfieldUnits || (levels[n - 1] >= -200.0 && levels[n] <= 302.0))
    {
      largest = std::max(largest, 0.5 * (levels[n] - levels[n - 1]));
    }
  }
  return largest;
}

std::uint8_t
Predict(int left, int upper, int upperLeft)
{
  return static_cast<std::uint8_t>(std::clamp(left + upper - upperLeft, std::min(left, upper), std::max(left, upper)));
}

} // namespace

PageVolume
MakePageVolume(const Scan & scan, const SliceBox & box)
{
  const Grid grid = PlanGrid(box);
  PageVolume volume;
  volume.size = grid.size;
  volume.spacing = grid.spacing;
  volume.origin = Add(grid.lowest, Scaled(grid.spacing, 0.5));
  const bool isInHounsfieldUnits = IsInHounsfieldUnits(scan);
  volume.levels = isInHounsfieldUnits ? LevelsOfHounsfieldUnits() : EvenLevels(scan, grid);
  volume.largestError = LargestErrorOf(volume.levels, isInHounsfieldUnits);
  volume.isResampled = IsSlanted(scan);
  for (const Vector3 & side : box.sides)
  {
    constexpr double straight = 0.9999;
    const double longest = std::max({ std::abs(side[0]), std::abs(side[1]), std::abs(side[2]) });
    volume.isResampled = volume.isResampled || longest < straight * Length(side);
  }
  for (int slice = 0; slice < grid.size[2]; ++slice)
  {
    for (const float value : MeansOfSlice(scan, grid, slice))
    {
      volume.numbers.push_back(NumberOf(value, volume.levels));
    }
  }
  return volume;
}

PageVolume
Coarsen(const PageVolume & volume, int factor, int step)
{
  PageVolume coarse = volume;
  coarse.levels.clear();
  coarse.numbers.clear();
  coarse.largestError = volume.largestError * factor;
  for (std::size_t n = 0; n < volume.levels.size(); n += static_cast<std::size_t>(factor))
  {
    coarse.levels.push_back(volume.levels[n]);
  }
  std::array<std::uint8_t, 256> numbers{};
  for (std::size_t n = 0; n < volume.levels.size(); ++n)
  {
    numbers[n + 1] = NumberOf(volume.levels[n], coarse.levels);
  }
  const std::size_t slice = static_cast<std::size_t>(volume.size[0]) * static_cast<std::size_t>(volume.size[1]);
  coarse.size[2] = (volume.size[2] + step - 1) / step;
  coarse.spacing[2] = volume.spacing[2] * step;
  for (int z = 0; z < volume.size[2]; z += step)
  {
    const auto first = volume.numbers.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(z) * slice);
    std::transform(first,
                   first + static_cast<std::ptrdiff_t>(slice),
                   std::back_inserter(coarse.numbers),
                   [&numbers](std::uint8_t number) { return numbers[number]; });
  }
  return coarse;
}

std::vector<std::string>
EncodeVolume(const PageVolume & volume, int slicesOfBlock)
{
  const auto columns = static_cast<std::size_t>(volume.size[0]);
  const std::size_t slice = columns * static_cast<std::size_t>(volume.size[1]);
  std::vector<std::string> blocks(static_cast<std::size_t>((volume.size[2] + slicesOfBlock - 1) / slicesOfBlock));
  ForEachOnThreads(blocks.size(), [&](std::size_t block) {
    const std::size_t begin = block * static_cast<std::size_t>(slicesOfBlock) * slice;
    const std::size_t end = std::min(begin + static_cast<std::size_t>(slicesOfBlock) * slice, volume.numbers.size());
    std::string differences(end - begin, '\0');
    for (std::size_t n = begin; n < end; ++n)
    {
      const std::size_t place = n % slice;
      const bool hasLeft = place % columns > 0;
      const bool hasUpper = place >= columns;
      const int left = hasLeft ? volume.numbers[n - 1] : 0;
      const int upper = hasUpper ? volume.numbers[n - columns] : 0;
      const int upperLeft = hasLeft && hasUpper ? volume.numbers[n - columns - 1] : 0;
      differences[n - begin] = static_cast<char>(volume.numbers[n] - Predict(left, upper, upperLeft));
    }
    blocks[block] = Deflate(differences, DeflateSearch::Runs);
  });
  return blocks;
}

} // namespace rhombic
