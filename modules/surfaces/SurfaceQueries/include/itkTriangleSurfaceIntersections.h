#ifndef itkTriangleSurfaceIntersections_h
#define itkTriangleSurfaceIntersections_h

#include "itkTriangleTree.h"
#include "rhombicForEachBlock.h"

namespace itk
{

/** How two triangles of a surface meet, apart from the corners and sides they share. */
enum class TriangleContact : std::uint8_t
{
  Apart,    ///< they have no other point in common
  Touching, ///< they have another point in common, but their insides do not meet
  Crossing  ///< they pass through each other, or lie in one plane and overlap
};

/** Finds how two triangles meet. Exact: no tolerance, and no rounding decides.
 *
 * Corners are shared if their indices are equal; equal positions with different indices touch. Triangles that share all
 * corners are duplicates and cross. A triangle without area is apart from every other. Positions must be finite. */
TriangleContact
FindContact(const TriangleSurface::PointsContainer & points,
            TriangleSurface::TriangleType first,
            TriangleSurface::TriangleType second);

class TriangleGrid;
class TrianglesOfPoints;

/** \class TriangleSurfaceIntersections
 * \brief Pairs of triangles of a surface that meet elsewhere than at corners and sides they share. */
struct TriangleSurfaceIntersections
{
  SizeValueType crossingPairs = 0;   ///< pairs of triangles that pass through each other or overlap in one plane
  SizeValueType touchingPairs = 0;   ///< pairs that meet only at their sides or corners
  SizeValueType testedTriangles = 0; ///< triangles that were tested against all others
  bool isSampled = false;            ///< not all triangles were tested, so pairs may have been missed
};

/** Counts the pairs of triangles that meet. Exact: no tolerance, and no rounding decides. Duplicate triangles are not
 * counted here but in TriangleSurfaceTopology. Triangles without area or with a position that is not finite count as
 * tested and meet nothing.
 *
 * If there are more than \a maximumTestedTriangles, about that many are tested against all others, chosen at regular
 * intervals in the tree's order. Time nearly linear, on several threads with the same result for any number of them. */
TriangleSurfaceIntersections
FindTriangleSurfaceSelfIntersections(const TriangleTree & tree,
                                     SizeValueType maximumTestedTriangles = std::numeric_limits<SizeValueType>::max());

/** The ids of the triangles that cross others or are duplicates, ascending. Tests all triangles of the tree.
 * \param fans the triangles at the points of the tree's surface
 * \param least Touching to find triangles that only touch others, too
 * \param progress if not null, its next stage is the search
 * \param stageEnd share of the whole that is done after the stage */
BulkVector<std::uint32_t>
FindCrossingTriangles(const TriangleTree & tree,
                      const TrianglesOfPoints & fans,
                      TriangleContact least = TriangleContact::Crossing,
                      rhombic::StagedProgress * progress = nullptr,
                      double stageEnd = 1.0);

/** For each point of a surface, 1 if it is certain that no two triangles at it meet elsewhere than at corners and sides
 * they share, else 0. */
BulkVector<std::uint8_t>
FindUnfoldedPoints(const TriangleSurface & surface, const TrianglesOfPoints & fans);

/** The triangles of a grid that cross others or are duplicates, ascending: half the time of the same with a tree. */
BulkVector<std::uint32_t>
FindCrossingTriangles(const TriangleGrid & grid, rhombic::StagedProgress & progress, double stageEnd);

/** The triangles of \a candidates that cross any others, and these others. */
BulkVector<std::uint32_t>
FindCrossingTriangles(const TriangleTree & tree,
                      const TrianglesOfPoints & fans,
                      const BulkVector<std::uint32_t> & candidates,
                      TriangleContact least = TriangleContact::Crossing);

/** For a surface whose points lie on the edges of an FCC lattice's tetrahedra, as mode Tetrahedra and Fine of
 * FCCIsosurfaceFilter make them: edges, in mm, at which rounding may make its triangles cross, are no longer than this.
 * The module's README derives it.
 * \param smallestSpacing of the lattice's axes, in mm */
double
FindLongestRoundedEdge(const TriangleSurface & surface, double smallestSpacing, double largestSpacing);

/** \class CrossingCandidates
 * \brief Which triangles of a surface may cross others: triangles that have a point in common with the other triangle,
 * triangles at the two ends of a short edge, and the triangles of a list. */
struct CrossingCandidates
{
  double longestEdge = 0.0;               ///< in mm, see FindLongestRoundedEdge()
  std::vector<std::uint32_t> triangles{}; ///< ids
};

/** The ids of the triangles that cross others or are duplicates, ascending, where the candidates are all that can.
 * Exact; far quicker than to test all triangles, if the list is short. */
BulkVector<std::uint32_t>
FindCrossingTriangles(const TriangleSurface & surface,
                      const TrianglesOfPoints & fans,
                      const CrossingCandidates & candidates);

} // namespace itk

#endif
