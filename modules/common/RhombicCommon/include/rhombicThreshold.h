#ifndef rhombicThreshold_h
#define rhombicThreshold_h

namespace rhombic
{

/** \class Threshold
 * \brief The isovalue of a surface, and which values are inside. */
struct Threshold
{
  double isovalue = 0.0;      ///< in the volume's units
  bool insideIsBelow = false; ///< values below the isovalue are inside; otherwise values at or above it

  /** NaN is outside. */
  bool
  IsInside(double value) const
  {
    return insideIsBelow ? value < isovalue : value >= isovalue;
  }
};

} // namespace rhombic

#endif
