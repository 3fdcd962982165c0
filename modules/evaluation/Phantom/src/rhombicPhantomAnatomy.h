#ifndef rhombicPhantomAnatomy_h
#define rhombicPhantomAnatomy_h

#include "rhombicPhantomSolids.h"

#include <vector>

namespace rhombic
{

/** The values of the label image. */
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

/** One solid of the body. Two parts are either apart, or one lies in the other and is among its descendants. */
struct PhantomPart
{
  static constexpr int None = -1;

  PhantomSolid solid;
  PhantomLabel label;
  int parent; ///< index of the part around this part, smaller than that of this part; None in the air
};

/** The solids of all organs. A point belongs to the last part that contains it. */
const std::vector<PhantomPart> &
PhantomParts();

/** The value of an organ, or of the air, in Hounsfield units. */
double
HounsfieldOf(int label);

} // namespace rhombic

#endif
