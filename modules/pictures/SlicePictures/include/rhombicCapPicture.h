#ifndef rhombicCapPicture_h
#define rhombicCapPicture_h

#include "rhombicOutline.h"
#include "rhombicPicture.h"
#include "rhombicSceneSurface.h"

#include <vector>

namespace rhombic
{

/** \class CapSurface
 * \brief A surface that a plane cuts open. */
struct CapSurface
{
  std::vector<Outline> outlines; ///< from CutSurface(); open ones have no inside
  Colour colour{ 1.0, 1.0, 1.0 };
  double tint = 0.0; ///< share of the colour in the cut's pixels, from 0 to 1; the rest is the slice's
};

/** The cut faces of surfaces: the pixels of a slice where it lies inside any of the surfaces; transparent elsewhere.
 * Alpha is the share of the pixel's area that is inside, so that edges are smooth, and the walls that two surfaces have
 * in common leave no gap. Where surfaces overlap, the tint of the later one is seen.
 * \param slice from DrawSlice() with the plane of the outlines; alpha is ignored */
Picture
DrawCap(const Picture & slice, const std::vector<CapSurface> & surfaces);

} // namespace rhombic

#endif
