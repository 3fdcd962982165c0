#include "rhombicSurfaceDeviation.h"

#include "rhombicForEachBlock.h"
#include "rhombicMappedVoxels.h"

#include "itkSliceStack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace rhombic
{
namespace
{

using PointType = itk::Point<double, 3>;
using VectorType = PointType::VectorType;

constexpr itk::SizeValueType MostTaps = 10; // of one axis, see itk::SeparableTaps

/** Weights of the samples around each point of a list. */
struct FieldTaps
{
  /** The value at point \a n. The columns' sums of all rows come first, eight columns at once. */
  template <typename TPixel>
  float
  Blend(const TPixel * samples, const itk::Size<3> & size, std::size_t n) const
  {
    constexpr itk::SizeValueType lanes = 8;
    const itk::SizeValueType count = columns.GetNumberOfTaps();
    const itk::SizeValueType inLanes = count / lanes * lanes;
    float sums[MostTaps] = {};
    for (itk::SizeValueType z = 0; z < slices.GetNumberOfTaps(); ++z)
    {
      for (itk::SizeValueType y = 0; y < rows.GetNumberOfTaps(); ++y)
      {
        const float weight = slices.GetWeights(n)[z] * rows.GetWeights(n)[y];
        const auto offset = ((slices.GetFirst(n) + z) * size[1] + rows.GetFirst(n) + y) * size[0];
        const TPixel * const row = samples + offset + columns.GetFirst(n);
        for (itk::SizeValueType x = 0; x < inLanes; x += lanes)
        {
          for (itk::SizeValueType lane = x; lane < x + lanes; ++lane)
          {
            sums[lane] += weight * static_cast<float>(row[lane]);
          }
        }
        for (itk::SizeValueType x = inLanes; x < count; ++x)
        {
          sums[x] += weight * static_cast<float>(row[x]);
        }
      }
    }
    float value = 0.0f;
    for (itk::SizeValueType x = 0; x < count; ++x)
    {
      value += columns.GetWeights(n)[x] * sums[x];
    }
    return value;
  }

  itk::SeparableTaps columns;
  itk::SeparableTaps rows;
  itk::SeparableTaps slices;
  std::vector<bool> areKnown; ///< false outside the scan and next to its border
};

/** Whether a position in samples is at least half a sample inside the outermost ones. */
bool
IsWellInside(double position, itk::SizeValueType length)
{
  constexpr double margin = 0.5;
  return position >= margin && position <= static_cast<double>(length) - 1.0 - margin;
}

/** \class ScanField
 * \brief The continuous field of a scan, interpolated as itk::CartesianToFCCImageFilter does, also for slanted scans.
 *
 * The scan must outlive it. */
class ScanField
{
public:
  ScanField(const Scan & scan, itk::SeparableKernel kernel)
    : m_Scan(scan)
    , m_Kernel(kernel)
  {
    if (IsSlanted(scan))
    {
      m_Stack.emplace(GeometryOf(scan.image), scan.sliceOrigins);
    }
  }

  /** Has pages of a mapped scan dropped: the surface goes on elsewhere. */
  void
  DropPages() const
  {
    rhombic::DropPages(m_Scan.image);
  }

  /** The smallest distance between samples along an axis, in mm. */
  double
  GetPitch() const
  {
    const auto & pitch = m_Stack ? m_Stack->GetPitch() : GeometryOf(m_Scan.image).GetSpacing();
    return *std::min_element(pitch.Begin(), pitch.End());
  }

  /** Values at points in LPS mm. NaN outside the scan and less than half a voxel inside the outermost samples, where
   * walls close surfaces.
   * \param other a kernel in place of the field's */
  std::vector<float>
  Evaluate(const std::vector<PointType> & points, std::optional<itk::SeparableKernel> other = std::nullopt) const
  {
    const itk::SeparableKernel kernel = other.value_or(m_Kernel);
    const FieldTaps taps = m_Stack ? this->MakeStackTaps(points, kernel) : this->MakeGridTaps(points, kernel);
    std::vector<float> values(points.size(), std::numeric_limits<float>::quiet_NaN());
    std::visit(
      [&](const auto & image) {
        const auto & size = image->GetLargestPossibleRegion().GetSize();
        const auto * const samples = image->GetBufferPointer();
        for (std::size_t n = 0; n < points.size(); ++n)
        {
          if (taps.areKnown[n])
          {
            values[n] = taps.Blend(samples, size, n);
          }
        }
      },
      m_Scan.image);
    return values;
  }

private:
  FieldTaps
  MakeGridTaps(const std::vector<PointType> & points, itk::SeparableKernel kernel) const
  {
    const auto & geometry = GeometryOf(m_Scan.image);
    const auto & region = geometry.GetLargestPossibleRegion();
    std::array<std::vector<double>, 3> positions;
    std::vector<bool> areKnown(points.size(), true);
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      const auto index = geometry.TransformPhysicalPointToContinuousIndex<double>(points[n]);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        positions[axis].push_back(index[axis] - static_cast<double>(region.GetIndex(axis)));
        areKnown[n] = areKnown[n] && IsWellInside(positions[axis].back(), region.GetSize(axis));
      }
    }
    return { itk::SeparableTaps(kernel, region.GetSize(0), positions[0]),
             itk::SeparableTaps(kernel, region.GetSize(1), positions[1]),
             itk::SeparableTaps(kernel, region.GetSize(2), positions[2]),
             areKnown };
  }

  FieldTaps
  MakeStackTaps(const std::vector<PointType> & points, itk::SeparableKernel kernel) const
  {
    const auto & region = GeometryOf(m_Scan.image).GetLargestPossibleRegion();
    std::array<std::vector<double>, 3> positions;
    std::vector<bool> areKnown(points.size());
    std::vector<itk::SliceStack::VectorType> frames;
    for (const PointType & point : points)
    {
      frames.push_back(m_Stack->TransformPointToFrame(point));
      positions[2].push_back(frames.back()[2]);
    }
    itk::SeparableTaps slices = m_Stack->MakeSliceTaps(kernel, positions[2]);
    const double margin = 0.5 * m_Stack->GetPitch()[2];
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      const double z = frames[n][2];
      const auto origin = m_Stack->GetOriginAt(z, slices, n);
      const double row = m_Stack->GetRow(frames[n][1], origin);
      const double column = m_Stack->GetColumn(frames[n][0], row, origin);
      positions[0].push_back(column);
      positions[1].push_back(row);
      // The first slice is at height 0, and voxels reach half a pitch beyond the last one.
      areKnown[n] = IsWellInside(column, region.GetSize(0)) && IsWellInside(row, region.GetSize(1)) && z >= margin &&
                    z <= m_Stack->GetHighest()[2] - 2.0 * margin;
    }
    return { itk::SeparableTaps(kernel, region.GetSize(0), positions[0]),
             itk::SeparableTaps(kernel, region.GetSize(1), positions[1]),
             std::move(slices),
             areKnown };
  }

  const Scan & m_Scan;
  itk::SeparableKernel m_Kernel;
  std::optional<itk::SliceStack> m_Stack; ///< for slanted scans
};

constexpr float Outside = std::numeric_limits<float>::quiet_NaN();   // outside the scan, or next to its border
constexpr float Unresolved = std::numeric_limits<float>::infinity(); // without an isosurface near

/** Point \a n of the surface, or, from the number of points on, the centre of a triangle. */
PointType
SampleOf(const itk::TriangleSurface & surface, std::size_t n)
{
  const auto & points = surface.GetPoints();
  PointType sample;
  if (n < points.size())
  {
    std::copy(points[n].begin(), points[n].end(), sample.Begin());
    return sample;
  }
  const auto & [a, b, c] = surface.GetTriangles()[n - points.size()];
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    sample[axis] = (static_cast<double>(points[a][axis]) + points[b][axis] + points[c][axis]) / 3.0;
  }
  return sample;
}

/** Gradients of the field at points by central differences of the linearly interpolated field, which is exact enough
 * for a direction and a first guess: unit vectors and lengths. */
struct Gradients
{
  std::vector<VectorType> directions;
  std::vector<double> lengths;
};

Gradients
FindGradients(const ScanField & field, const std::vector<PointType> & points)
{
  const double step = 0.5 * field.GetPitch();
  Gradients gradients{ std::vector<VectorType>(points.size()), std::vector<double>(points.size()) };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    std::vector<PointType> before(points);
    std::vector<PointType> behind(points);
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      before[n][axis] -= step;
      behind[n][axis] += step;
    }
    const auto valuesBefore = field.Evaluate(before, itk::SeparableKernel::Linear);
    const auto valuesBehind = field.Evaluate(behind, itk::SeparableKernel::Linear);
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      gradients.directions[n][axis] = (static_cast<double>(valuesBehind[n]) - valuesBefore[n]) / (2.0 * step);
    }
  }
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    gradients.lengths[n] = gradients.directions[n].GetNorm();
    gradients.directions[n] /= gradients.lengths[n];
  }
  return gradients;
}

/** Signed distance along a line to the nearest crossing of the isovalue within 2 voxels; Unresolved if there is none.
 * The field is taken as linear between positions a quarter of a voxel apart. */
float
SearchAlong(const ScanField & field, const PointType & from, const VectorType & direction, double isovalue)
{
  constexpr int stepsPerSample = 4;
  constexpr int reach = 2 * stepsPerSample;
  const double step = field.GetPitch() / stepsPerSample;
  std::vector<PointType> line;
  for (int n = -reach; n <= reach; ++n)
  {
    line.push_back(from + direction * (n * step));
  }
  const auto values = field.Evaluate(line);
  double nearest = std::numeric_limits<double>::infinity();
  for (int n = 0; n < 2 * reach; ++n)
  {
    const double a = static_cast<double>(values[static_cast<std::size_t>(n)]) - isovalue;
    const double b = static_cast<double>(values[static_cast<std::size_t>(n) + 1]) - isovalue;
    if ((a < 0.0) != (b < 0.0) && std::isfinite(a) && std::isfinite(b))
    {
      const double position = (n - reach + a / (a - b)) * step;
      nearest = std::abs(position) < std::abs(nearest) ? position : nearest;
    }
  }
  return static_cast<float>(nearest);
}

/** The distance along the gradient from each point to the isosurface, positive where the gradient leads to it; or
 * Outside, or Unresolved. */
std::vector<float>
FindDistances(const ScanField & field, const std::vector<PointType> & points, double isovalue)
{
  const auto values = field.Evaluate(points);
  const Gradients gradients = FindGradients(field, points);
  const double farthest = field.GetPitch();
  std::vector<double> steps(points.size());
  std::vector<PointType> ends(points);
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    steps[n] = (isovalue - values[n]) / gradients.lengths[n];
    if (std::abs(steps[n]) <= farthest) // neither unknown nor without a gradient
    {
      ends[n] += gradients.directions[n] * steps[n];
    }
  }
  const auto valuesAtEnds = field.Evaluate(ends);
  std::vector<float> distances(points.size(), Outside);
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    if (std::isnan(values[n]) || std::isnan(gradients.lengths[n]))
    {
      continue;
    }
    const double miss = isovalue - values[n];
    const double slope = (static_cast<double>(valuesAtEnds[n]) - values[n]) / steps[n];
    const double distance = miss == 0.0 ? 0.0 : miss / slope;
    const bool hasSettled =
      miss == 0.0 || (std::abs(steps[n]) <= farthest && distance / steps[n] > 0.5 && distance / steps[n] < 2.0);
    if (hasSettled)
    {
      distances[n] = static_cast<float>(distance);
    }
    else if (gradients.lengths[n] > 0.0)
    {
      distances[n] = SearchAlong(field, points[n], gradients.directions[n], isovalue);
    }
    else
    {
      distances[n] = Unresolved;
    }
  }
  return distances;
}

/** The distances of every stride-th sample of the surface. */
std::vector<float>
MeasureDistances(const itk::TriangleSurface & surface,
                 const ScanField & field,
                 double isovalue,
                 std::size_t stride,
                 std::size_t count)
{
  std::vector<float> distances(count);
  constexpr std::size_t blockSize = 2048;
  const std::size_t blocksOfPart = 1 + count / blockSize / 32;
  ForEachBlock(count, blockSize, [&](std::size_t begin, std::size_t end) {
    std::vector<PointType> points;
    for (std::size_t n = begin; n < end; ++n)
    {
      points.push_back(SampleOf(surface, n * stride));
    }
    const auto found = FindDistances(field, points, isovalue);
    std::copy(found.begin(), found.end(), distances.begin() + static_cast<std::ptrdiff_t>(begin));
    if (begin / blockSize % blocksOfPart == 0)
    {
      field.DropPages();
    }
  });
  return distances;
}

/** Statistics of resolved distances, whose order changes. \a outwards is 1 or -1. */
void
SummarizeDistances(std::vector<float> & distances, double outwards, SurfaceDeviation & deviation)
{
  const auto resolved = static_cast<double>(distances.size());
  deviation.bias = outwards * std::accumulate(distances.begin(), distances.end(), 0.0) / resolved;
  std::transform(distances.begin(), distances.end(), distances.begin(), [](float d) { return std::abs(d); });
  deviation.mean = std::accumulate(distances.begin(), distances.end(), 0.0) / resolved;
  const auto rank95 = distances.begin() + static_cast<std::ptrdiff_t>(0.95 * (resolved - 1.0));
  std::nth_element(distances.begin(), rank95, distances.end());
  deviation.percentile95 = *rank95;
  deviation.maximum = *std::max_element(rank95, distances.end());
}

} // namespace

SurfaceDeviation
ComputeDeviation(const itk::TriangleSurface & surface,
                 const Scan & scan,
                 itk::SeparableKernel kernel,
                 const Threshold & threshold,
                 std::size_t maximumSamples)
{
  const std::size_t candidates = surface.GetNumberOfPoints() + surface.GetNumberOfTriangles();
  const std::size_t stride = std::max<std::size_t>(1, (candidates + maximumSamples - 1) / maximumSamples);
  std::vector<float> distances =
    MeasureDistances(surface, ScanField(scan, kernel), threshold.isovalue, stride, (candidates + stride - 1) / stride);
  SurfaceDeviation deviation;
  deviation.isComplete = stride == 1;
  distances.erase(std::remove_if(distances.begin(), distances.end(), [](float d) { return std::isnan(d); }),
                  distances.end());
  deviation.samples = distances.size();
  distances.erase(std::remove_if(distances.begin(), distances.end(), [](float d) { return std::isinf(d); }),
                  distances.end());
  deviation.unresolved = deviation.samples - distances.size();
  if (!distances.empty())
  {
    // The gradient leads to larger values: to the inside, unless values below the isovalue are inside.
    const double outwards = threshold.insideIsBelow ? -1.0 : 1.0;
    SummarizeDistances(distances, outwards, deviation);
  }
  return deviation;
}

} // namespace rhombic
