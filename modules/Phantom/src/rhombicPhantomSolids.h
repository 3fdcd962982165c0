#ifndef rhombicPhantomSolids_h
#define rhombicPhantomSolids_h

#include "rhombicPhantom.h"

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace rhombic
{

/** The part of a line that lies in a solid, in millimetres along the line's axis; empty when last < first. */
struct PhantomSpan
{
  double first = 1.0;
  double last = 0.0;
};

/** The smallest box, in millimetres, that is known to hold a solid. */
struct PhantomBounds
{
  PhantomPoint low;
  PhantomPoint high;
};

/** \class PhantomSolid
 * \brief A solid whose volume is known and which every line along one axis crosses in at most one interval.
 *
 * Immutable, so any number of threads may use one object.
 */
class PhantomSolid
{
public:
  virtual ~PhantomSolid() = default;

  /** The axis (0, 1 or 2) of the lines that GetSpan() takes. */
  virtual unsigned
  GetAxis() const = 0;

  /** Where the line through \a point along GetAxis() is in the solid. The point's own coordinate on that axis is not
   * used. */
  virtual PhantomSpan
  GetSpan(const PhantomPoint & point) const = 0;

  virtual PhantomBounds
  GetBounds() const = 0;

  /** In cubic millimetres: a closed form, or Gauss quadrature of smooth functions to rounding error. */
  virtual double
  GetVolume() const = 0;

  bool
  Contains(const PhantomPoint & point) const
  {
    const PhantomSpan span = GetSpan(point);
    const double place = point[GetAxis()];
    return span.first <= place && place <= span.last;
  }
};

/** \class PhantomProfile
 * \brief A smooth curve through knots: piecewise cubic, without overshoot, constant before the first knot and after the
 * last. */
class PhantomProfile
{
public:
  struct Knot
  {
    double place;
    double value;
  };

  /** The places must increase. */
  PhantomProfile(std::vector<Knot> knots);
  PhantomProfile(double constant)
    : PhantomProfile(std::vector<Knot>{ { 0.0, constant } })
  {}

  double
  operator()(double place) const;

  const std::vector<Knot> &
  GetKnots() const
  {
    return m_Knots;
  }

private:
  std::vector<Knot> m_Knots;
  std::vector<double> m_Slopes;
};

/** A round swelling (height > 0) or hollow (height < 0) of a loft's front or back.
 * It moves the surface along y by height * (1 - r^2)^power, where r is 1 on the ellipse with the given centre and
 * half-axes. */
struct PhantomRelief
{
  bool front;
  double x;
  double z;
  double halfWidth;
  double halfHeight;
  double height;
  double power;
};

/** \class PhantomLoft
 * \brief A stack of superelliptic cross-sections along z, with separate depths to the front and to the back, and
 * reliefs on both.
 *
 * At height z the cross-section is |dx / width|^exponent + |dy / depth|^exponent <= 1 about the centre. Towards each
 * end, over the length of its cap, the cross-section closes as an ellipse does; a cap of length 0 is a flat cut. A
 * relief must lie inside the cross-sections' x and z.
 */
class PhantomLoft : public PhantomSolid
{
public:
  struct Shape
  {
    PhantomProfile centreX; ///< as a function of z, like the other profiles
    PhantomProfile centreY;
    double bottom;
    double top;
    double bottomCap;
    double topCap;
    PhantomProfile width; ///< half the width in x
    PhantomProfile front; ///< depth from the centre towards -y
    PhantomProfile back;  ///< depth from the centre towards +y
    PhantomProfile exponent;
    std::vector<PhantomRelief> reliefs;
  };

  explicit PhantomLoft(Shape shape);

  /** The loft that lies inside this one at a depth, in millimetres, that is a function of z. Reliefs keep their
   * heights. */
  PhantomLoft
  Inset(const PhantomProfile & depth) const;

  /** The y of the front surface; only inside the cross-sections' x and z. */
  double
  GetFront(double x, double z) const;

  /** The distance from the centre, along x, of the side surface where no relief reaches; 0 outside the cross-sections.
   */
  double
  GetSide(double y, double z) const;

  unsigned
  GetAxis() const override
  {
    return 1;
  }
  PhantomSpan
  GetSpan(const PhantomPoint & point) const override;
  PhantomBounds
  GetBounds() const override;
  double
  GetVolume() const override;

private:
  double
  GetCap(double z) const;
  double
  GetRelief(bool front, double x, double z) const;

  Shape m_Shape;
};

/** \class PhantomEllipsoid
 * \brief An ellipsoid with its half-axes along three orthonormal directions. */
class PhantomEllipsoid : public PhantomSolid
{
public:
  /** \a turns are rotations in degrees about x, then y, then z. */
  PhantomEllipsoid(const PhantomPoint & centre, const PhantomPoint & halfAxes, const PhantomPoint & turns = {});

  unsigned
  GetAxis() const override
  {
    return 1;
  }
  PhantomSpan
  GetSpan(const PhantomPoint & point) const override;
  PhantomBounds
  GetBounds() const override;
  double
  GetVolume() const override;

private:
  PhantomPoint m_Centre;
  PhantomPoint m_HalfAxes;
  std::array<PhantomPoint, 3> m_Directions;
};

/** \class PhantomCapsule
 * \brief All points within a radius of a segment. */
class PhantomCapsule : public PhantomSolid
{
public:
  PhantomCapsule(const PhantomPoint & first, const PhantomPoint & last, double radius);

  unsigned
  GetAxis() const override
  {
    return 1;
  }
  PhantomSpan
  GetSpan(const PhantomPoint & point) const override;
  PhantomBounds
  GetBounds() const override;
  double
  GetVolume() const override;

private:
  PhantomPoint m_First;
  PhantomPoint m_Last;
  double m_Radius;
};

/** \class PhantomHoop
 * \brief A piece of a bar bent along an ellipse about the z axis, its height a function of the angle: a rib, a jaw, an
 * arch.
 *
 * The bar's cross-section is an ellipse that tapers to nothing at both ends. Because each vertical line is only moved
 * up or down, the volume is that of the flat hoop.
 */
class PhantomHoop : public PhantomSolid
{
public:
  struct Shape
  {
    double centreX;
    double centreY;
    double radiusX;
    double radiusY;
    bool fromBack;     ///< the angle is 0 at the back (+y), otherwise at the front; it grows towards the left (+x)
    double firstAngle; ///< radians, in -pi .. pi
    double lastAngle;
    double halfThickness; ///< at the geometric mean of the two radii
    double halfHeight;
    PhantomProfile height; ///< z of the bar's middle, as a function of the angle
  };

  explicit PhantomHoop(Shape shape);

  unsigned
  GetAxis() const override
  {
    return 2;
  }
  PhantomSpan
  GetSpan(const PhantomPoint & point) const override;
  PhantomBounds
  GetBounds() const override
  {
    return m_Bounds;
  }
  double
  GetVolume() const override;

private:
  PhantomBounds
  ComputeBounds() const;

  Shape m_Shape;
  double m_RelativeThickness;
  PhantomBounds m_Bounds;
};

/** \class PhantomPlate
 * \brief A plate of even thickness in y that lies on a loft's front and is a rectangle when seen from there. */
class PhantomPlate : public PhantomSolid
{
public:
  PhantomPlate(std::shared_ptr<const PhantomLoft> loft,
               std::pair<double, double> rangeX,
               std::pair<double, double> rangeZ,
               double thickness);

  unsigned
  GetAxis() const override
  {
    return 1;
  }
  PhantomSpan
  GetSpan(const PhantomPoint & point) const override;
  PhantomBounds
  GetBounds() const override;
  double
  GetVolume() const override;

private:
  std::shared_ptr<const PhantomLoft> m_Loft;
  std::pair<double, double> m_RangeX;
  std::pair<double, double> m_RangeZ;
  double m_Thickness;
};

/** \class PhantomFlap
 * \brief A round swelling on a loft's side, grown along x from the loft's surface: an ear.
 * The loft's centre is at x = 0.
 *
 * Seen from the side it is an ellipse; its height is height * (1 - r^2)^power, as for a relief. */
class PhantomFlap : public PhantomSolid
{
public:
  struct Shape
  {
    bool left;
    double y;
    double z;
    double halfDepth;
    double halfHeight;
    double height;
    double power;
  };

  PhantomFlap(std::shared_ptr<const PhantomLoft> loft, const Shape & shape);

  unsigned
  GetAxis() const override
  {
    return 0;
  }
  PhantomSpan
  GetSpan(const PhantomPoint & point) const override;
  PhantomBounds
  GetBounds() const override;
  double
  GetVolume() const override;

private:
  std::shared_ptr<const PhantomLoft> m_Loft;
  Shape m_Shape;
};

} // namespace rhombic

#endif
