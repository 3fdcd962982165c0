#include "rhombicFieldProjection.h"

#include <cmath>

namespace rhombic
{

FieldProjection
ProjectOntoField(const ReferenceField & field, const Vector3 & point, double unit)
{
  constexpr unsigned int maximumSteps = 60;
  constexpr double longestStep = 0.25;
  constexpr double shortestStep = 1e-4;

  FieldProjection result;
  result.point = point;
  double firstGuess = 0.0;
  for (unsigned int i = 0; i < maximumSteps && !result.isResolved; ++i)
  {
    Vector3 gradient;
    const double value = field.Evaluate(result.point, gradient);
    double height = value; // of the tangent plane over the point
    double squared = 0.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      height += gradient[axis] * (point[axis] - result.point[axis]);
      squared += gradient[axis] * gradient[axis];
    }
    if (!(squared > 0.0))
    {
      break;
    }
    const double length = std::sqrt(squared);
    Vector3 step;
    double stepLength = 0.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      result.normal[axis] = -gradient[axis] / length;
      step[axis] = point[axis] - gradient[axis] * height / squared - result.point[axis];
      stepLength += step[axis] * step[axis];
    }
    stepLength = std::sqrt(stepLength);
    const double shortening = stepLength > longestStep * unit ? longestStep * unit / stepLength : 1.0;
    result.distance = 0.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      result.point[axis] += shortening * step[axis];
      result.distance += (result.point[axis] - point[axis]) * (result.point[axis] - point[axis]);
    }
    result.distance = std::sqrt(result.distance);
    if (i == 0)
    {
      firstGuess = std::abs(value) / length;
    }
    result.isResolved = stepLength < shortestStep * unit;
  }
  if (!result.isResolved)
  {
    result.distance = firstGuess;
  }
  return result;
}

} // namespace rhombic
