#ifndef rhombicSurfaceErrors_h
#define rhombicSurfaceErrors_h

#include "rhombicReferenceField.h"

#include "itkTriangleTree.h"

#include <functional>

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

/** Finds the point of the true surface that is nearest to another point. Called by several threads at once. */
using FindNearest = std::function<FieldProjection(const Vector3 &)>;

/** The nearest points of a field's surface. \param unit as in ProjectOntoField() */
FindNearest
NearestOnField(const ReferenceField & field, double unit);

/** The nearest points of a mesh, with the normals of its triangles. \a tree must outlive the result. */
FindNearest
NearestOnMesh(const itk::TriangleTree & tree);

/** Compares a surface with the true one. Distances are measured at seven points of each triangle, with the weights
 * that integrate cubic polynomials exactly: corners 1/20, middles of sides 2/15, centroid 9/20 (O. C. Zienkiewicz, "The
 * finite element method"). All 0 when no triangle with an area is judged.
 *
 * Works on several threads (itk::MultiThreaderBase); the result does not depend on their number. */
SurfaceErrors
ComputeSurfaceErrors(const itk::TriangleSurface & surface,
                     const FindNearest & findNearest,
                     const SurfaceErrorSettings & settings);

/** The distances from the points of \a surface to the nearest points of another surface. The weight of a point is a
 * third of the area of its judged triangles. With the true surface as \a surface, the distances tell how far a mesh is
 * from all parts of the true surface. Sets the area and the distances only. */
SurfaceErrors
ComputePointDistances(const itk::TriangleSurface & surface,
                      const FindNearest & findNearest,
                      const SurfaceErrorSettings & settings);

/** The measure Q of Y. Sahillioglu, "A marching algorithm for isosurface extraction from face-centered cubic lattices"
 * (2017): the mean over the points of \a surface in the box of q(n . m), where n is the point's normal, m the normal of
 * the nearest point of \a truth, and q(x) = 1 - x for x > 0, otherwise 1. The printed definition of q lacks its values:
 * this reading of "1 - if x > 0, if x <= 0" is continuous and between 0 and 1, as all printed figures are. Normals are
 * those of the triangles around a point, weighted by their area. 0 when a surface has no triangle there. */
double
ComputeNormalPenalty(const itk::TriangleSurface & surface,
                     const itk::TriangleSurface & truth,
                     const SurfaceErrorSettings & settings);

} // namespace rhombic

#endif
