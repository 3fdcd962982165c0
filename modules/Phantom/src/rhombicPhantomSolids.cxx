#include "rhombicPhantomSolids.h"

#include "itkMath.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rhombic
{
namespace
{

using itk::Math::pi;

/** The integral of \a function over an interval, exact for polynomials up to degree 15. */
template <typename TFunction>
double
Integrate(double first, double last, const TFunction & function)
{
  constexpr std::array<std::pair<double, double>, 4> rule{ { { 0.1834346424956498, 0.3626837833783620 },
                                                             { 0.5255324099163290, 0.3137066458778873 },
                                                             { 0.7966664774136267, 0.2223810344533745 },
                                                             { 0.9602898564975363, 0.1012285362903763 } } };
  const double middle = 0.5 * (first + last);
  const double half = 0.5 * (last - first);
  double sum = 0.0;
  for (const auto & [place, weight] : rule)
  {
    sum += weight * (function(middle - half * place) + function(middle + half * place));
  }
  return half * sum;
}

/** The height of a superellipse with half-axes 1 above \a place. */
double
Superellipse(double place, double exponent)
{
  const double rest = 1.0 - std::pow(std::abs(place), exponent);
  return rest > 0.0 ? std::pow(rest, 1.0 / exponent) : 0.0;
}

/** The integral of Superellipse() over -1 .. 1. */
double
SuperellipseArea(double exponent)
{
  return 2.0 * std::exp(2.0 * std::lgamma(1.0 + 1.0 / exponent) - std::lgamma(1.0 + 2.0 / exponent));
}

/** (1 - r^2)^power, where r is 1 on the ellipse with half-axes 1; 0 outside. Its integral is pi / (power + 1). */
double
Swelling(double u, double v, double power)
{
  const double rest = 1.0 - u * u - v * v;
  return rest > 0.0 ? std::pow(rest, power) : 0.0;
}

/** The least and the greatest value of a profile; both are knots. */
std::pair<double, double>
RangeOf(const PhantomProfile & profile)
{
  const auto & knots = profile.GetKnots();
  const auto less = [](const auto & a, const auto & b) { return a.value < b.value; };
  const auto [low, high] = std::minmax_element(knots.begin(), knots.end(), less);
  return { low->value, high->value };
}

/** The slopes of Fritsch and Carlson: no overshoot between knots. */
std::vector<double>
MonotoneSlopes(const std::vector<PhantomProfile::Knot> & knots)
{
  std::vector<double> slopes(knots.size(), 0.0);
  for (std::size_t i = 1; i + 1 < knots.size(); ++i)
  {
    const double before = (knots[i].value - knots[i - 1].value) / (knots[i].place - knots[i - 1].place);
    const double after = (knots[i + 1].value - knots[i].value) / (knots[i + 1].place - knots[i].place);
    if (before * after > 0.0)
    {
      slopes[i] = 2.0 * before * after / (before + after);
    }
  }
  return slopes;
}

/** The profile of the surface at a depth below the one with \a profile: each knot as deep below every point nearby. */
PhantomProfile
InsetProfile(const PhantomProfile & profile, const PhantomProfile & depth, double bottom, double top)
{
  constexpr double step = 3.0;
  constexpr int directions = 12;
  std::vector<PhantomProfile::Knot> knots;
  const auto count = static_cast<int>(std::ceil((top - bottom) / step)) + 1;
  for (int i = 0; i < count; ++i)
  {
    const double place = bottom + (top - bottom) * i / (count - 1);
    const double radius = depth(place);
    double value = profile(place) - radius;
    for (int k = 0; k <= directions; ++k)
    {
      const double angle = pi * k / directions;
      value = std::min(value, profile(place + radius * std::cos(angle)) - radius * std::sin(angle));
    }
    knots.push_back({ place, value });
  }
  return knots;
}

} // namespace

PhantomProfile::PhantomProfile(std::vector<Knot> knots)
  : m_Knots(std::move(knots))
  , m_Slopes(MonotoneSlopes(m_Knots))
{}

double
PhantomProfile::operator()(double place) const
{
  const auto after =
    std::upper_bound(m_Knots.begin(), m_Knots.end(), place, [](double p, const Knot & knot) { return p < knot.place; });
  if (after == m_Knots.begin() || after == m_Knots.end())
  {
    return after == m_Knots.begin() ? m_Knots.front().value : m_Knots.back().value;
  }
  const auto i = static_cast<std::size_t>(after - m_Knots.begin()) - 1;
  const Knot & low = m_Knots[i];
  const Knot & high = m_Knots[i + 1];
  const double length = high.place - low.place;
  const double t = (place - low.place) / length;
  const double s = 1.0 - t;
  return s * s * ((1.0 + 2.0 * t) * low.value + t * length * m_Slopes[i]) +
         t * t * ((1.0 + 2.0 * s) * high.value - s * length * m_Slopes[i + 1]);
}

PhantomLoft::PhantomLoft(Shape shape)
  : m_Shape(std::move(shape))
{}

PhantomLoft
PhantomLoft::Inset(const PhantomProfile & depth) const
{
  Shape shape = m_Shape;
  shape.bottom += depth(m_Shape.bottom);
  shape.top -= depth(m_Shape.top);
  shape.bottomCap = std::max(0.0, shape.bottomCap - depth(m_Shape.bottom));
  shape.topCap = std::max(0.0, shape.topCap - depth(m_Shape.top));
  for (PhantomProfile * profile : { &shape.width, &shape.front, &shape.back })
  {
    *profile = InsetProfile(*profile, depth, shape.bottom, shape.top);
  }
  return PhantomLoft(shape);
}

double
PhantomLoft::GetCap(double z) const
{
  const double below = m_Shape.bottom + m_Shape.bottomCap - z;
  const double above = z - (m_Shape.top - m_Shape.topCap);
  const double u = below > 0.0 ? below / m_Shape.bottomCap : above > 0.0 ? above / m_Shape.topCap : 0.0;
  return u < 1.0 ? std::sqrt(1.0 - u * u) : 0.0;
}

double
PhantomLoft::GetRelief(bool front, double x, double z) const
{
  double height = 0.0;
  for (const auto & relief : m_Shape.reliefs)
  {
    if (relief.front == front)
    {
      height +=
        relief.height * Swelling((x - relief.x) / relief.halfWidth, (z - relief.z) / relief.halfHeight, relief.power);
    }
  }
  return height;
}

double
PhantomLoft::GetFront(double x, double z) const
{
  const double cap = GetCap(z);
  const double height = Superellipse((x - m_Shape.centreX(z)) / (m_Shape.width(z) * cap), m_Shape.exponent(z));
  return m_Shape.centreY(z) - m_Shape.front(z) * cap * height - GetRelief(true, x, z);
}

double
PhantomLoft::GetSide(double y, double z) const
{
  const double dy = y - m_Shape.centreY(z);
  const double cap = GetCap(z);
  const double depth = (dy < 0.0 ? m_Shape.front(z) : m_Shape.back(z)) * cap;
  return depth > 0.0 ? m_Shape.width(z) * cap * Superellipse(dy / depth, m_Shape.exponent(z)) : 0.0;
}

PhantomSpan
PhantomLoft::GetSpan(const PhantomPoint & point) const
{
  const double x = point[0];
  const double z = point[2];
  if (z < m_Shape.bottom || z > m_Shape.top)
  {
    return {};
  }
  const double cap = GetCap(z);
  const double width = m_Shape.width(z) * cap;
  const double dx = x - m_Shape.centreX(z);
  if (!(std::abs(dx) < width))
  {
    return {};
  }
  const double height = cap * Superellipse(dx / width, m_Shape.exponent(z));
  const double centreY = m_Shape.centreY(z);
  return { centreY - m_Shape.front(z) * height - GetRelief(true, x, z),
           centreY + m_Shape.back(z) * height + GetRelief(false, x, z) };
}

PhantomBounds
PhantomLoft::GetBounds() const
{
  double front = RangeOf(m_Shape.front).second;
  double back = RangeOf(m_Shape.back).second;
  for (const auto & relief : m_Shape.reliefs)
  {
    (relief.front ? front : back) += std::max(0.0, relief.height);
  }
  const double width = RangeOf(m_Shape.width).second;
  const auto [right, left] = RangeOf(m_Shape.centreX);
  const auto [anterior, posterior] = RangeOf(m_Shape.centreY);
  return { { right - width, anterior - front, m_Shape.bottom }, { left + width, posterior + back, m_Shape.top } };
}

double
PhantomLoft::GetVolume() const
{
  constexpr int pieces = 4; // a knot interval's integrand is no polynomial where the exponent varies
  std::vector<double> places{
    m_Shape.bottom, m_Shape.bottom + m_Shape.bottomCap, m_Shape.top - m_Shape.topCap, m_Shape.top
  };
  for (const PhantomProfile * profile : { &m_Shape.width, &m_Shape.front, &m_Shape.back, &m_Shape.exponent })
  {
    for (const auto & knot : profile->GetKnots())
    {
      places.push_back(std::clamp(knot.place, m_Shape.bottom, m_Shape.top));
    }
  }
  std::sort(places.begin(), places.end());

  const auto area = [this](double z) {
    const double cap = GetCap(z);
    return cap * cap * m_Shape.width(z) * (m_Shape.front(z) + m_Shape.back(z)) * SuperellipseArea(m_Shape.exponent(z));
  };
  double volume = 0.0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
  {
    const double step = (places[i + 1] - places[i]) / pieces;
    for (int k = 0; k < pieces; ++k)
    {
      volume += Integrate(places[i] + k * step, places[i] + (k + 1) * step, area);
    }
  }
  for (const auto & relief : m_Shape.reliefs)
  {
    volume += relief.height * relief.halfWidth * relief.halfHeight * pi / (relief.power + 1.0);
  }
  return volume;
}

PhantomEllipsoid::PhantomEllipsoid(const PhantomPoint & centre,
                                   const PhantomPoint & halfAxes,
                                   const PhantomPoint & turns)
  : m_Centre(centre)
  , m_HalfAxes(halfAxes)
  , m_Directions{ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }
{
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    const double cosine = std::cos(turns[axis] * pi / 180.0);
    const double sine = std::sin(turns[axis] * pi / 180.0);
    const auto u = (axis + 1) % 3;
    const auto v = (axis + 2) % 3;
    for (auto & direction : m_Directions)
    {
      direction = [&] {
        PhantomPoint turned = direction;
        turned[u] = cosine * direction[u] - sine * direction[v];
        turned[v] = sine * direction[u] + cosine * direction[v];
        return turned;
      }();
    }
  }
}

PhantomSpan
PhantomEllipsoid::GetSpan(const PhantomPoint & point) const
{
  // |S (offset + t e_y)|^2 = 1 is a t^2 + 2 b t + c = 0.
  double a = 0.0;
  double b = 0.0;
  double c = -1.0;
  for (unsigned k = 0; k < 3; ++k)
  {
    const auto & direction = m_Directions[k];
    const double slope = direction[1] / m_HalfAxes[k];
    const double offset =
      (direction[0] * (point[0] - m_Centre[0]) + direction[2] * (point[2] - m_Centre[2])) / m_HalfAxes[k];
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
  return { m_Centre[1] + (-b - root) / a, m_Centre[1] + (-b + root) / a };
}

PhantomBounds
PhantomEllipsoid::GetBounds() const
{
  PhantomBounds bounds{ m_Centre, m_Centre };
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    double square = 0.0;
    for (unsigned k = 0; k < 3; ++k)
    {
      square += std::pow(m_Directions[k][axis] * m_HalfAxes[k], 2);
    }
    bounds.low[axis] -= std::sqrt(square);
    bounds.high[axis] += std::sqrt(square);
  }
  return bounds;
}

double
PhantomEllipsoid::GetVolume() const
{
  return 4.0 / 3.0 * pi * m_HalfAxes[0] * m_HalfAxes[1] * m_HalfAxes[2];
}

PhantomCapsule::PhantomCapsule(const PhantomPoint & first, const PhantomPoint & last, double radius)
  : m_First(first)
  , m_Last(last)
  , m_Radius(radius)
{}

PhantomSpan
PhantomCapsule::GetSpan(const PhantomPoint & point) const
{
  PhantomSpan span{ std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest() };
  const auto widen = [&span](double first, double last) {
    span.first = std::min(span.first, first);
    span.last = std::max(span.last, last);
  };
  for (const auto & centre : { m_First, m_Last })
  {
    const double square = m_Radius * m_Radius - std::pow(point[0] - centre[0], 2) - std::pow(point[2] - centre[2], 2);
    if (square > 0.0)
    {
      widen(centre[1] - std::sqrt(square), centre[1] + std::sqrt(square));
    }
  }

  // The cylinder: a point at y = m_First[1] + t is offset + t e_y from the first end; its distance from the axis is a
  // quadratic in t, its place along the axis is linear.
  const PhantomPoint along{ m_Last[0] - m_First[0], m_Last[1] - m_First[1], m_Last[2] - m_First[2] };
  const double square = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
  const double x = point[0] - m_First[0];
  const double z = point[2] - m_First[2];
  const double place = (x * along[0] + z * along[2]) / square;
  const double slope = along[1] / square;
  const double a = 1.0 - slope * along[1];
  const double b = -slope * (x * along[0] + z * along[2]);
  const double c = x * x + z * z - place * place * square - m_Radius * m_Radius;
  const double discriminant = b * b - a * c;
  if (discriminant > 0.0)
  {
    double first = (-b - std::sqrt(discriminant)) / a;
    double last = (-b + std::sqrt(discriminant)) / a;
    if (slope != 0.0)
    {
      first = std::max(first, std::min(-place / slope, (1.0 - place) / slope));
      last = std::min(last, std::max(-place / slope, (1.0 - place) / slope));
    }
    if (first < last && (slope != 0.0 || (0.0 <= place && place <= 1.0)))
    {
      widen(m_First[1] + first, m_First[1] + last);
    }
  }
  return span;
}

PhantomBounds
PhantomCapsule::GetBounds() const
{
  PhantomBounds bounds;
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    bounds.low[axis] = std::min(m_First[axis], m_Last[axis]) - m_Radius;
    bounds.high[axis] = std::max(m_First[axis], m_Last[axis]) + m_Radius;
  }
  return bounds;
}

double
PhantomCapsule::GetVolume() const
{
  const double length = std::hypot(m_Last[0] - m_First[0], m_Last[1] - m_First[1], m_Last[2] - m_First[2]);
  return pi * m_Radius * m_Radius * (length + 4.0 / 3.0 * m_Radius);
}

PhantomHoop::PhantomHoop(Shape shape)
  : m_Shape(std::move(shape))
  , m_RelativeThickness(m_Shape.halfThickness / std::sqrt(m_Shape.radiusX * m_Shape.radiusY))
  , m_Bounds(ComputeBounds())
{}

PhantomSpan
PhantomHoop::GetSpan(const PhantomPoint & point) const
{
  const double u = (point[0] - m_Shape.centreX) / m_Shape.radiusX;
  const double v = (point[1] - m_Shape.centreY) / m_Shape.radiusY;
  const double across = (std::sqrt(u * u + v * v) - 1.0) / m_RelativeThickness;
  if (std::abs(across) >= 1.0)
  {
    return {};
  }
  const double angle = std::atan2(u, m_Shape.fromBack ? v : -v);
  const double middle = 0.5 * (m_Shape.firstAngle + m_Shape.lastAngle);
  const double along = (angle - middle) / (m_Shape.lastAngle - middle);
  const double square = 1.0 - std::pow(along, 8) - across * across;
  if (square <= 0.0)
  {
    return {};
  }
  const double half = m_Shape.halfHeight * std::sqrt(square);
  const double height = m_Shape.height(angle);
  return { height - half, height + half };
}

PhantomBounds
PhantomHoop::ComputeBounds() const
{
  // Extremes of the middle ellipse lie at the ends or on the axes; those of the height at its knots.
  constexpr int steps = 256;
  const double low = 1.0 - m_RelativeThickness;
  const double high = 1.0 + m_RelativeThickness;
  PhantomBounds bounds;
  bounds.low.fill(std::numeric_limits<double>::max());
  bounds.high.fill(std::numeric_limits<double>::lowest());
  const auto widen = [&bounds](unsigned axis, double value) {
    bounds.low[axis] = std::min(bounds.low[axis], value);
    bounds.high[axis] = std::max(bounds.high[axis], value);
  };
  for (int i = 0; i <= steps; ++i)
  {
    const double angle = m_Shape.firstAngle + (m_Shape.lastAngle - m_Shape.firstAngle) * i / steps;
    for (const double radius : { low, high })
    {
      widen(0, m_Shape.centreX + radius * m_Shape.radiusX * std::sin(angle));
      widen(1, m_Shape.centreY + (m_Shape.fromBack ? radius : -radius) * m_Shape.radiusY * std::cos(angle));
    }
    widen(2, m_Shape.height(angle) - m_Shape.halfHeight);
    widen(2, m_Shape.height(angle) + m_Shape.halfHeight);
  }
  for (unsigned axis = 0; axis < 3; ++axis) // what lies between two steps
  {
    bounds.low[axis] -= 0.5;
    bounds.high[axis] += 0.5;
  }
  return bounds;
}

double
PhantomHoop::GetVolume() const
{
  // The radius's Jacobian averages to that of the middle; the taper's square, 1 - along^8, averages to 8/9.
  const double section = pi * m_RelativeThickness * m_Shape.halfHeight;
  return m_Shape.radiusX * m_Shape.radiusY * section * (m_Shape.lastAngle - m_Shape.firstAngle) * 8.0 / 9.0;
}

PhantomPlate::PhantomPlate(std::shared_ptr<const PhantomLoft> loft,
                           std::pair<double, double> rangeX,
                           std::pair<double, double> rangeZ,
                           double thickness)
  : m_Loft(std::move(loft))
  , m_RangeX(rangeX)
  , m_RangeZ(rangeZ)
  , m_Thickness(thickness)
{}

PhantomSpan
PhantomPlate::GetSpan(const PhantomPoint & point) const
{
  if (point[0] < m_RangeX.first || point[0] > m_RangeX.second || point[2] < m_RangeZ.first ||
      point[2] > m_RangeZ.second)
  {
    return {};
  }
  const double front = m_Loft->GetFront(point[0], point[2]);
  return { front - m_Thickness, front };
}

PhantomBounds
PhantomPlate::GetBounds() const
{
  const PhantomBounds loft = m_Loft->GetBounds();
  return { { m_RangeX.first, loft.low[1] - m_Thickness, m_RangeZ.first },
           { m_RangeX.second, loft.high[1], m_RangeZ.second } };
}

double
PhantomPlate::GetVolume() const
{
  return (m_RangeX.second - m_RangeX.first) * (m_RangeZ.second - m_RangeZ.first) * m_Thickness;
}

PhantomFlap::PhantomFlap(std::shared_ptr<const PhantomLoft> loft, const Shape & shape)
  : m_Loft(std::move(loft))
  , m_Shape(shape)
{}

PhantomSpan
PhantomFlap::GetSpan(const PhantomPoint & point) const
{
  const double height =
    m_Shape.height *
    Swelling((point[1] - m_Shape.y) / m_Shape.halfDepth, (point[2] - m_Shape.z) / m_Shape.halfHeight, m_Shape.power);
  if (height <= 0.0)
  {
    return {};
  }
  const double side = m_Loft->GetSide(point[1], point[2]);
  const PhantomSpan left{ side, side + height };
  return m_Shape.left ? left : PhantomSpan{ -left.last, -left.first };
}

PhantomBounds
PhantomFlap::GetBounds() const
{
  const double reach = m_Loft->GetBounds().high[0] + m_Shape.height;
  return { { m_Shape.left ? 0.0 : -reach, m_Shape.y - m_Shape.halfDepth, m_Shape.z - m_Shape.halfHeight },
           { m_Shape.left ? reach : 0.0, m_Shape.y + m_Shape.halfDepth, m_Shape.z + m_Shape.halfHeight } };
}

double
PhantomFlap::GetVolume() const
{
  return m_Shape.height * m_Shape.halfDepth * m_Shape.halfHeight * pi / (m_Shape.power + 1.0);
}

} // namespace rhombic
