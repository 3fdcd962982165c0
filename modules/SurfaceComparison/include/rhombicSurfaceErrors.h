#ifndef rhombicSurfaceErrors_h
#define rhombicSurfaceErrors_h

#include "rhombicReferenceField.h"

#include "itkTriangleSurface.h"

namespace rhombic
{

/** \class SurfaceErrorSettings
 * \brief Where a surface is judged, and in what unit.
 *
 * Thread safety: a value. */
struct SurfaceErrorSettings
{
  Vector3 lower;     ///< triangles count whose centroid is in the box from here
  Vector3 upper;     ///< to here: keep away from the border, where surfaces end or are closed
  double unit = 1.0; ///< h: distances are given in it
};

/** \class SurfaceErrors
 * \brief How far a surface is from what it should be, and how good its triangles are.
 *
 * Thread safety: a value. */
struct SurfaceErrors
{
  itk::SizeValueType triangles = 0; ///< that were judged
  double area = 0.0;                ///< of these, in units squared

  /** Distance to the true surface in units, weighted by area. */
  double meanDistance = 0.0;
  double rmsDistance = 0.0;
  double distance99 = 0.0; ///< 99 % of the area is nearer
  double maximumDistance = 0.0;

  /** Angles to the true surface's normal in degrees, weighted by area. */
  double facetNormalError = 0.0;  ///< of the triangles, at their centroids
  double vertexNormalError = 0.0; ///< of the points' normals; not a number if there are none

  /** As itk::ComputeTriangleQuality() has it. */
  double meanQuality = 0.0;
  double poorFraction = 0.0; ///< triangles of a quality below itk::TriangleSurfaceQuality::Poor

  double unresolvedFraction = 0.0; ///< of the area: farther than three units from the true surface
};

/** Compares a surface with that of a field. Distances are measured at seven points of each triangle, with the weights
 * that integrate cubic polynomials exactly: corners 1/20, middles of sides 2/15, centroid 9/20 (O. C. Zienkiewicz, "The
 * finite element method"). All 0 when no triangle with an area is judged.
 *
 * Works on several threads (itk::MultiThreaderBase); the result does not depend on their number. Thread safe. */
SurfaceErrors
ComputeSurfaceErrors(const itk::TriangleSurface & surface,
                     const ReferenceField & field,
                     const SurfaceErrorSettings & settings);

} // namespace rhombic

#endif
