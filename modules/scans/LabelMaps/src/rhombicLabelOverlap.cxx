#include "rhombicLabelOverlap.h"

#include "rhombicForEachBlock.h"
#include "rhombicSliceOrigins.h"
#include "rhombicVoxelGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace rhombic
{
namespace
{

using PointType = itk::Point<double, 3>;
using VectorType = itk::Vector<double, 3>;

/** Where the voxels of a map's slices are. */
struct Slices
{
  explicit Slices(const Scan & map)
    : grid(GeometryOf(map.image))
    , size(grid.GetLargestPossibleRegion().GetSize())
    , alongRow(StepAlong(grid, 0))
    , alongColumn(StepAlong(grid, 1))
    , origins(SliceOriginsOf(map))
  {}

  std::size_t
  GetVoxelsOfSlice() const
  {
    return size[0] * size[1];
  }

  PointType
  At(std::size_t slice, double column, double row) const
  {
    return origins[slice] + alongRow * column + alongColumn * row;
  }

  const itk::ImageBase<3> & grid;
  itk::Size<3> size;
  VectorType alongRow;
  VectorType alongColumn;
  std::vector<PointType> origins; ///< of each slice's first voxel
};

/** \class NearestVoxels
 * \brief Finds the voxel of a map nearest to a position. */
class NearestVoxels
{
public:
  static constexpr std::size_t None = std::numeric_limits<std::size_t>::max();

  explicit NearestVoxels(const Scan & map)
    : m_Slices(map)
    , m_Normal(itk::CrossProduct(m_Slices.alongRow, m_Slices.alongColumn))
  {
    const auto & size = m_Slices.size;
    const VectorType through =
      size[2] > 1 ? m_Slices.origins.back() - m_Slices.origins.front() : StepAlong(m_Slices.grid, 2);
    m_Normal /= m_Normal.GetNorm() * (m_Normal * through < 0.0 ? -1.0 : 1.0);
    m_ToColumn = itk::CrossProduct(m_Slices.alongColumn, m_Normal);
    m_ToColumn /= m_ToColumn * m_Slices.alongRow;
    m_ToRow = itk::CrossProduct(m_Slices.alongRow, m_Normal);
    m_ToRow /= m_ToRow * m_Slices.alongColumn;
    std::transform(m_Slices.origins.begin(),
                   m_Slices.origins.end(),
                   std::back_inserter(m_Heights),
                   [this](const PointType & origin) { return m_Normal * origin.GetVectorFromOrigin(); });
    m_HalfStep = size[2] > 1 ? (m_Heights.back() - m_Heights.front()) / static_cast<double>(2 * (size[2] - 1))
                             : std::abs(m_Normal * through) / 2.0;
  }

  /** The number of the voxel in the map's buffer; None outside of the map. */
  std::size_t
  Find(const PointType & position) const
  {
    const double height = m_Normal * position.GetVectorFromOrigin();
    if (height < m_Heights.front() - m_HalfStep || height >= m_Heights.back() + m_HalfStep)
    {
      return None;
    }
    auto slice =
      static_cast<std::size_t>(std::lower_bound(m_Heights.begin(), m_Heights.end(), height) - m_Heights.begin());
    if (slice == m_Heights.size() || (slice > 0 && height - m_Heights[slice - 1] < m_Heights[slice] - height))
    {
      --slice;
    }
    const VectorType inSlice = position - m_Slices.origins[slice];
    const double column = std::floor(inSlice * m_ToColumn + 0.5);
    const double row = std::floor(inSlice * m_ToRow + 0.5);
    const auto & size = m_Slices.size;
    if (column < 0.0 || row < 0.0 || column >= static_cast<double>(size[0]) || row >= static_cast<double>(size[1]))
    {
      return None;
    }
    return (slice * size[1] + static_cast<std::size_t>(row)) * size[0] + static_cast<std::size_t>(column);
  }

private:
  Slices m_Slices;
  VectorType m_Normal;           ///< of the slices, towards the last
  VectorType m_ToColumn{};       ///< its product with a vector in a slice is the number of columns
  VectorType m_ToRow{};          ///< and the number of rows
  std::vector<double> m_Heights; ///< of the slices along the normal
  double m_HalfStep;
};

/** The labels at \a count voxels from \a first on, in the buffer's order, as whole numbers. */
void
CopyLabels(const ScanImage & layer, std::size_t first, std::size_t count, std::vector<std::int32_t> & labels)
{
  std::visit(
    [&](const auto & image) {
      const auto * const begin = image->GetBufferPointer() + first;
      labels.resize(count);
      std::transform(begin, begin + count, labels.begin(), [](auto value) { return static_cast<std::int32_t>(value); });
    },
    layer);
}

std::int32_t
LabelAt(const ScanImage & layer, std::size_t voxel)
{
  return std::visit([voxel](const auto & image) { return static_cast<std::int32_t>(image->GetBufferPointer()[voxel]); },
                    layer);
}

/** Number of a label's voxels in a slice, sums of their columns and rows, and the box around them. */
struct SliceSums
{
  double count = 0.0;
  double columns = 0.0;
  double rows = 0.0;
  std::array<std::size_t, 2> lowest{ std::numeric_limits<std::size_t>::max(), std::numeric_limits<std::size_t>::max() };
  std::array<std::size_t, 2> highest{};

  /** Adds the voxels [begin, end) of a row. */
  void
  Add(std::size_t begin, std::size_t end, std::size_t row)
  {
    const auto length = static_cast<double>(end - begin);
    count += length;
    columns += length * static_cast<double>(begin + end - 1) / 2.0;
    rows += length * static_cast<double>(row);
    lowest = { std::min(lowest[0], begin), std::min(lowest[1], row) };
    highest = { std::max(highest[0], end - 1), std::max(highest[1], row) };
  }
};

/** Enlarges a region by a label's voxels in a slice. */
void
Enlarge(const Slices & slices, std::size_t slice, const SliceSums & label, itk::ImageRegion<3> & region)
{
  const itk::Index<3> first = slices.grid.GetLargestPossibleRegion().GetIndex();
  const bool isEmpty = region.GetNumberOfPixels() == 0;
  const std::array<std::size_t, 3> lowest{ label.lowest[0], label.lowest[1], slice };
  const std::array<std::size_t, 3> highest{ label.highest[0], label.highest[1], slice };
  itk::Index<3> low;
  itk::Index<3> high;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    low[axis] = first[axis] + static_cast<itk::IndexValueType>(lowest[axis]);
    high[axis] = first[axis] + static_cast<itk::IndexValueType>(highest[axis]);
    low[axis] = isEmpty ? low[axis] : std::min(low[axis], region.GetIndex(axis));
    high[axis] = isEmpty ? high[axis] : std::max(high[axis], region.GetUpperIndex()[axis]);
  }
  region.SetIndex(low);
  region.SetUpperIndex(high);
}

/** Whether two maps have the same voxels, at the same places. */
bool
HaveOneGrid(const Scan & first, const Scan & second)
{
  const auto & one = GeometryOf(first.image);
  const auto & two = GeometryOf(second.image);
  return one.GetLargestPossibleRegion() == two.GetLargestPossibleRegion() && one.GetOrigin() == two.GetOrigin() &&
         one.GetSpacing() == two.GetSpacing() && one.GetDirection() == two.GetDirection() &&
         first.sliceOrigins == second.sliceOrigins;
}

/** \class OverlapCounter
 * \brief Counts the voxels of each pair of labels, slice by slice of the first map. */
class OverlapCounter
{
public:
  using Counts = std::map<std::pair<std::int32_t, std::int32_t>, double>;

  OverlapCounter(const Scan & first, const Scan & second, const AffineMap * toSecond)
    : m_Slices(first)
    , m_Nearest(second)
    , m_First(LayersOf(first))
    , m_Second(LayersOf(second))
    , m_ToSecond(toSecond)
    , m_IsOneGrid(toSecond == nullptr && HaveOneGrid(first, second))
  {}

  /** Numbers of voxels by a label of the first map and one of the second. A voxel counts for each of its labels, with 0
   * for no label: of each layer of one map with each layer of the other. */
  Counts
  CountSlice(std::size_t slice) const
  {
    const std::vector<std::size_t> nearest = this->FindNearest(slice);
    Counts counts;
    std::vector<std::int32_t> labels;
    for (const ScanImage & layer : m_First)
    {
      CopyLabels(layer, slice * nearest.size(), nearest.size(), labels);
      for (const ScanImage & other : m_Second)
      {
        this->CountLayers(labels, nearest, other, counts);
      }
    }
    return counts;
  }

private:
  std::vector<std::size_t>
  FindNearest(std::size_t slice) const
  {
    std::vector<std::size_t> nearest(m_Slices.GetVoxelsOfSlice());
    std::size_t voxel = 0;
    for (std::size_t row = 0; row < m_Slices.size[1]; ++row)
    {
      for (std::size_t column = 0; column < m_Slices.size[0]; ++column, ++voxel)
      {
        if (m_IsOneGrid)
        {
          nearest[voxel] = slice * nearest.size() + voxel;
          continue;
        }
        const PointType position = m_Slices.At(slice, static_cast<double>(column), static_cast<double>(row));
        nearest[voxel] = m_Nearest.Find(m_ToSecond != nullptr ? m_ToSecond->TransformPoint(position) : position);
      }
    }
    return nearest;
  }

  static void
  CountLayers(const std::vector<std::int32_t> & labels,
              const std::vector<std::size_t> & nearest,
              const ScanImage & other,
              Counts & counts)
  {
    std::pair<std::int32_t, std::int32_t> run{};
    double length = 0.0;
    for (std::size_t voxel = 0; voxel < labels.size(); ++voxel)
    {
      const std::int32_t second = nearest[voxel] != NearestVoxels::None ? LabelAt(other, nearest[voxel]) : 0;
      if (run != std::pair(labels[voxel], second))
      {
        counts[run] += length;
        run = { labels[voxel], second };
        length = 0.0;
      }
      ++length;
    }
    counts[run] += length;
  }

  Slices m_Slices;
  NearestVoxels m_Nearest;
  std::vector<ScanImage> m_First;
  std::vector<ScanImage> m_Second;
  const AffineMap * m_ToSecond;
  bool m_IsOneGrid;
};

double
Find(const std::map<std::int32_t, double> & volumes, std::int32_t label)
{
  const auto found = volumes.find(label);
  return found != volumes.end() ? found->second : 0.0;
}

} // namespace

std::map<std::int32_t, LabelMoments>
ComputeLabelMoments(const Scan & map)
{
  const Slices slices(map);
  const std::vector<double> voxelVolumes = VoxelVolumes(map);
  std::vector<std::map<std::int32_t, SliceSums>> sums(slices.size[2]);
  ForEachInBlocks(sums.size(), 1, [&](std::size_t slice) {
    std::vector<std::int32_t> labels;
    for (const ScanImage & layer : LayersOf(map))
    {
      CopyLabels(layer, slice * slices.GetVoxelsOfSlice(), slices.GetVoxelsOfSlice(), labels);
      for (std::size_t row = 0; row < slices.size[1]; ++row)
      {
        const std::int32_t * const begin = labels.data() + row * slices.size[0];
        for (std::size_t column = 0; column < slices.size[0];)
        {
          std::size_t end = column + 1;
          while (end < slices.size[0] && begin[end] == begin[column])
          {
            ++end;
          }
          if (begin[column] != 0)
          {
            sums[slice][begin[column]].Add(column, end, row);
          }
          column = end;
        }
      }
    }
  });
  std::map<std::int32_t, LabelMoments> moments;
  std::map<std::int32_t, VectorType> integrals; // of the positions relative to the first voxel
  for (std::size_t slice = 0; slice < sums.size(); ++slice)
  {
    for (const auto & [label, of] : sums[slice])
    {
      const double volume = of.count * voxelVolumes[slice];
      const PointType centroid = slices.At(slice, of.columns / of.count, of.rows / of.count);
      moments[label].volume += volume;
      Enlarge(slices, slice, of, moments[label].region);
      integrals[label] += (centroid - slices.origins.front()) * volume;
    }
  }
  for (auto & [label, of] : moments)
  {
    of.centroid = slices.origins.front() + integrals[label] / of.volume;
  }
  return moments;
}

LabelOverlap
ComputeLabelOverlap(const Scan & first, const Scan & second, const AffineMap * toSecond)
{
  const OverlapCounter counter(first, second, toSecond);
  const std::vector<double> voxelVolumes = VoxelVolumes(first);
  std::vector<OverlapCounter::Counts> counts(voxelVolumes.size());
  ForEachInBlocks(counts.size(), 1, [&](std::size_t slice) { counts[slice] = counter.CountSlice(slice); });
  const auto layersOfFirst = static_cast<double>(LayersOf(first).size());
  const auto layersOfSecond = static_cast<double>(LayersOf(second).size());
  LabelOverlap overlap;
  for (std::size_t slice = 0; slice < counts.size(); ++slice)
  {
    for (const auto & [labels, count] : counts[slice])
    {
      const double volume = count * voxelVolumes[slice];
      overlap.first[labels.first] += volume / layersOfSecond; // each voxel is met once with each layer of the other
      overlap.second[labels.second] += volume / layersOfFirst;
      overlap.common[labels] += volume;
    }
  }
  return overlap;
}

double
LabelOverlap::GetDice(std::int32_t inFirst, std::int32_t inSecond) const
{
  const auto found = common.find({ inFirst, inSecond });
  const double both = Find(first, inFirst) + Find(second, inSecond);
  return both > 0.0 ? 2.0 * (found != common.end() ? found->second : 0.0) / both : 1.0;
}

double
LabelOverlap::GetIoU(std::int32_t inFirst, std::int32_t inSecond) const
{
  const double dice = this->GetDice(inFirst, inSecond);
  return dice / (2.0 - dice);
}

} // namespace rhombic
