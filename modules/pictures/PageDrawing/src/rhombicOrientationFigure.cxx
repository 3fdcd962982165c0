#include "rhombicAnnotations.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rhombic
{
namespace
{

/** An ellipsoid of the figure, in shares of its height: x to its left, y to its back, z up from the middle. */
struct BodyPart
{
  Vector3 centre;
  Vector3 radii;
  double lean = 0.0; ///< radians by which the top leans to the middle, for arms and legs
  Colour colour{};
};

/** Parts with one edge around all of them. The first part tells whether the group is before or behind others. */
struct BodyGroup
{
  std::vector<BodyPart> parts;
  double recess = 0.0; ///< added to the depth
};

constexpr Colour Body{ 0.55, 0.60, 0.67 };
constexpr Colour Limb{ 0.66, 0.71, 0.77 };
constexpr Colour Dark{ 0.36, 0.38, 0.42 };
constexpr Colour Face{ 0.97, 0.88, 0.80 };
constexpr Colour Nose{ 0.80, 0.62, 0.52 };

std::vector<BodyGroup>
MakeBody()
{
  std::vector<BodyGroup> groups;
  for (const double side : { -1.0, 1.0 })
  {
    groups.push_back({ { { { side * 0.060, 0.0, -0.190 }, { 0.055, 0.062, 0.190 }, side * 0.04, Limb },
                         { { side * 0.072, 0.006, -0.365 }, { 0.038, 0.045, 0.130 }, side * 0.02, Limb },
                         { { side * 0.078, -0.042, -0.478 }, { 0.036, 0.080, 0.024 }, 0.0, Dark } },
                       0.07 }); // behind the hips
  }
  groups.push_back({ { { { 0.0, 0.0, 0.315 }, { 0.036, 0.040, 0.055 }, 0.0, Body },
                       { { 0.0, 0.0, 0.215 }, { 0.128, 0.075, 0.105 }, 0.0, Body },
                       { { 0.0, 0.0, 0.100 }, { 0.100, 0.068, 0.150 }, 0.0, Body },
                       { { 0.0, 0.0, 0.000 }, { 0.108, 0.075, 0.080 }, 0.0, Body } } });
  for (const double side : { -1.0, 1.0 })
  {
    groups.push_back({ { { { side * 0.165, 0.0, 0.110 }, { 0.037, 0.040, 0.175 }, side * 0.20, Limb },
                         { { side * 0.205, -0.005, -0.075 }, { 0.026, 0.032, 0.046 }, side * 0.20, Face } } });
  }
  groups.push_back({ { { { 0.0, 0.008, 0.413 }, { 0.060, 0.070, 0.084 }, 0.0, Dark },
                       { { 0.0, -0.022, 0.402 }, { 0.055, 0.053, 0.075 }, 0.0, Face },
                       { { 0.0, -0.078, 0.395 }, { 0.012, 0.020, 0.018 }, 0.0, Nose } } });
  return groups;
}

/** The ellipse of a part in the picture: half axes at right angles, x to the right, y down. */
struct Shadow
{
  PicturePosition centre;
  PicturePosition a;
  PicturePosition b;
};

/** The part's three half axes, as the lean turns them about y. */
std::array<Vector3, 3>
HalfAxes(const BodyPart & part)
{
  const double c = std::cos(part.lean);
  const double s = std::sin(part.lean);
  return { { { part.radii[0] * c, 0.0, part.radii[0] * s },
             { 0.0, part.radii[1], 0.0 },
             { -part.radii[2] * s, 0.0, part.radii[2] * c } } };
}

/** The parallel projection of an ellipsoid with half axes h is the ellipse with the matrix M = sum of P h (P h)^T,
 * whose half axes are M's eigenvectors, as long as the roots of its eigenvalues. */
Shadow
ShadowOf(const BodyPart & part, const ViewFrame & frame)
{
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const Vector3 & axis : HalfAxes(part))
  {
    const double x = Dot(axis, frame.right);
    const double y = -Dot(axis, frame.up);
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  const double mean = 0.5 * (xx + yy);
  const double spread = std::hypot(0.5 * (xx - yy), xy);
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const double major = std::sqrt(mean + spread);
  const double minor = std::sqrt(std::max(mean - spread, 0.0));
  return { { Dot(part.centre, frame.right), -Dot(part.centre, frame.up) },
           { major * std::cos(angle), major * std::sin(angle) },
           { -minor * std::sin(angle), minor * std::cos(angle) } };
}

PicturePosition
Longer(const PicturePosition & axis, double scale, double excess)
{
  const double length = std::hypot(axis.x, axis.y);
  const double factor = scale + (length > 0.0 ? excess / length : 0.0);
  return { factor * axis.x, factor * axis.y };
}

} // namespace

void
DrawOrientationFigure(Drawing & drawing, const Rectangle & place, const ViewFrame & frame, const Ink & outline)
{
  std::vector<BodyGroup> groups = MakeBody();
  const auto depth = [&frame](const BodyPart & part) { return Dot(part.centre, frame.look); };
  // Rounded, so that groups beside each other stay in MakeBody's order.
  const auto groupDepth = [&frame](const BodyGroup & group) {
    const Vector3 & centre = group.parts.front().centre;
    return std::round(1000.0 * (Dot({ centre[0], 0.0, centre[2] }, frame.look) + group.recess));
  };
  std::stable_sort(groups.begin(), groups.end(), [&groupDepth](const BodyGroup & a, const BodyGroup & b) {
    return groupDepth(a) > groupDepth(b);
  });
  for (BodyGroup & group : groups)
  {
    std::stable_sort(group.parts.begin(), group.parts.end(), [&depth](const BodyPart & a, const BodyPart & b) {
      return depth(a) > depth(b);
    });
  }
  const double scale = std::min(place.width, place.height);
  const double line = 0.012 * scale;
  const auto draw = [&](const BodyPart & part, double excess, const Ink & ink) {
    const Shadow shadow = ShadowOf(part, frame);
    drawing.Ellipse({ place.left + 0.5 * place.width + scale * shadow.centre.x,
                      place.top + 0.5 * place.height + scale * shadow.centre.y },
                    Longer(shadow.a, scale, excess),
                    Longer(shadow.b, scale, excess),
                    ink);
  };
  const auto drawGroup = [&](const BodyGroup & group, double excess, const Ink & ink) {
    for (const BodyPart & part : group.parts)
    {
      draw(part, excess, ink);
    }
  };
  for (const BodyGroup & group : groups)
  {
    drawGroup(group, 2.0 * line, outline);
  }
  for (const BodyGroup & group : groups)
  {
    drawGroup(group, 0.7 * line, { { 0.22, 0.24, 0.28 }, 1.0 });
    for (const BodyPart & part : group.parts)
    {
      draw(part, 0.0, { part.colour });
    }
  }
}

} // namespace rhombic
