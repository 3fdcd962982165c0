#include "rhombicSurfaceDeviation.h"

#include "rhombicScanField.h"

#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace rhombic
{
namespace
{

using PointType = ScanField::PointType;
using VectorType = PointType::VectorType;

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
  ForEachBlock(count, blockSize, [&](std::size_t begin, std::size_t end) {
    std::vector<PointType> points;
    for (std::size_t n = begin; n < end; ++n)
    {
      points.push_back(SampleOf(surface, n * stride));
    }
    const auto found = FindDistances(field, points, isovalue);
    std::copy(found.begin(), found.end(), distances.begin() + static_cast<std::ptrdiff_t>(begin));
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
