#ifndef rhombicReferenceField_h
#define rhombicReferenceField_h

#include "rhombicVector3.h"

#include <functional>

namespace rhombic
{

/** \class ReferenceField
 * \brief A smooth function of space whose values and gradients are known exactly.
 *
 * Its *surface* is where it is 0; inside it is positive, so the gradient points inwards. Coordinates have the unit of
 * the world the field is placed in; the experiments take the spacing h of the Cartesian grid as 1.
 */
class ReferenceField
{
public:
  /** Returns the value at a point and sets the gradient there. Called by several threads at once. */
  using Function = std::function<double(const Vector3 & point, Vector3 & gradient)>;

  /** \param function an empty one makes a field that is to be assigned before its first use */
  explicit ReferenceField(Function function = {})
    : m_Function(std::move(function))
  {}

  /** The value and the gradient at a point. */
  double
  Evaluate(const Vector3 & point, Vector3 & gradient) const
  {
    return m_Function(point, gradient);
  }

  /** The value at a point. */
  double
  Evaluate(const Vector3 & point) const
  {
    Vector3 gradient;
    return m_Function(point, gradient);
  }

private:
  Function m_Function;
};

/** \class FieldProjection
 * \brief The point of a field's surface that is nearest to another point. */
struct FieldProjection
{
  Vector3 point{};
  Vector3 normal{};        ///< unit normal of the surface there, pointing outside
  double distance = 0.0;   ///< between the two points, not negative
  bool isResolved = false; ///< false when there is no surface within three units; distance is then 3 units
};

/** Projects a point near a field's surface onto it.
 *
 * The first step is Newton's, along the gradient. Each later guess is the foot of the perpendicular from the point onto
 * the tangent plane at the guess before, so that the search converges where the gradient's line runs through the point.
 * If it does not converge, or ends farther away than 0.4 units, the surface is also searched for along 26 directions
 * around the point, and the nearest result is returned.
 * \param unit a length that is small compared with the field's detail: no step is longer than a quarter of it, and the
 * search has converged when a step is shorter than 1e-4 of it */
FieldProjection
ProjectOntoField(const ReferenceField & field, const Vector3 & point, double unit = 1.0);

} // namespace rhombic

#endif
