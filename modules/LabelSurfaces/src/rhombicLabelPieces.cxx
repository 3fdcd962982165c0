#include "rhombicLabelPieces.h"

#include <algorithm>
#include <utility>

namespace rhombic
{
namespace
{

using LabelImage = itk::Image<std::uint16_t, 3>;

/** Voxels [begin, end) of a row that have one label. Runs of one piece are a tree of parents. */
struct Run
{
  std::uint32_t begin;
  std::uint32_t end;
  std::uint32_t parent;
  std::uint16_t label;
};

/** The runs of all rows that are not 0, and the first run of each row. */
std::pair<std::vector<Run>, std::vector<std::size_t>>
FindRuns(const LabelImage & image)
{
  const auto & size = image.GetBufferedRegion().GetSize();
  const auto width = static_cast<std::uint32_t>(size[0]);
  const std::uint16_t * row = image.GetBufferPointer();
  std::vector<Run> runs;
  std::vector<std::size_t> firstOfRow;
  for (std::size_t n = 0; n < size[1] * size[2]; ++n, row += width)
  {
    firstOfRow.push_back(runs.size());
    for (std::uint32_t begin = 0, end = 0; begin < width; begin = end)
    {
      const std::uint16_t label = row[begin];
      end = static_cast<std::uint32_t>(
        std::find_if(row + begin, row + width, [label](std::uint16_t other) { return other != label; }) - row);
      if (label != 0)
      {
        runs.push_back({ begin, end, static_cast<std::uint32_t>(runs.size()), label });
      }
    }
  }
  firstOfRow.push_back(runs.size());
  return { runs, firstOfRow };
}

std::uint32_t
FindRoot(std::vector<Run> & runs, std::uint32_t run)
{
  while (runs[run].parent != run)
  {
    run = runs[run].parent = runs[runs[run].parent].parent;
  }
  return run;
}

/** Joins runs of one label, of the rows [one, oneEnd) and [other, otherEnd), that overlap or are less than \a reach
 * voxels apart. */
void
JoinRows(std::vector<Run> & runs,
         std::size_t one,
         std::size_t oneEnd,
         std::size_t other,
         std::size_t otherEnd,
         std::uint32_t reach)
{
  for (; one < oneEnd; ++one)
  {
    while (other < otherEnd && runs[other].end + reach <= runs[one].begin)
    {
      ++other;
    }
    for (std::size_t n = other; n < otherEnd && runs[n].begin < runs[one].end + reach; ++n)
    {
      if (runs[n].label == runs[one].label)
      {
        const std::uint32_t a = FindRoot(runs, static_cast<std::uint32_t>(one));
        const std::uint32_t b = FindRoot(runs, static_cast<std::uint32_t>(n));
        runs[std::max(a, b)].parent = std::min(a, b);
      }
    }
  }
}

} // namespace

std::vector<std::size_t>
CountPieces(const LabelImage & image, std::size_t labels, bool throughFacesOnly)
{
  auto [runs, firstOfRow] = FindRuns(image);
  const std::size_t height = image.GetBufferedRegion().GetSize(1);
  const std::uint32_t reach = throughFacesOnly ? 0 : 1;
  for (std::size_t row = 0; row + 1 < firstOfRow.size(); ++row)
  {
    const auto join = [&, &allRuns = runs, &first = firstOfRow](std::size_t other) {
      JoinRows(allRuns, first[row], first[row + 1], first[other], first[other + 1], reach);
    };
    const std::size_t y = row % height;
    if (y > 0)
    {
      join(row - 1);
    }
    if (row >= height)
    {
      join(row - height);
    }
    if (row >= height && !throughFacesOnly && y > 0)
    {
      join(row - height - 1);
    }
    if (row >= height && !throughFacesOnly && y + 1 < height)
    {
      join(row - height + 1);
    }
  }
  std::vector<std::size_t> counts(labels);
  for (std::size_t run = 0; run < runs.size(); ++run)
  {
    counts[runs[run].label] += runs[run].parent == run ? 1 : 0;
  }
  return counts;
}

} // namespace rhombic
