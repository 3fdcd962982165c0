#ifndef itkTriangleSurfaceDistance_h
#define itkTriangleSurfaceDistance_h

#include "itkTriangleTree.h"

#include <array>
#include <limits>
#include <vector>

namespace itk
{

/** \class TriangleSurfaceDistanceSettings
 * \brief Where the distances of a surface are measured. By default at the points and the centres of all triangles. */
struct TriangleSurfaceDistanceSettings
{
  double longestSide = std::numeric_limits<double>::infinity(); ///< in mm; triangles with longer sides are halved
  /** In mm. A triangle is halved where the distance at its centre differs by more from the mean of its corners. */
  double mostBent = std::numeric_limits<double>::infinity();
  double shortestSide = 0.1; ///< in mm; a triangle without a longer side is not halved because of mostBent
  /** In mm. The distance at a centre is computed from the distances and their gradients at the corners, not measured,
   * where the gradients agree, the distance bends by less and is not the largest. Saves two of three queries where both
   * surfaces are smooth. */
  double mostAssumed = 0.0;
  /** Of a surface with more triangles, so many at regular intervals are measured. */
  SizeValueType mostTriangles = std::numeric_limits<SizeValueType>::max();
};

/** \class TriangleSurfaceDistance
 * \brief Distances in mm from all points of a surface to the nearest points of another one, weighted by area.
 *
 * Triangles are divided into parts. On a part the distance is known at the corners and the centre, and linear between
 * them; distances up to 1e-6 mm, which are rounding, are 0. Percentiles and shares of the area are exact for these
 * linear distances. The mean is that of a quadrature which is exact for quadratic functions: 1/12 of the area for each
 * corner, 3/4 for the centre.
 *
 * All measures are 0 for a surface without triangles, and infinite if the other surface has none.
 *
 * Thread safety: any number of threads may call const functions. */
class TriangleSurfaceDistance
{
public:
  using PositionType = TriangleTree::PositionType;

  /** In mm^2: the area of the measured triangles. */
  double
  GetArea() const
  {
    return m_Area;
  }

  double
  GetMean() const
  {
    return m_Mean;
  }

  /** The largest distance at the corners and centres of parts. */
  double
  GetMaximum() const
  {
    return m_Maximum;
  }

  /** The point of the surface with the largest distance. */
  const PositionType &
  GetFarthestPoint() const
  {
    return m_FarthestPoint;
  }

  /** The distance that \a percent of the area do not exceed, to within a millionth of it, or 1e-6 mm. */
  double
  FindPercentile(double percent) const;

  /** The area of the points that are no farther away than \a distance, in mm^2. */
  double
  FindAreaWithin(double distance) const;

  /** The number of parts into which the triangles are divided. */
  SizeValueType
  GetNumberOfParts() const;

private:
  friend TriangleSurfaceDistance
  ComputeTriangleSurfaceDistance(const TriangleSurface & surface,
                                 const TriangleTree & other,
                                 const TriangleSurfaceDistanceSettings & settings);

  /** A part of a triangle. */
  struct Part
  {
    std::array<float, 3> corners; ///< distances in mm
    float centre;                 ///< distance in mm
    float area;                   ///< in mm^2

    float
    GetSmallest() const;
    float
    GetLargest() const;
    double
    FindAreaWithin(double distance) const;
  };

  class Divider;

  std::vector<std::vector<Part>> m_Parts; ///< in the order of the triangles
  double m_Area = 0.0;
  double m_Mean = 0.0;
  double m_Maximum = 0.0;
  PositionType m_FarthestPoint{};
};

/** Measures the distances from \a surface to \a other. The same for any number of threads. Time O(p log triangles) for
 * p parts; memory 20 bytes for each. Throws ExceptionObject if a triangle refers to a missing point. */
TriangleSurfaceDistance
ComputeTriangleSurfaceDistance(const TriangleSurface & surface,
                               const TriangleTree & other,
                               const TriangleSurfaceDistanceSettings & settings = {});

/** \class TriangleSurfaceTwoDistances
 * \brief Distances from each of two surfaces to the other. */
struct TriangleSurfaceTwoDistances
{
  TriangleSurfaceDistance fromFirst;
  TriangleSurfaceDistance fromSecond;

  double
  GetMaximum() const
  {
    return std::max(fromFirst.GetMaximum(), fromSecond.GetMaximum());
  }
};

/** ComputeTriangleSurfaceDistance() in both directions, where no side of a part is longer than twice the smaller of the
 * surfaces' mean sides. */
TriangleSurfaceTwoDistances
ComputeTriangleSurfaceDistances(const TriangleSurface & first,
                                const TriangleSurface & second,
                                SizeValueType mostTriangles = std::numeric_limits<SizeValueType>::max());

/** Whether a position is inside a closed surface: whether the surface winds around it at least once. Its orientation
 * tells the inside, not the nearest normal. Exact for the position rounded to float32; undefined for open surfaces. */
bool
IsInsideTriangleSurface(const TriangleTree & tree, const TriangleTree::PositionType & position);

/** For each point of \a surface the distance to the closed surface \a other in mm: above 0 outside of it, below 0
 * inside (IsInsideTriangleSurface()). */
BulkVector<float>
ComputeTriangleSurfaceSignedDistances(const TriangleSurface & surface, const TriangleTree & other);

} // namespace itk

#endif
