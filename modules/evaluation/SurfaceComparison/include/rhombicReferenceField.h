#ifndef rhombicReferenceField_h
#define rhombicReferenceField_h

#include <array>

namespace rhombic
{

/** A point or vector of three coordinates. */
using Vector3 = std::array<double, 3>;

/** \class ReferenceField
 * \brief A smooth function of space whose values and gradients are known exactly.
 *
 * Its *surface* is where it is 0; inside it is positive, so the gradient points inwards. Coordinates have the unit of
 * the world the field is placed in; the experiments take the spacing h of the Cartesian grid as 1.
 */
class ReferenceField
{
public:
  virtual ~ReferenceField() = default;

  /** The value and the gradient at a point. */
  virtual double
  Evaluate(const Vector3 & point, Vector3 & gradient) const = 0;

  /** The value at a point. */
  double
  Evaluate(const Vector3 & point) const
  {
    Vector3 gradient;
    return this->Evaluate(point, gradient);
  }
};

} // namespace rhombic

#endif
