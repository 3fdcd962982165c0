#include "rhombicSurfaceDeviation.h"

#include "rhombicScanField.h"

#include "itkForEachBlock.h"

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

constexpr float Unknown = std::numeric_limits<float>::quiet_NaN();
constexpr float Unresolved = std::numeric_limits<float>::infinity();

/** The surface's points and then the centres of its triangles. */
PointType
PlaceOf(const itk::TriangleSurface & surface, std::size_t n)
{
  const auto & points = surface.GetPoints();
  PointType place;
  if (n < points.size())
  {
    std::copy(points[n].begin(), points[n].end(), place.Begin());
    return place;
  }
  const auto & [a, b, c] = surface.GetTriangles()[n - points.size()];
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    place[axis] = (static_cast<double>(points[a][axis]) + points[b][axis] + points[c][axis]) / 3.0;
  }
  return place;
}

/** The field's unit gradient at points by central differences, and its length. Linear interpolation is enough for a
 * direction and a first guess. */
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

/** The nearest place on a line, from -2 to 2 samples, where the field crosses the isovalue; Unresolved if there is
 * none. Along the line, the field is taken for linear in steps of a quarter. */
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
      const double place = (n - reach + a / (a - b)) * step;
      nearest = std::abs(place) < std::abs(nearest) ? place : nearest;
    }
  }
  return static_cast<float>(nearest);
}

/** The distance along the gradient from each point to the isosurface, positive where the gradient leads to it; Unknown
 * beside the scan, Unresolved where no isosurface is near. */
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
  std::vector<float> distances(points.size(), Unknown);
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

} // namespace

SurfaceDeviation
ComputeDeviation(const itk::TriangleSurface & surface,
                 const Scan & scan,
                 itk::SeparableKernel kernel,
                 double isovalue,
                 SurfaceRequest::Side side,
                 std::size_t maximumSamples)
{
  const std::size_t places = surface.GetNumberOfPoints() + surface.GetNumberOfTriangles();
  const std::size_t stride = std::max<std::size_t>(1, (places + maximumSamples - 1) / maximumSamples);
  const std::size_t count = (places + stride - 1) / stride;
  const ScanField field(scan, kernel);
  std::vector<float> distances(count);

  constexpr std::size_t blockSize = 2048;
  itk::ForEachBlock(count, blockSize, [&](std::size_t begin, std::size_t end) {
    std::vector<PointType> points;
    for (std::size_t n = begin; n < end; ++n)
    {
      points.push_back(PlaceOf(surface, n * stride));
    }
    const auto found = FindDistances(field, points, isovalue);
    std::copy(found.begin(), found.end(), distances.begin() + static_cast<std::ptrdiff_t>(begin));
  });

  SurfaceDeviation deviation;
  deviation.isComplete = stride == 1;
  distances.erase(std::remove_if(distances.begin(), distances.end(), [](float d) { return std::isnan(d); }),
                  distances.end());
  deviation.samples = distances.size();
  distances.erase(std::remove_if(distances.begin(), distances.end(), [](float d) { return std::isinf(d); }),
                  distances.end());
  deviation.unresolved = deviation.samples - distances.size();
  if (distances.empty())
  {
    return deviation;
  }
  // The gradient leads inside, or, where what is below the isovalue is inside, outside.
  const double outwards = side == SurfaceRequest::Side::Above ? 1.0 : -1.0;
  const auto resolved = static_cast<double>(distances.size());
  deviation.bias = outwards * std::accumulate(distances.begin(), distances.end(), 0.0) / resolved;
  std::transform(distances.begin(), distances.end(), distances.begin(), [](float d) { return std::abs(d); });
  deviation.mean = std::accumulate(distances.begin(), distances.end(), 0.0) / resolved;
  const auto place95 = distances.begin() + static_cast<std::ptrdiff_t>(0.95 * (resolved - 1.0));
  std::nth_element(distances.begin(), place95, distances.end());
  deviation.percentile95 = *place95;
  deviation.maximum = *std::max_element(place95, distances.end());
  return deviation;
}

Report
ReportDeviation(const SurfaceDeviation & deviation)
{
  Report report{ { "of", "the points and triangle centres from the scan's isosurface" },
                 { "samples", deviation.samples },
                 { "complete", deviation.isComplete },
                 { "unresolved", deviation.unresolved } };
  if (deviation.IsKnown())
  {
    report["meanInMillimetres"] = deviation.mean;
    report["percentile95InMillimetres"] = deviation.percentile95;
    report["maximumInMillimetres"] = deviation.maximum;
    report["biasInMillimetres"] = deviation.bias;
  }
  return report;
}

} // namespace rhombic
