#include "rhombicReferenceField.h"

namespace rhombic
{
namespace
{

/** Searches for the foot of the perpendicular from \a point onto the surface, by Newton's method from \a start. */
FieldProjection
Settle(const ReferenceField & field, const Vector3 & point, const Vector3 & start, double unit)
{
  constexpr unsigned int maximumSteps = 30;
  constexpr double longestStep = 0.25;
  constexpr double shortestStep = 1e-4;

  FieldProjection result;
  result.point = start;
  for (unsigned int i = 0; i < maximumSteps && !result.isResolved; ++i)
  {
    Vector3 gradient;
    double height = field.Evaluate(result.point, gradient); // below: of the tangent plane above the point
    const double slope = Length(gradient);
    if (!(slope > 0.0))
    {
      return result;
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      result.normal[axis] = -gradient[axis] / slope;
      height += gradient[axis] * (point[axis] - result.point[axis]);
    }
    const Vector3 foot = Along(point, result.normal, height / slope);
    const Vector3 step = Subtract(foot, result.point);
    const double length = Length(step);
    result.point = Along(result.point, step, length > longestStep * unit ? longestStep * unit / length : 1.0);
    result.isResolved = length < shortestStep * unit;
  }
  result.distance = Length(Subtract(result.point, point));
  return result;
}

/** Searches for the nearest change of the field's sign on 26 rays from a point, in steps of a tenth of a unit up to
 * three units, with linear interpolation within a step. Not resolved if there is none. */
FieldProjection
Search(const ReferenceField & field, const Vector3 & point, double unit)
{
  constexpr unsigned int steps = 30;
  constexpr unsigned int rays = 27; // the middle ray has no direction
  const double stepLength = 0.1 * unit;

  std::array<double, rays> values;
  values.fill(field.Evaluate(point));
  FieldProjection result;
  result.distance = steps * stepLength;
  for (unsigned int step = 1; step <= steps && !result.isResolved; ++step)
  {
    for (unsigned int ray = 0; ray < rays; ++ray)
    {
      const Vector3 direction{ ray % 3 - 1.0, ray / 3 % 3 - 1.0, ray / 9 - 1.0 };
      const double length = Length(direction);
      if (length == 0.0)
      {
        continue;
      }
      const double value = field.Evaluate(Along(point, direction, step * stepLength / length));
      const double before = values[ray];
      values[ray] = value;
      if ((value >= 0.0) == (before >= 0.0))
      {
        continue;
      }
      const double distance = (step - 1 + before / (before - value)) * stepLength;
      if (distance <= result.distance)
      {
        result.point = Along(point, direction, distance / length);
        result.distance = distance;
        result.isResolved = true;
      }
    }
  }
  Vector3 gradient;
  field.Evaluate(result.point, gradient);
  const double slope = Length(gradient);
  if (slope > 0.0)
  {
    result.normal = { -gradient[0] / slope, -gradient[1] / slope, -gradient[2] / slope };
  }
  return result;
}

} // namespace

FieldProjection
ProjectOntoField(const ReferenceField & field, const Vector3 & point, double unit)
{
  constexpr double suspicious = 0.4;
  const FieldProjection settled = Settle(field, point, point, unit);
  if (settled.isResolved && settled.distance <= suspicious * unit)
  {
    return settled;
  }
  FieldProjection found = Search(field, point, unit);
  const FieldProjection improved = found.isResolved ? Settle(field, point, found.point, unit) : found;
  if (improved.isResolved && improved.distance <= found.distance)
  {
    found = improved;
  }
  return settled.isResolved && settled.distance <= found.distance ? settled : found;
}

} // namespace rhombic
