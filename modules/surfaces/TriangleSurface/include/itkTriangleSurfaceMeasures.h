#ifndef itkTriangleSurfaceMeasures_h
#define itkTriangleSurfaceMeasures_h

#include "itkTriangleSurfaceTopology.h"

namespace itk
{

/** Sum of the triangles' areas in mm^2. */
double
ComputeTriangleSurfaceArea(const TriangleSurface & surface);

/** Enclosed volume in mm^3 by the divergence theorem, positive if the triangles face outwards. Meaningful for closed
 * surfaces only. */
double
ComputeTriangleSurfaceVolume(const TriangleSurface & surface);

/** Centroid of the enclosed volume in LPS mm, for closed surfaces; 0 if the volume is 0. */
std::array<double, 3>
ComputeTriangleSurfaceCentroid(const TriangleSurface & surface);

/** How bent a surface is: the sum over its edges of |angle between the normals of the two triangles| x length of the
 * edge, over the area; in radians per mm. It is the mean over the surface of |k1| + |k2|, the principal curvatures, to
 * which it tends as triangles get smaller where these follow them: a cylinder has 1 / r. Of two surfaces of one organ,
 * the one with pits and steps has more. A sphere, where edges lie in all directions, has about 2 / r; edges with other
 * than two triangles and triangles without area count as flat. 0 without area. Time O(n log n); memory 36 bytes per
 * triangle. */
double
ComputeTriangleSurfaceBending(const TriangleSurface & surface);

/** The largest distance between two points in mm; 0 without points. Exact. Memory about 20 bytes per point. */
double
ComputeTriangleSurfaceLongestDiameter(const TriangleSurface & surface);

/** The volume of each component in mm^3, as ComputeTriangleSurfaceVolume(). */
std::vector<double>
ComputeTriangleSurfaceComponentVolumes(const TriangleSurface & surface, const TriangleSurfaceComponents & components);

/** \class TriangleSurfaceQuality
 * \brief How well shaped the triangles of a surface are; all 0 without triangles. */
struct TriangleSurfaceQuality
{
  double mean = 0.0;          ///< mean of ComputeTriangleQuality() over the triangles
  double minimum = 0.0;       ///< least ComputeTriangleQuality() of the triangles
  double poorFraction = 0.0;  ///< share of the triangles with a quality below Poor
  double smallestAngle = 0.0; ///< in degrees, over all triangles

  static constexpr double Poor = 0.2;
};

/** 4 sqrt(3) area / sum of squared edges: 1 for an equilateral triangle, 0 for a degenerate triangle. */
double
ComputeTriangleQuality(const std::array<double, 3> & a,
                       const std::array<double, 3> & b,
                       const std::array<double, 3> & c);

/** Statistics over all triangles of a surface. */
TriangleSurfaceQuality
ComputeTriangleSurfaceQuality(const TriangleSurface & surface);

} // namespace itk

#endif
