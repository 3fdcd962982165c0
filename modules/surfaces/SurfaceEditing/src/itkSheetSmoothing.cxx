#include "detail/itkSheetSmoothing.h"

#include <cmath>
#include <utility>

namespace itk
{
namespace
{

constexpr SizeValueType Block = 4096;
constexpr double PassBand = 0.006; // of the eigenvalues of the umbrella operator, [0, 2]
constexpr unsigned int NormalSteps = 4;

/** A number or a vector for each point. */
template <std::size_t VDimension>
using Values = BulkVector<std::array<float, VDimension>>;

/** The coefficients of the Chebyshev polynomials of which the filter is the sum. Those of an ideal low-pass filter, by
 * a Hamming window; their sum is 1, so that what is the same everywhere stays. */
std::vector<double>
FindCoefficients(unsigned int iterations)
{
  const double pi = std::acos(-1.0);
  const double end = std::acos(1.0 - 0.5 * PassBand);
  std::vector<double> coefficients{ end / pi };
  double sum = coefficients.front();
  for (unsigned int n = 1; n <= iterations; ++n)
  {
    const double window = 0.54 + 0.46 * std::cos(pi * n / (iterations + 1.0));
    coefficients.push_back(2.0 * window * std::sin(n * end) / (n * pi));
    sum += coefficients.back();
  }
  for (double & coefficient : coefficients)
  {
    coefficient /= sum;
  }
  return coefficients;
}

/** The mean of a point's neighbours, or the point's own value if it has none. */
template <std::size_t VDimension>
std::array<float, VDimension>
MeanOfNeighbours(const SheetNeighbours & neighbours, const Values<VDimension> & values, SizeValueType point)
{
  std::array<float, VDimension> sum{};
  const std::size_t count = neighbours.Visit(point, [&](std::uint32_t other) {
    for (std::size_t n = 0; n < VDimension; ++n)
    {
      sum[n] += values[other][n];
    }
  });
  if (count == 0)
  {
    return values[point];
  }
  for (float & component : sum)
  {
    component /= static_cast<float>(count);
  }
  return sum;
}

/** Filters values by the recurrence of Chebyshev polynomials: T(n + 1) = 2 x T(n) - T(n - 1), where x is the mean of a
 * value and its neighbours' mean. */
template <std::size_t VDimension>
void
Filter(const SheetNeighbours & neighbours,
       const std::vector<double> & coefficients,
       Values<VDimension> & values,
       rhombic::StagedProgress & progress)
{
  Values<VDimension> last = values;
  Values<VDimension> current = values;
  Values<VDimension> next(values.size());
  for (std::size_t n = 0; n < coefficients.size(); ++n)
  {
    const auto share = static_cast<float>(coefficients[n]);
    rhombic::ForEachBlock(values.size(), Block, [&](SizeValueType begin, SizeValueType end) {
      for (SizeValueType point = begin; point < end; ++point)
      {
        const auto mean = MeanOfNeighbours(neighbours, current, point);
        for (std::size_t axis = 0; axis < VDimension; ++axis)
        {
          const float here = current[point][axis];
          next[point][axis] = n == 0 ? 0.5f * (here + mean[axis]) : here + mean[axis] - last[point][axis];
          values[point][axis] = (n == 0 ? 0.0f : values[point][axis]) + share * here;
        }
      }
      progress.Completed(end - begin);
    });
    last.swap(current);
    current.swap(next);
  }
}

/** Unit normals of the points: means of the triangles' by their areas, smoothed a little. */
Values<3>
FindNormals(const TriangleSurface & surface, const TrianglesOfPoints & fans, const SheetNeighbours & neighbours)
{
  Values<3> normals(surface.GetNumberOfPoints());
  const auto normalized = [](const PositionType & sum) -> std::array<float, 3> {
    const double length = Length(sum);
    return length > 0.0 ? ToPoint(Scaled(sum, 1.0 / length)) : std::array<float, 3>{};
  };
  rhombic::ForEachInBlocks(normals.size(), Block, [&](SizeValueType point) {
    PositionType sum{};
    fans.VisitTriangles(
      point, [&](std::uint32_t id) { sum = Add(sum, AreaVector(CornersOf(surface, surface.GetTriangles()[id]))); });
    normals[point] = normalized(sum);
  });
  Values<3> next(normals.size());
  for (unsigned int n = 0; n < NormalSteps; ++n)
  {
    rhombic::ForEachInBlocks(normals.size(), Block, [&](SizeValueType point) {
      const auto mean = MeanOfNeighbours(neighbours, normals, point);
      next[point] = normalized(Add(ToPosition(normals[point]), ToPosition(mean)));
    });
    normals.swap(next);
  }
  return normals;
}

} // namespace

SheetNeighbours::SheetNeighbours(const TrianglesOfPoints & fans, const PointStrata & strata)
  : m_Begin(1, 0)
{
  m_Begin.reserve(strata.strata.size() + 1);
  std::size_t size = 2 * strata.curves.size();
  for (std::size_t point = 0; point < strata.strata.size(); ++point)
  {
    size += strata.strata[point] == Stratum::Sheet ? fans.GetNumberOfTriangles(point) : 0;
  }
  m_Ids.reserve(size);
  auto curve = strata.curves.begin();
  for (std::uint32_t point = 0; point < strata.strata.size(); ++point)
  {
    if (strata.strata[point] == Stratum::Sheet)
    {
      fans.VisitNeighbours(point, [&](std::uint32_t next, std::uint32_t) { m_Ids.push_back(next); });
    }
    else if (strata.strata[point] == Stratum::Curve)
    {
      m_Ids.insert(m_Ids.end(), curve->neighbours.begin(), curve->neighbours.end());
      ++curve;
    }
    m_Begin.push_back(m_Ids.size());
  }
}

void
SmoothSheets(const TriangleSurface & surface,
             const TrianglesOfPoints & fans,
             const PointStrata & strata,
             unsigned int iterations,
             BoundedMoves & moves,
             rhombic::StagedProgress & progress,
             double stageEnd)
{
  const SizeValueType count = surface.GetNumberOfPoints();
  progress.Begin(stageEnd, (2 * iterations + 3) * count);
  if (iterations == 0 || count == 0)
  {
    return;
  }
  const SheetNeighbours neighbours(fans, strata);
  const std::vector<double> coefficients = FindCoefficients(iterations);
  const auto start = surface.GetPoints();
  const PositionType origin = ToPosition(start.front()); // positions relative to it keep their digits
  Values<3> ways(count);
  Values<1> heights(count);
  rhombic::ForEachInBlocks(
    count, Block, [&](SizeValueType point) { ways[point] = ToPoint(Subtract(ToPosition(start[point]), origin)); });
  Filter(neighbours, coefficients, ways, progress);
  const Values<3> normals = FindNormals(surface, fans, neighbours);
  rhombic::ForEachInBlocks(count, Block, [&](SizeValueType point) {
    ways[point] = ToPoint(Subtract(Add(ToPosition(ways[point]), origin), ToPosition(start[point])));
    // Normals of sheets that meet have no mean.
    heights[point][0] = strata.strata[point] == Stratum::Sheet
                          ? static_cast<float>(Dot(ToPosition(ways[point]), ToPosition(normals[point])))
                          : 0.0f;
  });
  Filter(neighbours, coefficients, heights, progress);
  moves.MoveTowards(
    [&](SizeValueType point) {
      const PositionType way =
        Along(ToPosition(ways[point]), ToPosition(normals[point]), -static_cast<double>(heights[point][0]));
      return strata.strata[point] == Stratum::Fixed ? start[point] : BoundedMoves::Move(start[point], 1.0, way);
    },
    progress);
}

} // namespace itk
