#include "rhombicShapeFields.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

constexpr double twoPi = 6.283185307179586;

} // namespace

SphereField::SphereField(const Vector3 & center, double radius)
  : m_Center(center)
  , m_Radius(radius)
{}

double
SphereField::Evaluate(const Vector3 & point, Vector3 & gradient) const
{
  const Vector3 d = Subtract(point, m_Center);
  const double distance = Length(d);
  const double scale = distance > 0.0 ? -1.0 / distance : 0.0;
  gradient = Scaled(d, scale);
  return m_Radius - distance;
}

TorusField::TorusField(const Vector3 & center, const Vector3 & axis, double major, double minor)
  : m_Center(center)
  , m_Major(major)
  , m_Minor(minor)
{
  const double length = Length(axis);
  m_Axis = { axis[0] / length, axis[1] / length, axis[2] / length };
}

double
TorusField::Evaluate(const Vector3 & point, Vector3 & gradient) const
{
  const Vector3 d = Subtract(point, m_Center);
  const double height = Dot(d, m_Axis);
  const Vector3 radial = Along(d, m_Axis, -height);
  const double radius = Length(radial);
  const double ring = radius - m_Major;
  const double distance = std::sqrt(ring * ring + height * height);
  const double alongRadial = distance > 0.0 && radius > 0.0 ? -ring / (distance * radius) : 0.0;
  const double alongAxis = distance > 0.0 ? -height / distance : 0.0;
  for (unsigned int i = 0; i < 3; ++i)
  {
    gradient[i] = alongRadial * radial[i] + alongAxis * m_Axis[i];
  }
  return m_Minor - distance;
}

GyroidField::GyroidField(double period)
  : m_WaveNumber(twoPi / period)
{}

double
GyroidField::Evaluate(const Vector3 & point, Vector3 & gradient) const
{
  Vector3 s;
  Vector3 c;
  for (unsigned int i = 0; i < 3; ++i)
  {
    s[i] = std::sin(m_WaveNumber * point[i]);
    c[i] = std::cos(m_WaveNumber * point[i]);
  }
  gradient = { m_WaveNumber * (c[0] * c[1] - s[2] * s[0]),
               m_WaveNumber * (c[1] * c[2] - s[0] * s[1]),
               m_WaveNumber * (c[2] * c[0] - s[1] * s[2]) };
  return s[0] * c[1] + s[1] * c[2] + s[2] * c[0];
}

double
MarschnerLobbField::Evaluate(const Vector3 & point, Vector3 & gradient) const
{
  constexpr double alpha = 0.25;
  constexpr double frequency = 6.0;
  constexpr double scale = 1.0 / (2.0 * (1.0 + alpha));
  const double radius = std::sqrt(point[0] * point[0] + point[1] * point[1]);
  const double phase = twoPi * frequency * std::cos(twoPi / 4.0 * radius);
  const double slope = -std::sin(phase) * twoPi * frequency * -std::sin(twoPi / 4.0 * radius) * twoPi / 4.0;
  const double perRadius = radius > 0.0 ? scale * alpha * slope / radius : 0.0;
  gradient = { perRadius * point[0], perRadius * point[1], -scale * std::cos(twoPi / 4.0 * point[2]) * twoPi / 4.0 };
  return scale * (1.0 - std::sin(twoPi / 4.0 * point[2]) + alpha * (1.0 + std::cos(phase))) - 0.5;
}

CornerField::CornerField(double level)
  : m_Level(level)
{}

double
CornerField::Evaluate(const Vector3 & point, Vector3 & gradient) const
{
  const auto largest = std::max_element(point.begin(), point.end());
  gradient = {};
  gradient[static_cast<std::size_t>(largest - point.begin())] = -1.0;
  return m_Level - *largest;
}

} // namespace rhombic
