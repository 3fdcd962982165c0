#include "itkTriangleSurfaceDistance.h"

#include "detail/itkPositionArithmetic.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace itk
{
namespace
{

constexpr std::size_t BlockSize = 1024;
constexpr double Rounding = 1e-6;         // mm; smaller distances are 0
constexpr unsigned int MostHalvings = 24; // a triangle has at most 2^24 parts

double
Area(const CornersType & corners)
{
  return Length(AreaVector(corners)) / 2.0;
}

/** The distance of a position from the other surface, in mm, and the gradient of the distance there: a unit vector away
 * from the nearest point, or 0 on the surface. */
struct Measured
{
  float distance = 0.0f;
  std::array<float, 3> gradient{};
};

/** Measures positions that are mostly close to the positions before: the triangle nearest to the last position bounds
 * the search. */
class Distances
{
public:
  explicit Distances(const TriangleTree & other)
    : m_Other(other)
  {}

  Measured
  At(const PositionType & position)
  {
    double bound = std::numeric_limits<double>::infinity();
    if (m_Nearest != TriangleTree::None)
    {
      bound = SquaredDistance(position, m_Other.FindClosestPointOfTriangle(position, m_Nearest));
    }
    const auto closest = m_Other.FindClosestPoint(position, bound);
    m_Nearest = closest.triangle != TriangleTree::None ? closest.triangle : m_Nearest;
    const double distance = std::sqrt(closest.squaredDistance);
    if (!(distance > Rounding))
    {
      return {};
    }
    const PositionType gradient = Scaled(Subtract(position, closest.point), 1.0 / distance);
    return { static_cast<float>(distance),
             { static_cast<float>(gradient[0]), static_cast<float>(gradient[1]), static_cast<float>(gradient[2]) } };
  }

private:
  const TriangleTree & m_Other;
  std::uint32_t m_Nearest = TriangleTree::None;
};

/** The distance at the centre of a triangle by a quadratic function with the distances and gradients at its corners.
 * No value where the function bends by more than \a mostBent from the mean of the corners, or the gradients differ by
 * more than a quarter of a right angle: where the corners are nearest to different parts of the other surface.
 *
 * At a corner x with gradient g, a quadratic function f with the second derivative H has f(c) = f(x) + g (c - x) +
 * (c - x) H (c - x) / 2 at the centre c, and f(x) = f(c) + f'(c) (x - c) + (c - x) H (c - x) / 2. In the mean over
 * the corners the term with f'(c) is 0, so that f(c) is the mean of f(x) + g (c - x) / 2. */
std::optional<float>
AssumeAtCentre(const CornersType & corners,
               const PositionType & centre,
               const std::array<Measured, 3> & measured,
               double mostBent)
{
  constexpr double leastCosine = 0.92; // of a quarter of a right angle
  double bend = 0.0;
  double mean = 0.0;
  for (unsigned int corner = 0; corner < 3; ++corner)
  {
    const auto & [distance, gradient] = measured[corner];
    const auto & next = measured[(corner + 1) % 3].gradient;
    if (!(gradient[0] * next[0] + gradient[1] * next[1] + gradient[2] * next[2] >= leastCosine))
    {
      return std::nullopt;
    }
    mean += distance / 3.0;
    const PositionType toCentre = Subtract(centre, corners[corner]);
    bend += (gradient[0] * toCentre[0] + gradient[1] * toCentre[1] + gradient[2] * toCentre[2]) / 6.0;
  }
  return std::abs(bend) <= mostBent ? std::optional(static_cast<float>(std::max(0.0, mean + bend))) : std::nullopt;
}

/** The share of a triangle's area on which a linear function is at most \a value.
 * \param corners the function at the corners */
double
ShareWithin(std::array<double, 3> corners, double value)
{
  std::sort(corners.begin(), corners.end());
  const auto [low, middle, high] = corners;
  if (value < low)
  {
    return 0.0;
  }
  if (value >= high)
  {
    return 1.0;
  }
  if (value < middle)
  {
    return (value - low) * (value - low) / ((middle - low) * (high - low));
  }
  return 1.0 - (high - value) * (high - value) / ((high - middle) * (high - low));
}

/** The distance of each point that every \a step-th triangle uses; 0 for the others. */
BulkVector<Measured>
MeasurePoints(const TriangleSurface & surface, const TriangleTree & other, std::size_t step)
{
  BulkVector<char> isUsed(surface.GetNumberOfPoints(), step == 1);
  for (std::size_t id = 0; step > 1 && id < surface.GetNumberOfTriangles(); id += step)
  {
    for (const std::uint32_t point : surface.GetTriangles()[id])
    {
      isUsed[point] = 1;
    }
  }
  BulkVector<Measured> found(surface.GetNumberOfPoints(), Measured());
  rhombic::ForEachBlock(found.size(), BlockSize, [&](std::size_t first, std::size_t last) {
    Distances distances(other);
    for (std::size_t point = first; point < last; ++point)
    {
      if (isUsed[point] && IsFinite(surface.GetPoints()[point]))
      {
        found[point] = distances.At(ToPosition(surface.GetPoints()[point]));
      }
    }
  });
  return found;
}

} // namespace

float
TriangleSurfaceDistance::Part::GetSmallest() const
{
  return std::min({ corners[0], corners[1], corners[2], centre });
}

float
TriangleSurfaceDistance::Part::GetLargest() const
{
  return std::max({ corners[0], corners[1], corners[2], centre });
}

/** The centre divides the part into three triangles of equal area. */
double
TriangleSurfaceDistance::Part::FindAreaWithin(double distance) const
{
  return area / 3.0 *
         (ShareWithin({ corners[0], corners[1], centre }, distance) +
          ShareWithin({ corners[1], corners[2], centre }, distance) +
          ShareWithin({ corners[2], corners[0], centre }, distance));
}

/** \class TriangleSurfaceDistance::Divider
 * \brief Divides triangles of one block into parts, and finds the point that is farthest away. */
class TriangleSurfaceDistance::Divider
{
public:
  Divider(const TriangleTree & other, const TriangleSurfaceDistanceSettings & settings)
    : m_Distances(other)
    , m_Settings(settings)
  {}

  void
  AddTriangle(const CornersType & corners, const std::array<Measured, 3> & atCorners)
  {
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      this->Improve(corners[corner], atCorners[corner].distance);
    }
    this->Divide(corners, atCorners, MostHalvings);
  }

  std::vector<Part> parts;
  double area = 0.0;
  double integral = 0.0; ///< of the distance, in mm^3
  double maximum = -1.0;
  PositionType farthestPoint{};

private:
  void
  Improve(const PositionType & position, double distance)
  {
    if (distance > maximum)
    {
      maximum = distance;
      farthestPoint = position;
    }
  }

  Measured
  Measure(const PositionType & position)
  {
    const Measured measured = m_Distances.At(position);
    this->Improve(position, measured.distance);
    return measured;
  }

  float
  FindAtCentre(const CornersType & corners, const std::array<Measured, 3> & measured)
  {
    const PositionType centre = Scaled(Add(Add(corners[0], corners[1]), corners[2]), 1.0 / 3.0);
    const auto assumed =
      m_Settings.mostAssumed > 0.0 ? AssumeAtCentre(corners, centre, measured, m_Settings.mostAssumed) : std::nullopt;
    return assumed && *assumed < maximum ? *assumed : this->Measure(centre).distance;
  }

  /** Halves a triangle across its longest side, as long as the settings ask for it. */
  void
  Divide(const CornersType & corners, const std::array<Measured, 3> & measured, unsigned int halvings)
  {
    std::array<double, 3> sides; // opposite to each corner
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      sides[corner] = Distance(corners[(corner + 1) % 3], corners[(corner + 2) % 3]);
    }
    const auto apex = static_cast<unsigned int>(std::max_element(sides.begin(), sides.end()) - sides.begin());
    const std::array<float, 3> distances{ measured[0].distance, measured[1].distance, measured[2].distance };
    const bool isLong = sides[apex] > m_Settings.longestSide;
    float centre = 0.0f;
    bool isBent = false;
    if (!isLong || halvings == 0)
    {
      centre = this->FindAtCentre(corners, measured);
      isBent = sides[apex] > m_Settings.shortestSide &&
               std::abs(centre - (distances[0] + distances[1] + distances[2]) / 3.0f) > m_Settings.mostBent;
    }
    if (halvings == 0 || !(isLong || isBent))
    {
      this->AddPart(corners, distances, centre);
      return;
    }
    const unsigned int left = (apex + 1) % 3;
    const unsigned int right = (apex + 2) % 3;
    const PositionType middle = Mix(corners[left], corners[right], 0.5);
    const Measured atMiddle = this->Measure(middle);
    this->Divide({ corners[apex], corners[left], middle }, { measured[apex], measured[left], atMiddle }, halvings - 1);
    this->Divide(
      { corners[apex], middle, corners[right] }, { measured[apex], atMiddle, measured[right] }, halvings - 1);
  }

  void
  AddPart(const CornersType & corners, const std::array<float, 3> & distances, float centre)
  {
    const auto partArea = static_cast<float>(Area(corners));
    if (partArea > 0.0f)
    {
      parts.push_back({ distances, centre, partArea });
      area += partArea;
      integral += partArea * ((distances[0] + distances[1] + distances[2]) / 12.0 + 0.75 * centre);
    }
  }

  Distances m_Distances;
  const TriangleSurfaceDistanceSettings & m_Settings;
};

double
TriangleSurfaceDistance::FindPercentile(double percent) const
{
  if (m_Parts.empty())
  {
    return m_Maximum;
  }
  // The distance lies between low and high. Undecided parts have distances on both sides of one of them.
  double low = 0.0;
  double high = m_Maximum;
  double areaBelow = 0.0; // of the parts that are nearer than low
  const double wanted = percent / 100.0 * m_Area;
  std::vector<std::vector<Part>> undecided = m_Parts;
  std::vector<double> sums(undecided.size());
  while (high - low > std::max(1e-6 * high, Rounding))
  {
    const double middle = (low + high) / 2.0;
    rhombic::ForEachInBlocks(undecided.size(), 1, [&](std::size_t block) {
      sums[block] = 0.0;
      for (const Part & part : undecided[block])
      {
        sums[block] += part.FindAreaWithin(middle);
      }
    });
    double area = areaBelow;
    for (const double sum : sums)
    {
      area += sum;
    }
    const bool isFarther = area < wanted;
    (isFarther ? low : high) = middle;
    rhombic::ForEachInBlocks(undecided.size(), 1, [&](std::size_t block) {
      const auto isDecided = [&](const Part & part) {
        return isFarther ? part.GetLargest() <= low : part.GetSmallest() > high;
      };
      std::vector<Part> & parts = undecided[block];
      const auto kept = std::partition(parts.begin(), parts.end(), [&](const Part & part) { return !isDecided(part); });
      sums[block] = 0.0;
      std::for_each(kept, parts.end(), [&](const Part & part) { sums[block] += isFarther ? part.area : 0.0; });
      parts.erase(kept, parts.end());
    });
    for (const double sum : sums)
    {
      areaBelow += sum;
    }
  }
  return high;
}

double
TriangleSurfaceDistance::FindAreaWithin(double distance) const
{
  double area = 0.0;
  for (const auto & parts : m_Parts)
  {
    double areaOfBlock = 0.0;
    for (const Part & part : parts)
    {
      areaOfBlock += part.GetLargest() <= distance ? part.area : part.FindAreaWithin(distance);
    }
    area += areaOfBlock;
  }
  return area;
}

SizeValueType
TriangleSurfaceDistance::GetNumberOfParts() const
{
  SizeValueType count = 0;
  for (const auto & parts : m_Parts)
  {
    count += parts.size();
  }
  return count;
}

TriangleSurfaceDistance
ComputeTriangleSurfaceDistance(const TriangleSurface & surface,
                               const TriangleTree & other,
                               const TriangleSurfaceDistanceSettings & settings)
{
  surface.VerifyTriangles();
  TriangleSurfaceDistance result;
  const std::size_t triangles = surface.GetNumberOfTriangles();
  if (triangles == 0)
  {
    return result;
  }
  if (other.GetNumberOfPlacedTriangles() == 0)
  {
    result.m_Mean = result.m_Maximum = std::numeric_limits<double>::infinity();
    return result;
  }
  const std::size_t step = triangles / settings.mostTriangles + (triangles % settings.mostTriangles != 0 ? 1 : 0);
  const BulkVector<Measured> atPoints = MeasurePoints(surface, other, step);
  const std::size_t chosen = (triangles + step - 1) / step;
  std::vector<TriangleSurfaceDistance::Divider> blocks((chosen + BlockSize - 1) / BlockSize, { other, settings });
  rhombic::ForEachBlock(chosen, BlockSize, [&](std::size_t first, std::size_t last) {
    auto & block = blocks[first / BlockSize];
    for (std::size_t n = first; n < last; ++n)
    {
      const auto & triangle = surface.GetTriangles()[n * step];
      const auto & points = surface.GetPoints();
      if (IsFinite(points[triangle[0]]) && IsFinite(points[triangle[1]]) && IsFinite(points[triangle[2]]))
      {
        block.AddTriangle(CornersOf(surface, triangle),
                          { atPoints[triangle[0]], atPoints[triangle[1]], atPoints[triangle[2]] });
      }
    }
  });
  double integral = 0.0;
  for (auto & block : blocks)
  {
    result.m_Area += block.area;
    integral += block.integral;
    if (block.maximum > result.m_Maximum)
    {
      result.m_Maximum = block.maximum;
      result.m_FarthestPoint = block.farthestPoint;
    }
    result.m_Parts.push_back(std::move(block.parts));
  }
  result.m_Mean = result.m_Area > 0.0 ? integral / result.m_Area : 0.0;
  return result;
}

TriangleSurfaceTwoDistances
ComputeTriangleSurfaceDistances(const TriangleSurface & first,
                                const TriangleSurface & second,
                                SizeValueType mostTriangles)
{
  TriangleSurfaceDistanceSettings settings;
  settings.longestSide = 2.0 * std::min(MeanSideOf(first), MeanSideOf(second));
  settings.mostTriangles = mostTriangles;
  return { ComputeTriangleSurfaceDistance(first, TriangleTree(second), settings),
           ComputeTriangleSurfaceDistance(second, TriangleTree(first), settings) };
}

bool
IsInsideTriangleSurface(const TriangleTree & tree, const PositionType & position)
{
  int windings = 0;
  tree.VisitCrossings(ToPoint(position), [&windings](std::uint32_t, int turns) { windings += turns; });
  return windings > 0;
}

BulkVector<float>
ComputeTriangleSurfaceSignedDistances(const TriangleSurface & surface, const TriangleTree & other)
{
  BulkVector<float> found(surface.GetNumberOfPoints());
  rhombic::ForEachBlock(found.size(), BlockSize, [&](std::size_t first, std::size_t last) {
    Distances distances(other);
    for (std::size_t point = first; point < last; ++point)
    {
      const PositionType position = ToPosition(surface.GetPoints()[point]);
      const float distance = distances.At(position).distance;
      found[point] = IsInsideTriangleSurface(other, position) ? -distance : distance;
    }
  });
  return found;
}

} // namespace itk
