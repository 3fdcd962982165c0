#ifndef itkTriangleSurfaceTopology_h
#define itkTriangleSurfaceTopology_h

#include "itkTriangleSurface.h"

#include <iosfwd>
#include <limits>

namespace itk
{

/** \class TriangleSurfaceComponents
 * \brief The connected component of each point of a surface. */
struct TriangleSurfaceComponents
{
  /** The component of points that no triangle uses. */
  static constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t count = 0;
  BulkVector<std::uint32_t> ofPoint; ///< 0 to count - 1, numbered by each component's first point, or None
};

/** Triangles that share a point are connected. Time nearly linear; memory 4 bytes per point, 8 while it runs. */
TriangleSurfaceComponents
FindTriangleSurfaceComponents(const TriangleSurface & surface);

/** The first point of each component. */
std::vector<std::uint32_t>
FindTriangleSurfaceFirstPoints(const TriangleSurfaceComponents & components);

/** Removes the components for which \a keep is false, and all points that no triangle uses. */
void
KeepTriangleSurfaceComponents(TriangleSurface & surface,
                              const TriangleSurfaceComponents & components,
                              const std::vector<bool> & keep);

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
  SizeValueType repeatedPositions = 0; ///< used points at the position of an earlier point: a reader may join the two
  SizeValueType degenerateTriangles =
    0; ///< triangles with a repeated point, a repeated position, no area, or a position that is not finite
  SizeValueType duplicateTriangles = 0;    ///< triangles with the three points of an earlier triangle, in any order
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
