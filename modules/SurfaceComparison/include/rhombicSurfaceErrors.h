#ifndef rhombicSurfaceErrors_h
#define rhombicSurfaceErrors_h

#include "rhombicReferenceField.h"

#include "itkTriangleSurface.h"

namespace rhombic
{

/** \class SurfaceErrorSettings
 * \brief The box in which a surface is compared, and the unit of its errors. */
struct SurfaceErrorSettings
{
  Vector3 lower;     ///< lower corner of the box; only triangles whose centroid is in the box are judged
  Vector3 upper;     ///< upper corner; the box must not reach the volume's border, where surfaces end or are closed
  double unit = 1.0; ///< h: the unit of distances
};

/** \class SurfaceErrors
 * \brief Distances and angles between a surface and the true surface, and the quality of its triangles. */
struct SurfaceErrors
{
  itk::SizeValueType triangles = 0; ///< number of judged triangles
  double area = 0.0;                ///< area of the judged triangles, in units squared

  /** Distance to the true surface in units, weighted by area. */
  double meanDistance = 0.0;
  double rmsDistance = 0.0;
  double distance99 = 0.0; ///< 99 % of the area is nearer
  double maximumDistance = 0.0;

  /** Angles to the true surface's normal in degrees, weighted by area. */
  double facetNormalError = 0.0;  ///< mean over the triangles, at their centroids
  double vertexNormalError = 0.0; ///< mean over the points; not a number if the surface has no normals

  double meanQuality = 0.0;        ///< mean of itk::ComputeTriangleQuality()
  double poorFraction = 0.0;       ///< share of triangles with a quality below itk::TriangleSurfaceQuality::Poor
  double unresolvedFraction = 0.0; ///< share of the area that is farther than three units from the true surface
};

/** Compares a surface with that of a field. Distances are measured at seven points of each triangle, with the weights
 * that integrate cubic polynomials exactly: corners 1/20, middles of sides 2/15, centroid 9/20 (O. C. Zienkiewicz, "The
 * finite element method"). All 0 when no triangle with an area is judged.
 *
 * Works on several threads (itk::MultiThreaderBase); the result does not depend on their number. */
SurfaceErrors
ComputeSurfaceErrors(const itk::TriangleSurface & surface,
                     const ReferenceField & field,
                     const SurfaceErrorSettings & settings);

} // namespace rhombic

#endif
