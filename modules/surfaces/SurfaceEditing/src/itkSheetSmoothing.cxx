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

/** A vector in a register of four floats, of which the last is not used. */
struct Lanes
{
  using Register [[gnu::vector_size(16)]] = float;

  Register lanes;

  Lanes() = default;

  Lanes(Register values)
    : lanes(values)
  {}

  explicit Lanes(const PositionType & vector)
    : lanes{ static_cast<float>(vector[0]), static_cast<float>(vector[1]), static_cast<float>(vector[2]), 0.0f }
  {}

  explicit operator PositionType() const
  {
    return { lanes[0], lanes[1], lanes[2] };
  }
};

Lanes
operator+(const Lanes & a, const Lanes & b)
{
  return a.lanes + b.lanes;
}

Lanes
operator-(const Lanes & a, const Lanes & b)
{
  return a.lanes - b.lanes;
}

Lanes
operator*(float a, const Lanes & b)
{
  return a * b.lanes;
}

Lanes
operator/(const Lanes & a, float b)
{
  return a.lanes / b;
}

/** A number or a vector for each point. */
template <typename TValue>
using Values = BulkVector<TValue>;

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
template <typename TValue>
TValue
MeanOfNeighbours(const SheetNeighbours & neighbours, const Values<TValue> & values, SizeValueType point)
{
  TValue sum{};
  const std::size_t count = neighbours.Visit(point, [&](std::uint32_t other) { sum = sum + values[other]; });
  return count == 0 ? values[point] : sum / static_cast<float>(count);
}

/** Filters values by the recurrence of Chebyshev polynomials: T(n + 1) = 2 x T(n) - T(n - 1), where x is the mean of a
 * value and its neighbours' mean. */
template <typename TValue>
void
Filter(const SheetNeighbours & neighbours,
       const std::vector<double> & coefficients,
       Values<TValue> & values,
       rhombic::StagedProgress & progress)
{
  Values<TValue> last(values.size()); // becomes the next
  Values<TValue> current(values.size());
  current.swap(values);
  for (std::size_t n = 0; n < coefficients.size(); ++n)
  {
    const auto share = static_cast<float>(coefficients[n]);
    rhombic::ForEachBlock(values.size(), Block, [&](SizeValueType begin, SizeValueType end) {
      for (SizeValueType point = begin; point < end; ++point)
      {
        const TValue here = current[point];
        const TValue sum = here + MeanOfNeighbours(neighbours, current, point);
        last[point] = n == 0 ? 0.5f * sum : sum - last[point];
        values[point] = (n == 0 ? TValue{} : values[point]) + share * here;
      }
      progress.Completed(end - begin);
    });
    last.swap(current);
  }
}

/** Unit normals of the points: means of the triangles' by their areas, smoothed a little. */
Values<Lanes>
FindNormals(const TriangleSurface & surface, const TrianglesOfPoints & fans, const SheetNeighbours & neighbours)
{
  Values<Lanes> normals(surface.GetNumberOfPoints());
  const auto normalized = [](const PositionType & sum) {
    const double length = Length(sum);
    return length > 0.0 ? Lanes(Scaled(sum, 1.0 / length)) : Lanes();
  };
  rhombic::ForEachInBlocks(normals.size(), Block, [&](SizeValueType point) {
    PositionType sum{};
    fans.VisitTriangles(
      point, [&](std::uint32_t id) { sum = Add(sum, AreaVector(CornersOf(surface, surface.GetTriangles()[id]))); });
    normals[point] = normalized(sum);
  });
  Values<Lanes> next(normals.size());
  for (unsigned int n = 0; n < NormalSteps; ++n)
  {
    rhombic::ForEachInBlocks(normals.size(), Block, [&](SizeValueType point) {
      const Lanes mean = MeanOfNeighbours(neighbours, normals, point);
      next[point] = normalized(Add(PositionType(normals[point]), PositionType(mean)));
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
  std::size_t size = 0;
  for (std::size_t point = 0; point < strata.strata.size(); ++point)
  {
    const Stratum stratum = strata.strata[point];
    size += stratum == Stratum::Sheet ? fans.GetNumberOfTriangles(point) : stratum == Stratum::Curve ? 2 : 0;
    m_Begin.push_back(size);
  }
  m_Ids.resize(size);
  rhombic::ForEachInBlocks(strata.strata.size(), Block, [&](SizeValueType point) {
    if (strata.strata[point] == Stratum::Sheet)
    {
      std::uint32_t * id = m_Ids.data() + m_Begin[point];
      fans.VisitNeighbours(point, [&id](std::uint32_t next, std::uint32_t) { *id++ = next; });
    }
  });
  for (const CurvePoint & curve : strata.curves)
  {
    std::copy(curve.neighbours.begin(), curve.neighbours.end(), m_Ids.data() + m_Begin[curve.point]);
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
  Values<Lanes> ways(count);
  Values<float> heights(count);
  rhombic::ForEachInBlocks(
    count, Block, [&](SizeValueType point) { ways[point] = Lanes(Subtract(ToPosition(start[point]), origin)); });
  Filter(neighbours, coefficients, ways, progress);
  const Values<Lanes> normals = FindNormals(surface, fans, neighbours);
  rhombic::ForEachInBlocks(count, Block, [&](SizeValueType point) {
    ways[point] = Lanes(Subtract(Add(PositionType(ways[point]), origin), ToPosition(start[point])));
    // Normals of sheets that meet have no mean.
    heights[point] = strata.strata[point] == Stratum::Sheet
                       ? static_cast<float>(Dot(PositionType(ways[point]), PositionType(normals[point])))
                       : 0.0f;
  });
  Filter(neighbours, coefficients, heights, progress);
  moves.MoveTowards(
    [&](SizeValueType point) {
      const PositionType way =
        Along(PositionType(ways[point]), PositionType(normals[point]), -static_cast<double>(heights[point]));
      return strata.strata[point] == Stratum::Fixed ? start[point] : BoundedMoves::Move(start[point], 1.0, way);
    },
    progress);
}

} // namespace itk
