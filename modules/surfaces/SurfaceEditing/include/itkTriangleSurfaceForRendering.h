#ifndef itkTriangleSurfaceForRendering_h
#define itkTriangleSurfaceForRendering_h

#include "itkTriangleSurface.h"

namespace itk
{

/** Smooths a surface's normals for shading where they disagree with its triangles, as those of a scan do where a step
 * is sharper than the sampling. Points and triangles stay; nothing happens without normals.
 *
 * Each point's normal, times the area of the triangles around it, and the area vectors of these triangles are summed
 * with those of its neighbours, 6 times over. The smooth normal is the direction of both sums together.
 * Two angles, averaged over the same points, decide how much of the smooth normal counts: that between a triangle's
 * normal and the mean of its corners' normals, and that between the corners' normals and their sum. Nothing counts
 * where the first is below 4 degrees or 0.6 of the second, as on finely sampled curved surfaces; all counts from 8
 * degrees and 0.9 on; linear between.
 *
 * Time linear; memory about 170 bytes per point and 12 per triangle while it runs. The same bytes for any number of
 * threads. */
void
SmoothTriangleSurfaceNormals(TriangleSurface & surface);

/** Reorders triangles for the vertex cache of graphics cards, then points and normals by first use. Triangles keep
 * their positions and orientation; points of no triangle are removed. Time nearly linear; memory 40 bytes per triangle
 * while it runs. */
void
OptimizeTriangleSurfaceForRendering(TriangleSurface & surface);

/** Fewer triangles for a sheet, between some of its points, about as near to it as a distance in mm by which a picture
 * does not change: by quadrics, without a bound on the largest distance (SimplifyTriangleSurface() has one, and takes
 * fifty times as long). Points on the sheet's border stay, so that sheets that end there still meet. The same triangles
 * in the same order give the same result. Ends at \a least triangles. Time nearly linear. */
TriangleSurface::TrianglesContainer
SimplifySheetForRendering(const TriangleSurface::PointsContainer & points,
                          const TriangleSurface::TrianglesContainer & triangles,
                          double distance,
                          SizeValueType least = 0);

} // namespace itk

#endif
