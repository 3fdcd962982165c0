#ifndef itkTriangleSurfaceThickness_h
#define itkTriangleSurfaceThickness_h

#include "itkTriangleTree.h"

#include <array>
#include <vector>

namespace itk
{

/** \class TriangleSurfaceThickness
 * \brief How thick the body is at each point of its closed surface, in mm; NaN where the ray inwards leaves nowhere.
 *
 * A body with a thin wall has a ball as small as the wall at all its points, and one with a sharp edge has small balls
 * at the edge, too; the wall is thick there. So a thin wall is where both are small. */
struct TriangleSurfaceThickness
{
  BulkVector<float> balls; ///< diameters of the largest inscribed balls that touch the points
  BulkVector<float> walls; ///< lengths of the rays inwards along the normals, to where they leave the body
};

/** Measures thickness at the points of a closed surface.
 *
 * The ball's centre lies on the ray from the point along its inward normal, and its radius is the exact distance to the
 * surface. Of all centres the one with the largest radius is found to within 1 % or 0.005 mm of the radius, as
 * distances change by no more than the way: see Shubert, "A Sequential Method Seeking the Global Maximum of a
 * Function", 1972. The ball counts as touching the point where the centre is farther from the point than the radius by
 * at most the mean side of the triangles and a twentieth of the way: without that, the facets of a curved surface and
 * the steps of voxels, which come nearer than the point, would leave small balls only.
 *
 * On a slab, a tube's wall and a shell of balls both numbers are the thickness, on a ball its diameter. Normals are
 * those of ComputeTriangleSurfacePointNormals().
 *
 * The same for any number of threads. Time O(n log n), about 30 us a point. Throws ExceptionObject if a triangle refers
 * to a missing point. */
TriangleSurfaceThickness
ComputeTriangleSurfaceThickness(const TriangleSurface & surface, const TriangleTree & tree);

/** The walls alone, which take less time. */
BulkVector<float>
ComputeTriangleSurfaceWalls(const TriangleSurface & surface, const TriangleTree & tree);

/** The unit normals of points, outwards: the means of their triangles' by area; {0, 0, 0} for a point without area. The
 * normals that a surface has may be gradients of a scan, which do not point out of parts as thin as its voxels. */
BulkVector<std::array<double, 3>>
ComputeTriangleSurfacePointNormals(const TriangleSurface & surface);

/** A connected part of a surface that is thinner than a limit. */
struct ThinPart
{
  double area = 0.0;                       ///< mm^2
  double thinnest = 0.0;                   ///< mm
  TriangleTree::PositionType thinnestAt{}; ///< in LPS mm, on the surface
};

/** \class ThinParts
 * \brief The parts of a surface whose walls are thinner than a limit. */
struct ThinParts
{
  double limit = 0.0;          ///< mm
  double area = 0.0;           ///< mm^2, of all parts
  double areaOfSurface = 0.0;  ///< mm^2
  std::vector<ThinPart> parts; ///< the largest first
};

/** Finds where a closed surface's balls and walls are both smaller than \a limit mm. A triangle counts by the share of
 * its corners that are thin; parts are connected by their thin points. Throws ExceptionObject as
 * ComputeTriangleSurfaceThickness() does. */
ThinParts
FindThinParts(const TriangleSurface & surface, const TriangleTree & tree, double limit);

} // namespace itk

#endif
