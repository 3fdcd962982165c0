#include "rhombicPhantomSolids.h"

#include "itkMath.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

using itk::Math::pi;

// ---- Profiles

/** The slopes of Fritsch and Carlson: no overshoot between knots. */
std::vector<double>
MonotoneSlopes(const std::vector<PhantomProfile::Knot> & knots)
{
  std::vector<double> slopes(knots.size(), 0.0);
  for (std::size_t i = 1; i + 1 < knots.size(); ++i)
  {
    const double before = (knots[i].value - knots[i - 1].value) / (knots[i].position - knots[i - 1].position);
    const double after = (knots[i + 1].value - knots[i].value) / (knots[i + 1].position - knots[i].position);
    if (before * after > 0.0)
    {
      slopes[i] = 2.0 * before * after / (before + after);
    }
  }
  return slopes;
}

/** The least and the greatest value of a profile; both are at knots. */
std::pair<double, double>
RangeOf(const PhantomProfile & profile)
{
  const auto & knots = profile.GetKnots();
  const auto less = [](const auto & a, const auto & b) { return a.value < b.value; };
  const auto [low, high] = std::minmax_element(knots.begin(), knots.end(), less);
  return { low->value, high->value };
}

/** The profile whose knots lie at a depth below the curve of another profile, at right angles to that curve. */
PhantomProfile
InsetProfile(const PhantomProfile & profile, const PhantomProfile & depth)
{
  std::vector<PhantomProfile::Knot> knots = profile.GetKnots();
  const std::vector<double> slopes = MonotoneSlopes(knots);
  for (std::size_t i = 0; i < knots.size(); ++i)
  {
    knots[i].value -= depth(knots[i].position) * std::hypot(1.0, slopes[i]);
  }
  return knots;
}

// ---- Lofts

/** The height above \a position of a superellipse with half-axes 1. */
double
Superellipse(double position, double exponent)
{
  const double rest = 1.0 - std::pow(std::abs(position), exponent);
  return rest > 0.0 ? std::pow(rest, 1.0 / exponent) : 0.0;
}

/** The integral of Superellipse() over -1 .. 1. */
double
SuperellipseArea(double exponent)
{
  return 2.0 * std::exp(2.0 * std::lgamma(1.0 + 1.0 / exponent) - std::lgamma(1.0 + 2.0 / exponent));
}

/** The size of the cross-section at a height where a cap closes it, relative to the size without cap. */
double
CapOf(const PhantomLoft & loft, double z)
{
  const double below = loft.bottom + loft.bottomCap - z;
  const double above = z - (loft.top - loft.topCap);
  const double u = below > 0.0 ? below / loft.bottomCap : above > 0.0 ? above / loft.topCap : 0.0;
  return u < 1.0 ? std::sqrt(1.0 - u * u) : 0.0;
}

double
ReliefAt(const PhantomLoft & loft, double x, double z)
{
  double height = 0.0;
  for (const auto & relief : loft.reliefs)
  {
    const double u = (x - relief.x) / relief.halfWidth;
    const double v = (z - relief.z) / relief.halfHeight;
    const double rest = 1.0 - u * u - v * v;
    height += rest > 0.0 ? relief.height * std::pow(rest, relief.power) : 0.0;
  }
  return height;
}

PhantomSpan
LoftSpan(const PhantomLoft & loft, double x, double z)
{
  if (z < loft.bottom || z > loft.top)
  {
    return {};
  }
  const double cap = CapOf(loft, z);
  const double position = (x - loft.centreX(z)) / (loft.width(z) * cap);
  if (!(std::abs(position) < 1.0))
  {
    return {};
  }
  const double height = cap * Superellipse(position, loft.exponent(z));
  const double centre = loft.centreY(z);
  return { centre - loft.front(z) * height - ReliefAt(loft, x, z), centre + loft.back(z) * height };
}

PhantomBounds
LoftBounds(const PhantomLoft & loft)
{
  double front = RangeOf(loft.front).second;
  for (const auto & relief : loft.reliefs)
  {
    front += std::max(0.0, relief.height);
  }
  const double back = RangeOf(loft.back).second;
  const double width = RangeOf(loft.width).second;
  const auto [right, left] = RangeOf(loft.centreX);
  const auto [anterior, posterior] = RangeOf(loft.centreY);
  return { { right - width, anterior - front, loft.bottom }, { left + width, posterior + back, loft.top } };
}

/** The integral of the cross-sections' areas by Gauss quadrature between neighbouring knots, where the area is smooth;
 * and the integrals of the reliefs. */
double
LoftVolume(const PhantomLoft & loft)
{
  std::vector<double> heights{ loft.bottom, loft.bottom + loft.bottomCap, loft.top - loft.topCap, loft.top };
  for (const PhantomProfile * profile : { &loft.width, &loft.front, &loft.back, &loft.exponent })
  {
    for (const auto & knot : profile->GetKnots())
    {
      heights.push_back(std::clamp(knot.position, loft.bottom, loft.top));
    }
  }
  std::sort(heights.begin(), heights.end());

  constexpr int pieces = 8; // between two knots: errors of the volume are below 1e-9 of it
  const std::pair<double, double> nodesAndWeights[] = { { -std::sqrt(0.6), 5.0 / 9.0 },
                                                        { 0.0, 8.0 / 9.0 },
                                                        { std::sqrt(0.6), 5.0 / 9.0 } };
  double volume = 0.0;
  for (std::size_t i = 0; i + 1 < heights.size(); ++i)
  {
    const double half = (heights[i + 1] - heights[i]) / (2 * pieces);
    for (int k = 0; k < pieces; ++k)
    {
      for (const auto & [node, weight] : nodesAndWeights)
      {
        const double z = heights[i] + half * (2 * k + 1 + node);
        const double cap = CapOf(loft, z);
        volume += half * weight * cap * cap * loft.width(z) * (loft.front(z) + loft.back(z)) *
                  SuperellipseArea(loft.exponent(z));
      }
    }
  }
  for (const auto & relief : loft.reliefs)
  {
    volume += relief.height * relief.halfWidth * relief.halfHeight * pi / (relief.power + 1.0);
  }
  return volume;
}

// ---- Hoops

PhantomSpan
HoopSpan(const PhantomHoop & hoop, double relativeThickness, const PhantomPoint & point)
{
  const double u = point[0] / hoop.radiusX;
  const double v = (point[1] - hoop.centreY) / hoop.radiusY;
  const double across = (std::sqrt(u * u + v * v) - 1.0) / relativeThickness;
  if (std::abs(across) >= 1.0)
  {
    return {};
  }
  const double angle = std::atan2(u, v);
  const double middle = 0.5 * (hoop.firstAngle + hoop.lastAngle);
  const double along = (angle - middle) / (hoop.lastAngle - middle);
  const double square = 1.0 - std::pow(along, 8) - across * across;
  if (square <= 0.0)
  {
    return {};
  }
  const double half = hoop.halfHeight * std::sqrt(square);
  const double height = hoop.height(angle);
  return { height - half, height + half };
}

} // namespace

PhantomProfile::PhantomProfile(std::vector<Knot> knots)
  : m_Knots(std::move(knots))
  , m_Slopes(MonotoneSlopes(m_Knots))
{}

double
PhantomProfile::operator()(double position) const
{
  const auto after = std::upper_bound(
    m_Knots.begin(), m_Knots.end(), position, [](double p, const Knot & knot) { return p < knot.position; });
  if (after == m_Knots.begin() || after == m_Knots.end())
  {
    return after == m_Knots.begin() ? m_Knots.front().value : m_Knots.back().value;
  }
  const auto i = static_cast<std::size_t>(after - m_Knots.begin()) - 1;
  const Knot & low = m_Knots[i];
  const Knot & high = m_Knots[i + 1];
  const double length = high.position - low.position;
  const double t = (position - low.position) / length;
  const double s = 1.0 - t;
  return s * s * ((1.0 + 2.0 * t) * low.value + t * length * m_Slopes[i]) +
         t * t * ((1.0 + 2.0 * s) * high.value - s * length * m_Slopes[i + 1]);
}

PhantomLoft
InsetOf(const PhantomLoft & loft, const PhantomProfile & depth)
{
  PhantomLoft inset = loft;
  inset.bottom += depth(loft.bottom);
  inset.top -= depth(loft.top);
  inset.bottomCap = std::max(0.0, loft.bottomCap - depth(loft.bottom));
  inset.topCap = std::max(0.0, loft.topCap - depth(loft.top));
  for (PhantomProfile * profile : { &inset.width, &inset.front, &inset.back })
  {
    *profile = InsetProfile(*profile, depth);
  }
  return inset;
}

PhantomSolid
MakeLoft(PhantomLoft loft)
{
  const PhantomBounds bounds = LoftBounds(loft);
  const double volume = LoftVolume(loft);
  return { 1, bounds, volume, [loft = std::move(loft)](const PhantomPoint & point) {
            return LoftSpan(loft, point[0], point[2]);
          } };
}

PhantomSolid
MakeEllipsoid(const PhantomPoint & centre, const PhantomPoint & halfAxes, const PhantomPoint & turns)
{
  std::array<PhantomPoint, 3> directions{ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    const double cosine = std::cos(turns[axis] * pi / 180.0);
    const double sine = std::sin(turns[axis] * pi / 180.0);
    const auto u = (axis + 1) % 3;
    const auto v = (axis + 2) % 3;
    for (auto & direction : directions)
    {
      const PhantomPoint before = direction;
      direction[u] = cosine * before[u] - sine * before[v];
      direction[v] = sine * before[u] + cosine * before[v];
    }
  }

  PhantomBounds bounds{ centre, centre };
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    const double reach = std::hypot(
      directions[0][axis] * halfAxes[0], directions[1][axis] * halfAxes[1], directions[2][axis] * halfAxes[2]);
    bounds.low[axis] -= reach;
    bounds.high[axis] += reach;
  }

  const auto spanAt = [centre, halfAxes, directions](const PhantomPoint & point) -> PhantomSpan {
    // The point at centre[1] + t is on the surface when a t^2 + 2 b t + c = 0.
    double a = 0.0;
    double b = 0.0;
    double c = -1.0;
    for (unsigned k = 0; k < 3; ++k)
    {
      const auto & direction = directions[k];
      const double slope = direction[1] / halfAxes[k];
      const double offset =
        (direction[0] * (point[0] - centre[0]) + direction[2] * (point[2] - centre[2])) / halfAxes[k];
      a += slope * slope;
      b += slope * offset;
      c += offset * offset;
    }
    const double discriminant = b * b - a * c;
    if (discriminant <= 0.0)
    {
      return {};
    }
    const double root = std::sqrt(discriminant);
    return { centre[1] + (-b - root) / a, centre[1] + (-b + root) / a };
  };
  return { 1, bounds, 4.0 / 3.0 * pi * halfAxes[0] * halfAxes[1] * halfAxes[2], spanAt };
}

PhantomSolid
MakeHoop(PhantomHoop hoop)
{
  const double radii = std::abs(hoop.radiusX * hoop.radiusY);
  const double relativeThickness = hoop.halfThickness / std::sqrt(radii);
  // The mean of the taper's square, 1 - along^8, is 8/9.
  const double section = pi * relativeThickness * hoop.halfHeight;
  const double volume = radii * section * (hoop.lastAngle - hoop.firstAngle) * 8.0 / 9.0;
  const double reachX = (1.0 + relativeThickness) * std::abs(hoop.radiusX);
  const double reachY = (1.0 + relativeThickness) * std::abs(hoop.radiusY);
  const auto [low, high] = RangeOf(hoop.height);
  const PhantomBounds bounds{ { -reachX, hoop.centreY - reachY, low - hoop.halfHeight },
                              { reachX, hoop.centreY + reachY, high + hoop.halfHeight } };
  return { 2, bounds, volume, [hoop = std::move(hoop), relativeThickness](const PhantomPoint & point) {
            return HoopSpan(hoop, relativeThickness, point);
          } };
}

PhantomSolid
MakePlate(const PhantomLoft & loft,
          std::pair<double, double> rangeX,
          std::pair<double, double> rangeZ,
          double thickness)
{
  const PhantomBounds around = LoftBounds(loft);
  const PhantomBounds bounds{ { rangeX.first, around.low[1] - thickness, rangeZ.first },
                              { rangeX.second, around.high[1], rangeZ.second } };
  const double volume = (rangeX.second - rangeX.first) * (rangeZ.second - rangeZ.first) * thickness;
  return { 1, bounds, volume, [=](const PhantomPoint & point) -> PhantomSpan {
            const double x = point[0];
            const double z = point[2];
            if (x < rangeX.first || x > rangeX.second || z < rangeZ.first || z > rangeZ.second)
            {
              return {};
            }
            const double front = LoftSpan(loft, x, z).first;
            return { front - thickness, front };
          } };
}

} // namespace rhombic
