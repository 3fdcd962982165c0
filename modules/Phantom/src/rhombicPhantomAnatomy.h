#ifndef rhombicPhantomAnatomy_h
#define rhombicPhantomAnatomy_h

#include "rhombicPhantomSolids.h"

#include <memory>
#include <vector>

namespace rhombic
{

/** What a point of the phantom belongs to; the values of its label image. */
enum PhantomLabel : int
{
  PhantomAir = 0,
  PhantomSkin,
  PhantomFat,
  PhantomMuscle,
  PhantomSkull,
  PhantomTeeth,
  PhantomSpine,
  PhantomRibs,
  PhantomShoulders,
  PhantomPelvis,
  PhantomBrain,
  PhantomEyes,
  PhantomAirway,
  PhantomRightLung,
  PhantomLeftLung,
  PhantomHeart,
  PhantomAorta,
  PhantomLiver,
  PhantomSpleen,
  PhantomStomach,
  PhantomRightKidney,
  PhantomLeftKidney,
  PhantomBowel,
  PhantomMarker
};

/** One solid of the phantom. Two parts either don't overlap, or one lies in the other and is among its descendants. */
struct PhantomPart
{
  static constexpr int None = -1;

  std::shared_ptr<const PhantomSolid> solid;
  PhantomLabel label;
  int parent; ///< its place in PhantomParts(), before this part's; None in the air
};

/** The body's parts, each after the one that holds it. A point belongs to the last part that contains it. Thread-safe.
 */
const std::vector<PhantomPart> &
PhantomParts();

} // namespace rhombic

#endif
