#ifndef itkTriangleSurfaceDistance_h
#define itkTriangleSurfaceDistance_h

#include "itkTriangleTree.h"

namespace itk
{

/** \class TriangleSurfaceDistance
 * \brief How far places of one surface are from another surface, in mm.
 *
 * Thread safety: a value. */
struct TriangleSurfaceDistance
{
  double mean = 0.0;         ///< over the area
  double percentile95 = 0.0; ///< 95 % of the area is not further
  double maximum = 0.0;      ///< at the places looked at; between them it may be more
  SizeValueType places = 0;  ///< how many were looked at
};

/** Distances from the points of a surface, and from places inside its triangles, to the nearest point of another
 * surface. Each place counts with the area around it: a triangle's points and centre with weights 1/12 and 3/4, which
 * is exact for quadratic functions. Triangles with sides above \a spacing mm count as so many equal parts that none of
 * their sides is longer (at most 64 along a side). Of more than \a mostTriangles, evenly chosen ones are looked at.
 *
 * All 0 without triangles, infinite to a surface without triangles. Time O(places log triangles); 8 bytes a place.
 * Thread safe; the same for any number of threads. */
TriangleSurfaceDistance
ComputeDistance(const TriangleSurface & surface,
                const TriangleTree & other,
                double spacing = std::numeric_limits<double>::infinity(),
                SizeValueType mostTriangles = std::numeric_limits<SizeValueType>::max());

/** \class TriangleSurfaceTwoDistances
 * \brief Distances from each of two surfaces to the other.
 *
 * Thread safety: a value. */
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

/** Both ways, the places as dense on the surface with the larger triangles as on the other one. Thread safe. */
TriangleSurfaceTwoDistances
ComputeTwoDistances(const TriangleSurface & first,
                    const TriangleSurface & second,
                    SizeValueType mostTriangles = std::numeric_limits<SizeValueType>::max());

} // namespace itk

#endif
