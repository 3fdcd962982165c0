#ifndef rhombicPhantomSolids_h
#define rhombicPhantomSolids_h

#include "rhombicPhantom.h"

#include <functional>
#include <utility>
#include <vector>

namespace rhombic
{

/** The part of a line inside a solid, in mm along the solid's axis. Empty when last < first. */
struct PhantomSpan
{
  double first = 1.0;
  double last = 0.0;
};

/** A box, in mm. */
struct PhantomBounds
{
  PhantomPoint low;
  PhantomPoint high;
};

/** A solid of known volume that each line along its axis crosses in at most one span. */
struct PhantomSolid
{
  unsigned axis;                                           ///< 1 (y) or 2 (z)
  PhantomBounds bounds;                                    ///< hold the solid, not always tightly
  double volume;                                           ///< in mm^3, exact up to rounding
  std::function<PhantomSpan(const PhantomPoint &)> spanAt; ///< on the line through a point, along the axis

  bool
  Contains(const PhantomPoint & point) const
  {
    const PhantomSpan span = spanAt(point);
    return span.first <= point[axis] && point[axis] <= span.last;
  }
};

/** A smooth curve through knots: piecewise cubic without overshoot, constant before the first and after the last knot.
 */
class PhantomProfile
{
public:
  struct Knot
  {
    double position;
    double value;
  };

  /** The positions must increase. */
  PhantomProfile(std::vector<Knot> knots);
  PhantomProfile(std::initializer_list<Knot> knots)
    : PhantomProfile(std::vector<Knot>(knots))
  {}
  PhantomProfile(double constant)
    : PhantomProfile(std::vector<Knot>{ { 0.0, constant } })
  {}

  double
  operator()(double position) const;

  const std::vector<Knot> &
  GetKnots() const
  {
    return m_Knots;
  }

private:
  std::vector<Knot> m_Knots;
  std::vector<double> m_Slopes;
};

/** A round swelling (height > 0) or hollow (height < 0) of a loft's front. It moves the front along -y by
 * height * (1 - r^2)^power, where r is 1 on the ellipse with this centre and these half-axes. */
struct PhantomRelief
{
  double x;
  double z;
  double halfWidth;
  double halfHeight;
  double height;
  double power;
};

/** A stack of cross-sections along z.
 *
 * The cross-section at height z is |dx / width|^exponent + |dy / depth|^exponent <= 1 about the centre, with one depth
 * to the front and one to the back. Towards each end, over the length of its cap, it closes as an ellipse does; a cap
 * of length 0 is a flat cut. A relief must lie inside the cross-sections' x and z. */
struct PhantomLoft
{
  double bottom = 0.0;
  double top = 0.0;
  double bottomCap = 0.0;
  double topCap = 0.0;
  PhantomProfile width = 0.0; ///< half the width in x, as a function of z, like the other profiles
  PhantomProfile front = 0.0; ///< depth from the centre towards -y
  PhantomProfile back = 0.0;  ///< depth from the centre towards +y
  PhantomProfile centreX = 0.0;
  PhantomProfile centreY = 0.0;
  PhantomProfile exponent = 2.0;
  std::vector<PhantomRelief> reliefs = {};
};

/** The loft that lies at a depth, in mm, below the surface of another loft; the depth is a function of z. Reliefs keep
 * their heights. */
PhantomLoft
InsetOf(const PhantomLoft & loft, const PhantomProfile & depth);

PhantomSolid
MakeLoft(PhantomLoft loft);

/** An ellipsoid, turned by degrees about x, then y, then z. */
PhantomSolid
MakeEllipsoid(const PhantomPoint & centre, const PhantomPoint & halfAxes, const PhantomPoint & turns = {});

/** A piece of a bar bent along an ellipse about the z axis: a rib, a jaw, an arch.
 *
 * Its cross-section is an ellipse that tapers to nothing at both ends. Because vertical lines are only moved up or down
 * by the height, the volume is that of the flat hoop. */
struct PhantomHoop
{
  double centreY;       ///< the centre's x is 0
  double radiusX;       ///< negative: mirrored in x
  double radiusY;       ///< negative: mirrored in y
  double firstAngle;    ///< radians, -pi to pi; 0 is towards +y, positive angles are towards +x
  double lastAngle;     ///< more than the first
  double halfThickness; ///< at the geometric mean of the two radii
  double halfHeight;
  PhantomProfile height; ///< z of the bar's middle, as a function of the angle
};

PhantomSolid
MakeHoop(PhantomHoop hoop);

/** A plate of even thickness in y on a loft's front; from there it is a rectangle. */
PhantomSolid
MakePlate(const PhantomLoft & loft,
          std::pair<double, double> rangeX,
          std::pair<double, double> rangeZ,
          double thickness);

} // namespace rhombic

#endif
