#include "rhombicShapeFields.h"

#include "itkBSplineInterpolateImageFunction.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

constexpr double twoPi = 6.283185307179586;

} // namespace

ReferenceField
MakeSphereField(const Vector3 & center, double radius)
{
  return ReferenceField([center, radius](const Vector3 & point, Vector3 & gradient) {
    const Vector3 d = Subtract(point, center);
    const double distance = Length(d);
    gradient = Scaled(d, distance > 0.0 ? -1.0 / distance : 0.0);
    return radius - distance;
  });
}

ReferenceField
MakeTorusField(const Vector3 & center, const Vector3 & axis, double major, double minor)
{
  const double length = Length(axis);
  const Vector3 unit{ axis[0] / length, axis[1] / length, axis[2] / length };
  return ReferenceField([center, unit, major, minor](const Vector3 & point, Vector3 & gradient) {
    const Vector3 d = Subtract(point, center);
    const double height = Dot(d, unit);
    const Vector3 radial = Along(d, unit, -height);
    const double radius = Length(radial);
    const double ring = radius - major;
    const double distance = std::sqrt(ring * ring + height * height);
    const double alongRadial = distance > 0.0 && radius > 0.0 ? -ring / (distance * radius) : 0.0;
    const double alongAxis = distance > 0.0 ? -height / distance : 0.0;
    gradient = Along(Scaled(radial, alongRadial), unit, alongAxis);
    return minor - distance;
  });
}

ReferenceField
MakeGyroidField(double period)
{
  return ReferenceField([waveNumber = twoPi / period](const Vector3 & point, Vector3 & gradient) {
    Vector3 s;
    Vector3 c;
    for (unsigned int i = 0; i < 3; ++i)
    {
      s[i] = std::sin(waveNumber * point[i]);
      c[i] = std::cos(waveNumber * point[i]);
    }
    gradient = { waveNumber * (c[0] * c[1] - s[2] * s[0]),
                 waveNumber * (c[1] * c[2] - s[0] * s[1]),
                 waveNumber * (c[2] * c[0] - s[1] * s[2]) };
    return s[0] * c[1] + s[1] * c[2] + s[2] * c[0];
  });
}

ReferenceField
MakeMarschnerLobbField()
{
  return ReferenceField([](const Vector3 & point, Vector3 & gradient) {
    constexpr double alpha = 0.25;
    constexpr double frequency = 6.0;
    constexpr double scale = 1.0 / (2.0 * (1.0 + alpha));
    const double radius = std::sqrt(point[0] * point[0] + point[1] * point[1]);
    const double phase = twoPi * frequency * std::cos(twoPi / 4.0 * radius);
    const double slope = -std::sin(phase) * twoPi * frequency * -std::sin(twoPi / 4.0 * radius) * twoPi / 4.0;
    const double perRadius = radius > 0.0 ? scale * alpha * slope / radius : 0.0;
    gradient = { perRadius * point[0], perRadius * point[1], -scale * std::cos(twoPi / 4.0 * point[2]) * twoPi / 4.0 };
    return scale * (1.0 - std::sin(twoPi / 4.0 * point[2]) + alpha * (1.0 + std::cos(phase))) - 0.5;
  });
}

ReferenceField
MakeCornerField(double level)
{
  return ReferenceField([level](const Vector3 & point, Vector3 & gradient) {
    const auto largest = std::max_element(point.begin(), point.end());
    gradient = {};
    gradient[static_cast<std::size_t>(largest - point.begin())] = -1.0;
    return level - *largest;
  });
}

ReferenceField
MakeInterpolatedField(const itk::Image<float, 3> * volume)
{
  using SplineType = itk::BSplineInterpolateImageFunction<itk::Image<float, 3>, double, double>;
  const auto spline = SplineType::New();
  spline->SetSplineOrder(3);
  spline->SetInputImage(volume);
  return ReferenceField([spline](const Vector3 & point, Vector3 & gradient) {
    SplineType::OutputType value;
    SplineType::CovariantVectorType derivative;
    spline->EvaluateValueAndDerivative(itk::Point<double, 3>(point), value, derivative);
    gradient = { derivative[0], derivative[1], derivative[2] };
    return value;
  });
}

} // namespace rhombic
