#ifndef rhombicJoinedSurfaces_h
#define rhombicJoinedSurfaces_h

#include "rhombicSceneSurface.h"

#include <array>
#include <cstdint>
#include <vector>

namespace rhombic
{

/** Several surfaces as one mesh, in which touching surfaces share their wall: equal points are one point, and a
 * triangle of two surfaces that faces opposite ways in them is one triangle. */
struct JoinedSurfaces
{
  itk::TriangleSurface::Pointer surface; ///< as the first surface with the triangle has it; without normals

  /** For each triangle the numbers of the two surfaces that have it, from 1, ascending; 0 for none as the second. */
  std::vector<std::array<std::uint32_t, 2>> sides;
};

/** Triangles keep their order. Triangles that are in the surfaces more than once otherwise, as where surfaces overlap,
 * stay separate. Time O(n log n); memory about 50 bytes a triangle. */
JoinedSurfaces
JoinSurfaces(const std::vector<SceneSurface> & surfaces);

} // namespace rhombic

#endif
