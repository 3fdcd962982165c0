#include "itkTriangleSurfaceAgreement.h"

#include "itkMacro.h"
#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace itk
{
namespace
{

constexpr double MostBent = 0.1;     // mm
constexpr double LongestSide = 6.0;  // mm
constexpr double MostParts = 1e6;    // of a surface, because of the longest side alone, or some more
constexpr double ShortestSide = 0.1; // mm
constexpr double MostAssumed = 0.01; // mm; what is assumed is far nearer to the truth

/** A surface that is compared with another one. */
struct Side
{
  explicit Side(const TriangleSurface & surface)
    : tree(surface)
  {}

  TriangleTree tree;
  TriangleSurfaceDistance toOther{};
};

TriangleSurfaceAgreement
AgreeOnNothing(bool areBothEmpty)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  TriangleSurfaceAgreement agreement;
  if (!areBothEmpty)
  {
    agreement.hausdorff = agreement.hausdorff95 = infinity;
    agreement.meanOfMeans = agreement.pooledMean = infinity;
  }
  agreement.normalizedDice = areBothEmpty ? 1.0 : 0.0;
  return agreement;
}

/** A place of one surface that is outside of the other is enclosed by the first alone, else by the other alone. */
void
SetWorst(const Side & first, const Side & second, TriangleSurfaceAgreement & agreement)
{
  const bool isOfFirst = first.toOther.GetMaximum() >= second.toOther.GetMaximum();
  const Side & farther = isOfFirst ? first : second;
  const Side & other = isOfFirst ? second : first;
  agreement.hausdorff = farther.toOther.GetMaximum();
  agreement.worst = farther.toOther.GetFarthestPoint();
  const bool isInFirst = isOfFirst != IsInsideTriangleSurface(other.tree, agreement.worst);
  agreement.worstSide = isInFirst ? TriangleSurfaceAgreement::Side::First : TriangleSurfaceAgreement::Side::Second;
}

} // namespace

TriangleSurfaceAgreement
ComputeTriangleSurfaceAgreement(const TriangleSurface & first, const TriangleSurface & second, double tolerance)
{
  if (!(tolerance >= 0.0))
  {
    itkGenericExceptionMacro("The tolerance of the normalised surface Dice must be at least 0 mm, not " << tolerance);
  }
  const double areaOfFirst = ComputeTriangleSurfaceArea(first);
  const double areaOfSecond = ComputeTriangleSurfaceArea(second);
  const bool isFirstEmpty = !(areaOfFirst > 0.0);
  const bool isSecondEmpty = !(areaOfSecond > 0.0);
  if (isFirstEmpty || isSecondEmpty)
  {
    return AgreeOnNothing(isFirstEmpty && isSecondEmpty);
  }
  TriangleSurfaceDistanceSettings settings;
  settings.longestSide = std::max(LongestSide, std::sqrt(std::max(areaOfFirst, areaOfSecond) / MostParts));
  settings.mostBent = MostBent;
  settings.shortestSide = tolerance > 0.0 ? std::min(ShortestSide, tolerance / 4.0) : ShortestSide;
  settings.mostAssumed = MostAssumed;
  Side one(first);
  Side two(second);
  one.toOther = ComputeTriangleSurfaceDistance(first, two.tree, settings);
  two.toOther = ComputeTriangleSurfaceDistance(second, one.tree, settings);

  const double area = one.toOther.GetArea() + two.toOther.GetArea();
  TriangleSurfaceAgreement agreement;
  agreement.hausdorff95 = std::max(one.toOther.FindPercentile(95.0), two.toOther.FindPercentile(95.0));
  agreement.meanOfMeans = (one.toOther.GetMean() + two.toOther.GetMean()) / 2.0;
  agreement.pooledMean =
    (one.toOther.GetArea() * one.toOther.GetMean() + two.toOther.GetArea() * two.toOther.GetMean()) / area;
  agreement.normalizedDice = (one.toOther.FindAreaWithin(tolerance) + two.toOther.FindAreaWithin(tolerance)) / area;
  SetWorst(one, two, agreement);
  return agreement;
}

} // namespace itk
