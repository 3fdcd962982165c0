#include "rhombicShapeFields.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

/** A part of a body: the balls around the points of a segment, whose radius changes evenly from end to end. */
struct Limb
{
  Vector3 begin;
  Vector3 end;
  double radiusAtBegin;
  double radiusAtEnd;
};

constexpr double FourthFinger = 0.09; // x of its axis
constexpr Vector3 FifthFinger{ 0.25, 0.0, 1.0 };
constexpr Vector3 FifthFingertip{ 0.35, 0.0, 1.5 };

/** How far a point is outside a limb, and the gradient of that. */
double
DistanceTo(const Limb & limb, const Vector3 & point, Vector3 & gradient)
{
  const Vector3 axis = Subtract(limb.end, limb.begin);
  const double growth = limb.radiusAtEnd - limb.radiusAtBegin;
  const double share = Dot(Subtract(point, limb.begin), axis) / Dot(axis, axis);
  const double t = std::clamp(share, 0.0, 1.0);
  Vector3 d;
  for (unsigned int i = 0; i < 3; ++i)
  {
    d[i] = point[i] - limb.begin[i] - t * axis[i];
  }
  const double length = Length(d);
  for (unsigned int i = 0; i < 3; ++i)
  {
    gradient[i] = (length > 0.0 ? d[i] / length : 0.0) - (t == share ? growth * axis[i] / Dot(axis, axis) : 0.0);
  }
  return length - (limb.radiusAtBegin + t * growth);
}

/** A closed body of limbs that flow into each other: ln(sum exp(-k d)) / k over all limbs, where d is the distance to
 * the nearest point of a limb's segment minus the radius there. Two limbs blend where they are nearer than about 1 / k.
 * \param sharpness k, above 0 */
ReferenceField
MakeBody(std::vector<Limb> limbs, double sharpness)
{
  return ReferenceField([limbs = std::move(limbs), sharpness](const Vector3 & point, Vector3 & gradient) {
    std::vector<double> distances(limbs.size());
    std::vector<Vector3> gradients(limbs.size());
    std::transform(
      limbs.begin(), limbs.end(), gradients.begin(), distances.begin(), [&point](const Limb & limb, Vector3 & g) {
        return DistanceTo(limb, point, g);
      });
    const double nearest = *std::min_element(distances.begin(), distances.end());
    double sum = 0.0;
    gradient = {};
    for (std::size_t n = 0; n < distances.size(); ++n)
    {
      const double weight = std::exp(sharpness * (nearest - distances[n]));
      sum += weight;
      gradient = Along(gradient, gradients[n], -weight);
    }
    for (double & component : gradient)
    {
      component /= sum;
    }
    return std::log(sum) / sharpness - nearest;
  });
}

} // namespace

ReferenceField
MakeHand()
{
  return MakeBody({ { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.40 }, 0.19, 0.20 },       // wrist
                    { { -0.08, 0.0, 0.42 }, { -0.27, 0.0, 0.98 }, 0.16, 0.105 }, // palm
                    { { -0.02, 0.0, 0.42 }, { -0.09, 0.0, 1.00 }, 0.16, 0.105 },
                    { { 0.04, 0.0, 0.42 }, { FourthFinger, 0.0, 0.97 }, 0.16, 0.10 },
                    { { 0.10, 0.0, 0.42 }, { 0.24, 0.0, 0.86 }, 0.16, 0.10 },
                    { { -0.28, 0.0, 0.98 }, { -0.40, 0.03, 1.66 }, 0.09, 0.075 },             // second finger
                    { { -0.09, 0.0, 1.00 }, { -0.12, -0.04, 1.90 }, 0.09, 0.075 },            // third
                    { { FourthFinger, 0.0, 0.97 }, { FourthFinger, 0.0, 1.75 }, 0.08, 0.08 }, // fourth
                    { { 0.24, 0.0, 0.86 }, FifthFinger, 0.09, 0.07 },                         // fifth
                    { FifthFinger, FifthFingertip, 0.07, 0.07 },
                    { { -0.12, -0.05, 0.45 }, { -0.42, -0.18, 0.82 }, 0.14, 0.10 }, // thumb
                    { { -0.42, -0.18, 0.82 }, { -0.55, -0.26, 1.12 }, 0.10, 0.08 } },
                  60.0);
}

std::vector<GapPoint>
PointsInGapOfHand()
{
  constexpr double step = 5e-4;
  const ReferenceField hand = MakeHand();
  std::vector<GapPoint> points;
  for (double z = FifthFinger[2]; z < FifthFingertip[2]; z += 0.004)
  {
    const double share = (z - FifthFinger[2]) / (FifthFingertip[2] - FifthFinger[2]);
    const double right = FifthFinger[0] + share * (FifthFingertip[0] - FifthFinger[0]);
    double width = 0.0;
    double sum = 0.0;
    for (double x = FourthFinger; x < right; x += step)
    {
      const bool isOutside = hand.Evaluate({ x, 0.0, z }) < 0.0;
      width += isOutside ? step : 0.0;
      sum += isOutside ? step * x : 0.0;
    }
    if (width > (points.empty() ? 0.0 : points.back().width))
    {
      points.push_back({ { sum / width, 0.0, z }, width });
    }
  }
  return points;
}

ReferenceField
MakeQuadruped()
{
  return MakeBody({ { { -0.45, 0.0, 0.74 }, { 0.35, 0.0, 0.78 }, 0.31, 0.27 }, // trunk of the body
                    { { 0.35, 0.0, 0.82 }, { 0.68, 0.0, 0.96 }, 0.22, 0.19 },  // head
                    { { 0.80, 0.0, 0.92 }, { 0.98, 0.0, 0.62 }, 0.11, 0.07 },  // trunk
                    { { 0.98, 0.0, 0.62 }, { 1.02, 0.0, 0.30 }, 0.07, 0.05 },
                    { { 0.58, 0.16, 1.02 }, { 0.46, 0.40, 0.90 }, 0.09, 0.08 }, // ears
                    { { 0.58, -0.16, 1.02 }, { 0.46, -0.40, 0.90 }, 0.09, 0.08 },
                    { { 0.32, 0.17, 0.62 }, { 0.34, 0.18, 0.10 }, 0.13, 0.10 }, // legs
                    { { 0.32, -0.17, 0.62 }, { 0.34, -0.18, 0.10 }, 0.13, 0.10 },
                    { { -0.50, 0.17, 0.62 }, { -0.50, 0.18, 0.10 }, 0.14, 0.10 },
                    { { -0.50, -0.17, 0.62 }, { -0.50, -0.18, 0.10 }, 0.14, 0.10 },
                    { { -0.74, 0.0, 0.84 }, { -0.90, 0.0, 0.48 }, 0.05, 0.03 } }, // tail
                  40.0);
}

} // namespace rhombic
