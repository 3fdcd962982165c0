#include "rhombicLabelPieces.h"

#include <algorithm>
#include <limits>
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

/** Joins the runs of neighbouring rows to pieces, through faces alone or through edges and corners too. */
void
JoinRuns(std::vector<Run> & runs, const std::vector<std::size_t> & firstOfRow, std::size_t height, bool byFace)
{
  const auto join = [&](std::size_t row, std::size_t other) {
    JoinRows(runs, firstOfRow[row], firstOfRow[row + 1], firstOfRow[other], firstOfRow[other + 1], byFace ? 0 : 1);
  };
  for (std::size_t row = 0; row + 1 < firstOfRow.size(); ++row)
  {
    const std::size_t y = row % height;
    if (y > 0)
    {
      join(row, row - 1);
    }
    if (row < height)
    {
      continue;
    }
    join(row, row - height);
    if (!byFace && y > 0)
    {
      join(row, row - height - 1);
    }
    if (!byFace && y + 1 < height)
    {
      join(row, row - height + 1);
    }
  }
}

/** The number of pieces of each label. */
std::vector<std::size_t>
CountPieces(const std::vector<Run> & runs, std::size_t labels)
{
  std::vector<std::size_t> counts(labels);
  for (std::size_t run = 0; run < runs.size(); ++run)
  {
    counts[runs[run].label] += runs[run].parent == run ? 1 : 0;
  }
  return counts;
}

} // namespace

LabelPieces
NumberPieces(LabelImage & image, std::size_t labels)
{
  const auto & size = image.GetBufferedRegion().GetSize();
  auto [runs, firstOfRow] = FindRuns(image);
  LabelPieces pieces;
  JoinRuns(runs, firstOfRow, size[1], true);
  pieces.countsByFace = CountPieces(runs, labels);
  JoinRuns(runs, firstOfRow, size[1], false);
  pieces.counts = CountPieces(runs, labels);

  const std::size_t most = std::numeric_limits<std::uint16_t>::max() / std::max<std::size_t>(labels - 1, 1);
  pieces.labels = { 0 };
  std::vector<std::size_t> next(labels); // number of a label's next piece, and of its last
  std::vector<std::size_t> last(labels);
  for (std::size_t label = 1; label < labels; ++label)
  {
    next[label] = pieces.labels.size();
    pieces.labels.resize(next[label] + std::min(pieces.counts[label], most), static_cast<std::uint16_t>(label));
    last[label] = pieces.labels.size() - 1;
  }
  // The root of a piece is its first run, so its number is known before those of the others.
  std::vector<std::uint16_t> numbers(runs.size());
  for (std::size_t row = 0; row + 1 < firstOfRow.size(); ++row)
  {
    for (std::size_t run = firstOfRow[row]; run < firstOfRow[row + 1]; ++run)
    {
      const std::uint32_t root = FindRoot(runs, static_cast<std::uint32_t>(run));
      std::size_t & number = next[runs[run].label];
      numbers[run] =
        root == run ? static_cast<std::uint16_t>(std::min(number++, last[runs[run].label])) : numbers[root];
      std::fill(image.GetBufferPointer() + row * size[0] + runs[run].begin,
                image.GetBufferPointer() + row * size[0] + runs[run].end,
                numbers[run]);
    }
  }
  return pieces;
}

} // namespace rhombic
