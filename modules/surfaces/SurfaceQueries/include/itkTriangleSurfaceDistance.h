#ifndef itkTriangleSurfaceDistance_h
#define itkTriangleSurfaceDistance_h

#include "itkTriangleTree.h"

namespace itk
{

/** \class TriangleSurfaceDistance
 * \brief Distances in mm from sample points of one surface to another surface. */
struct TriangleSurfaceDistance
{
  double mean = 0.0;         ///< weighted by area
  double percentile95 = 0.0; ///< 95 % of the area is no farther away
  double maximum = 0.0;      ///< at the sample points; it may be larger between them
  SizeValueType places = 0;  ///< number of sample points
};

/** Measures distances from the points of \a surface and the centres of its triangles to the nearest point of \a other.
 * Sample points are weighted by area: 1/12 of a triangle's area for each corner and 3/4 for its centre, a quadrature
 * that is exact for quadratic functions. Triangles with a side longer than \a spacing mm are divided into equal parts,
 * at most 64 along a side, until no side is longer, and each part has a centre. If there are more than \a
 * mostTriangles, that many are chosen at regular intervals.
 *
 * All 0 if \a surface has no triangles, infinite if \a other has none. Time O(p log triangles) for p sample points;
 * memory 8 bytes for each. The same for any number of threads. */
TriangleSurfaceDistance
ComputeTriangleSurfaceDistance(const TriangleSurface & surface,
                               const TriangleTree & other,
                               double spacing = std::numeric_limits<double>::infinity(),
                               SizeValueType mostTriangles = std::numeric_limits<SizeValueType>::max());

/** \class TriangleSurfaceTwoDistances
 * \brief Distances from each of two surfaces to the other. */
struct TriangleSurfaceTwoDistances
{
  TriangleSurfaceDistance fromFirst;
  TriangleSurfaceDistance fromSecond;

  double
  GetMaximum() const
  {
    return std::max(fromFirst.maximum, fromSecond.maximum);
  }
};

/** ComputeTriangleSurfaceDistance() in both directions, with a spacing of twice the smaller of the surfaces' mean
 * sides. */
TriangleSurfaceTwoDistances
ComputeTriangleSurfaceDistances(const TriangleSurface & first,
                                const TriangleSurface & second,
                                SizeValueType mostTriangles = std::numeric_limits<SizeValueType>::max());

} // namespace itk

#endif
