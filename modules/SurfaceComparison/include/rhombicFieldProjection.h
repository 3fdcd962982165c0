#ifndef rhombicFieldProjection_h
#define rhombicFieldProjection_h

#include "rhombicReferenceField.h"

namespace rhombic
{

/** \class FieldProjection
 * \brief The point of a field's surface that is nearest to another point. */
struct FieldProjection
{
  Vector3 point;
  Vector3 normal;          ///< of the surface there, of length 1, pointing outside
  double distance = 0.0;   ///< between the two points, not negative
  bool isResolved = false; ///< false when the search did not settle; distance is then |field| / |gradient|, a guess
};

/** Projects a point near a field's surface onto it. The search starts with a Newton step along the gradient and goes on
 * with the foot of the perpendicular from the point onto the tangent plane of the surface found so far, so it settles
 * where the gradient runs through the point.
 * \param unit a length that is small for the field: no step is longer than a quarter of it, and the search has settled
 * when a step is shorter than 1e-4 of it */
FieldProjection
ProjectOntoField(const ReferenceField & field, const Vector3 & point, double unit = 1.0);

} // namespace rhombic

#endif
