#ifndef itkTriangleSurfaceIntersections_h
#define itkTriangleSurfaceIntersections_h

#include "itkTriangleTree.h"

namespace itk
{

/** \class TriangleSurfaceIntersections
 * \brief Where a surface meets itself other than along the edges and points its triangles share.
 *
 * Thread safety: a value. */
struct TriangleSurfaceIntersections
{
  SizeValueType crossingPairs = 0;   ///< pairs of triangles that pass through each other or overlap in one plane
  SizeValueType touchingPairs = 0;   ///< pairs that meet, but without their insides meeting
  SizeValueType testedTriangles = 0; ///< triangles that were tested against all others
  bool isSampled = false;            ///< not all triangles were tested: pairs may have been missed
};

/** Counts the pairs of triangles that meet as FindContact() says, but for duplicates, which TriangleSurfaceTopology
 * counts. Exact. Triangles without area or with a position that is not finite are taken as tested and meet nothing.
 *
 * Of more than \a maximumTestedTriangles triangles, about that many are tested against all, evenly along the tree's
 * order. Nearly linear in time, on several threads with the same result for any number; no memory but the tree's.
 * Thread safe. */
TriangleSurfaceIntersections
FindSelfIntersections(const TriangleTree & tree,
                      SizeValueType maximumTestedTriangles = std::numeric_limits<SizeValueType>::max());

/** The triangles that pass through others or are duplicates, ascending. As FindSelfIntersections() with all triangles
 * tested. Thread safe. */
std::vector<std::uint32_t>
FindCrossingTriangles(const TriangleTree & tree);

} // namespace itk

#endif
