#ifndef itkTriangleSurfaceCurvature_h
#define itkTriangleSurfaceCurvature_h

#include "itkTriangleSurface.h"

#include <vector>

namespace itk
{

/** The mean curvature of a surface at each of its points in 1/mm: above 0 where the surface bulges outwards, 1/r on a
 * ball of radius r, 1/(2 r) on a cylinder; below 0 in hollows. NaN for a point without neighbours.
 *
 * At each point the polynomial of second degree over the tangent plane is fitted by least squares to the points within
 * \a radius that the surface's edges join to it, or the nearest twelve along edges if there are fewer: see Cazals and
 * Pouget, "Estimating Differential Quantities Using Polynomial Fitting of Osculating Jets", 2005. Curvature over
 * smaller distances than the radius is averaged; details of voxels are not curvature of the body.
 *
 * \param radius in mm
 *
 * The same for any number of threads. Time O(n m) for m points within the radius. Throws ExceptionObject if a triangle
 * refers to a missing point. */
BulkVector<float>
ComputeTriangleSurfaceMeanCurvature(const TriangleSurface & surface, double radius);

} // namespace itk

#endif
