#ifndef rhombicBodyField_h
#define rhombicBodyField_h

#include "rhombicReferenceField.h"

#include <vector>

namespace rhombic
{

/** \class Limb
 * \brief A part of a body: the balls around the points of a segment, whose radius changes evenly from end to end. */
struct Limb
{
  Vector3 begin;
  Vector3 end;
  double radiusAtBegin;
  double radiusAtEnd;
};

/** \class BodyField
 * \brief A closed body of limbs that flow into each other: ln(sum exp(-k d)) / k over all limbs, where d is the
 * distance to the nearest point of a limb's segment minus the radius there. Two limbs blend where they are nearer than
 * about 1 / k. */
class BodyField : public ReferenceField
{
public:
  /** \param sharpness k, above 0 */
  BodyField(std::vector<Limb> limbs, double sharpness);

  using ReferenceField::Evaluate;

  double
  Evaluate(const Vector3 & point, Vector3 & gradient) const override;

private:
  std::vector<Limb> m_Limbs;
  double m_Sharpness;
};

/** An upright hand, 2 units high, with the palm to -y. The gap between the fourth and the fifth finger widens evenly
 * from the palm to 0.1. */
BodyField
MakeHand();

/** A point in the middle of a gap. */
struct GapPoint
{
  Vector3 point;
  double width; ///< of the gap there
};

/** Points along that gap, from its narrow end. */
std::vector<GapPoint>
PointsInGapOfHand();

/** A four-legged animal with ears, trunk and tail, 1.2 units high, that looks to +x. */
BodyField
MakeQuadruped();

} // namespace rhombic

#endif
