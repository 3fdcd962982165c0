#include "rhombicLabelNumbers.h"

#include "itkBulkAllocator.h"
#include "itkBulkImage.h"
#include "rhombicFailure.h"
#include "rhombicForEachBlock.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

namespace rhombic
{
namespace
{

/** The values of the labels with this value, or a name that fits (see MatchesPattern()). A label that has exactly this
 * name counts alone. Throws Failure(Usage) when there are none. */
std::set<std::int32_t>
FindValues(const std::vector<LabelSummary> & labels, const std::string & nameOrValue)
{
  std::set<std::int32_t> exact;
  std::set<std::int32_t> fitting;
  std::vector<std::string> names;
  for (const LabelSummary & summary : labels)
  {
    const Label & label = summary.label;
    if (label.name == nameOrValue || std::to_string(label.value) == nameOrValue)
    {
      exact.insert(label.value);
    }
    if (MatchesPattern(nameOrValue, label.name))
    {
      fitting.insert(label.value);
    }
    names.push_back(label.name);
  }
  if (exact.empty() && fitting.empty())
  {
    throw Failure(FailureKind::Usage,
                  DescribeUnknown("label", nameOrValue, names, "see rhombic info for the label map's labels"));
  }
  return exact.empty() ? fitting : exact;
}

/** The number of a value: its place in the ascending list, from 1; 0 for a value that the list does not have. */
template <typename TPixel>
std::uint16_t
NumberOf(TPixel value, const std::vector<std::int32_t> & values)
{
  const auto found = std::lower_bound(values.begin(), values.end(), static_cast<std::int32_t>(value));
  return found != values.end() && *found == static_cast<std::int32_t>(value)
           ? static_cast<std::uint16_t>(found - values.begin() + 1)
           : 0;
}

/** Voxels [begin, end) of a row that have one label. Runs of one piece are a tree of parents. */
struct Run
{
  std::uint32_t begin;
  std::uint32_t end;
  std::uint32_t parent;
  std::uint16_t label;
};

using Runs = itk::BulkVector<Run>;
using RowBegins = itk::BulkVector<std::size_t>; ///< the first run of each row

/** The runs of all rows that are not 0, and the first run of each row. */
std::pair<Runs, RowBegins>
FindRuns(const NumberImage & image)
{
  const auto & size = image.GetBufferedRegion().GetSize();
  Runs runs;
  RowBegins firstOfRow;
  for (std::size_t row = 0; row < size[1] * size[2]; ++row)
  {
    firstOfRow.push_back(runs.size());
    ForEachRun(image.GetBufferPointer() + row * size[0],
               size[0],
               [&runs](std::uint16_t label, std::size_t begin, std::size_t end) {
                 if (label != 0)
                 {
                   runs.push_back({ static_cast<std::uint32_t>(begin),
                                    static_cast<std::uint32_t>(end),
                                    static_cast<std::uint32_t>(runs.size()),
                                    label });
                 }
               });
  }
  firstOfRow.push_back(runs.size());
  return { std::move(runs), std::move(firstOfRow) };
}

std::uint32_t
FindRoot(Runs & runs, std::uint32_t run)
{
  while (runs[run].parent != run)
  {
    run = runs[run].parent = runs[runs[run].parent].parent;
  }
  return run;
}

/** Joins runs of one label in two rows that overlap or are less than \a reach voxels apart. */
void
JoinRows(Runs & runs, const RowBegins & firstOfRow, std::size_t row, std::size_t otherRow, std::uint32_t reach)
{
  std::size_t first = firstOfRow[otherRow]; // run of the other row that a run of this row can reach
  const std::size_t end = firstOfRow[otherRow + 1];
  for (std::size_t n = firstOfRow[row]; n < firstOfRow[row + 1]; ++n)
  {
    while (first < end && runs[first].end + reach <= runs[n].begin)
    {
      ++first;
    }
    for (std::size_t other = first; other < end && runs[other].begin < runs[n].end + reach; ++other)
    {
      if (runs[other].label == runs[n].label)
      {
        const std::uint32_t a = FindRoot(runs, static_cast<std::uint32_t>(n));
        const std::uint32_t b = FindRoot(runs, static_cast<std::uint32_t>(other));
        runs[std::max(a, b)].parent = std::min(a, b);
      }
    }
  }
}

/** Joins the runs of neighbouring rows to pieces, through faces alone or through edges and corners too. */
void
JoinRuns(Runs & runs, const RowBegins & firstOfRow, std::size_t height, bool byFace)
{
  constexpr std::ptrdiff_t steps[][2] = { { -1, 0 }, { 0, -1 }, { -1, -1 }, { 1, -1 } }; // in y and z; two to faces
  const auto rows = static_cast<std::ptrdiff_t>(height);
  for (std::size_t row = 0; row + 1 < firstOfRow.size(); ++row)
  {
    for (unsigned int n = 0; n < (byFace ? 2 : 4); ++n)
    {
      const std::ptrdiff_t y = static_cast<std::ptrdiff_t>(row) % rows + steps[n][0];
      const std::ptrdiff_t other = static_cast<std::ptrdiff_t>(row) + steps[n][0] + steps[n][1] * rows;
      if (y >= 0 && y < rows && other >= 0)
      {
        JoinRows(runs, firstOfRow, row, static_cast<std::size_t>(other), byFace ? 0 : 1);
      }
    }
  }
}

/** The number of pieces of each label. */
std::vector<std::size_t>
CountPieces(const Runs & runs, std::size_t labels)
{
  std::vector<std::size_t> counts(labels);
  for (std::size_t run = 0; run < runs.size(); ++run)
  {
    counts[runs[run].label] += runs[run].parent == run ? 1 : 0;
  }
  return counts;
}

} // namespace

std::vector<LabelSummary>
ChooseLabels(const LabelMap & map, const std::vector<std::string> & wanted)
{
  std::set<std::int32_t> values;
  for (const std::string & nameOrValue : wanted)
  {
    values.merge(FindValues(map.labels, nameOrValue));
  }
  std::vector<LabelSummary> chosen;
  std::copy_if(map.labels.begin(), map.labels.end(), std::back_inserter(chosen), [&](const LabelSummary & summary) {
    return wanted.empty() ? summary.label.isVisible && summary.label.opacity > 0.0
                          : values.count(summary.label.value) != 0;
  });
  if (chosen.empty())
  {
    throw Failure(FailureKind::Empty,
                  map.labels.empty() ? "The label map holds nothing but background; check that it was exported whole."
                                     : "The label table hides all labels of the map; name those to show.");
  }
  return chosen;
}

itk::Size<3>
MarginOfPart(const itk::ImageBase<3> & grid)
{
  constexpr double shortestEdges = 6.0;
  constexpr double fewestVoxels = 4.0;
  const auto & spacing = grid.GetSpacing();
  const double reach = shortestEdges * std::min({ spacing[0], spacing[1], spacing[2] });
  itk::Size<3> margin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    margin[axis] = static_cast<itk::SizeValueType>(std::ceil(std::max(fewestVoxels, reach / spacing[axis])));
  }
  return margin;
}

void
NumberRows(const ScanImage & image,
           const std::vector<LabelSummary> & labels,
           const itk::ImageRegion<3> & region,
           std::uint16_t * numbers)
{
  std::vector<std::int32_t> values;
  std::transform(labels.begin(), labels.end(), std::back_inserter(values), [](const LabelSummary & summary) {
    return summary.label.value;
  });
  const auto & size = region.GetSize();
  const auto number = [&](const auto & voxels) {
    for (std::size_t row = 0; row < size[1] * size[2]; ++row, numbers += size[0])
    {
      itk::Index<3> first = region.GetIndex();
      first[1] += static_cast<itk::IndexValueType>(row % size[1]);
      first[2] += static_cast<itk::IndexValueType>(row / size[1]);
      const auto * const from = voxels->GetBufferPointer() + voxels->ComputeOffset(first);
      for (std::size_t n = 0; n < size[0]; ++n)
      {
        numbers[n] = n > 0 && from[n] == from[n - 1] ? numbers[n - 1] : NumberOf(from[n], values);
      }
    }
  };
  std::visit(number, image);
}

NumberImage::Pointer
NumberLabels(const ScanImage & image, const std::vector<LabelSummary> & labels)
{
  const itk::ImageBase<3> & grid = GeometryOf(image);
  const auto numbers = NumberImage::New();
  numbers->CopyInformation(&grid);
  numbers->SetRegions(grid.GetBufferedRegion());
  itk::AllocateInBulk(*numbers);
  ForEachInBlocks(numbers->GetBufferedRegion().GetSize(2), 1, [&](std::size_t z) {
    itk::ImageRegion<3> slice = numbers->GetBufferedRegion();
    slice.SetIndex(2, slice.GetIndex(2) + static_cast<itk::IndexValueType>(z));
    slice.SetSize(2, 1);
    NumberRows(image, labels, slice, numbers->GetBufferPointer() + numbers->ComputeOffset(slice.GetIndex()));
  });
  return numbers;
}

LabelPieces
NumberPieces(NumberImage & image, std::size_t labels)
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
  itk::BulkVector<std::uint16_t> numbers(runs.size());
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
