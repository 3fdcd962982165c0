#ifndef itkTriangleSurfaceTopology_h
#define itkTriangleSurfaceTopology_h

#include "itkTriangleSurface.h"

#include <iosfwd>

namespace itk
{

/** \class TriangleSurfaceTopology
 * \brief Counts over the connectivity of a surface: components, genus and flaws. */
struct TriangleSurfaceTopology
{
  SizeValueType components = 0;        ///< sets of triangles connected through shared points
  SizeValueType boundaryEdges = 0;     ///< edges with one triangle: the surface is open there
  SizeValueType nonManifoldEdges = 0;  ///< edges with three or more triangles
  SizeValueType misorientedEdges = 0;  ///< edges whose two triangles run along them in the same direction
  SizeValueType nonManifoldPoints = 0; ///< points whose triangles are not one fan, in any orientation
  SizeValueType unusedPoints = 0;      ///< points that no triangle uses
  SizeValueType nonFinitePoints = 0;   ///< used points with a coordinate that is infinite or no number
  SizeValueType repeatedPositions = 0; ///< used points at the position of an earlier one: a reader may join the two
  SizeValueType degenerateTriangles =
    0; ///< triangles with a repeated point, a repeated position, no area, or a position that is not finite
  SizeValueType duplicateTriangles = 0;    ///< triangles with the three points of an earlier one, in any order
  OffsetValueType eulerCharacteristic = 0; ///< used points - edges + triangles; 2 for each sphere, 0 for each torus
  SizeValueType genus = 0; ///< handles of all components that are closed, oriented and manifold: 1 for each torus

  /** Closed, oriented, manifold and free of degenerate triangles. */
  bool
  IsWatertight() const
  {
    return boundaryEdges == 0 && nonManifoldEdges == 0 && misorientedEdges == 0 && nonManifoldPoints == 0 &&
           degenerateTriangles == 0;
  }
};

/** Time O(n log n) for sorting the positions, on several threads, with the same result for any number of them. Memory
 * about 40 bytes per triangle. */
TriangleSurfaceTopology
ComputeTriangleSurfaceTopology(const TriangleSurface & surface);

std::ostream &
operator<<(std::ostream & os, const TriangleSurfaceTopology & topology);

} // namespace itk

#endif
