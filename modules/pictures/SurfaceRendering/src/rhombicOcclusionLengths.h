#ifndef rhombicOcclusionLengths_h
#define rhombicOcclusionLengths_h

#include "rhombicScene.h"

namespace rhombic
{

/** \class OcclusionLengths
 * \brief Lengths in mm that decide which cavities of a scene are darkened. They belong to the body, so a cavity is as
 * dark when it is enlarged. */
struct OcclusionLengths
{
  float reach = 0.0f;  ///< largest distance of what takes light away
  float detail = 0.0f; ///< pits up to this depth stay bright, as those between the steps of coarsely sampled surfaces
};

/** The reach is 0.06 of the mean side of the box around the surfaces; the detail is 0.6 of the mean length of the
 * triangles' edges, at most a quarter of the reach. 0 without surfaces. */
OcclusionLengths
FindOcclusionLengths(const Scene & scene);

} // namespace rhombic

#endif
