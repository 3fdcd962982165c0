#ifndef itkTriangleSurfaceSmoothing_h
#define itkTriangleSurfaceSmoothing_h

#include "itkTriangleSurface.h"
#include "rhombicForEachBlock.h"

#include <array>
#include <optional>

namespace itk
{

/** \class TriangleSurfaceSmoothingSettings
 * \brief How much a surface is smoothed, and how far its points may move. */
struct TriangleSurfaceSmoothingSettings
{
  unsigned int iterations = 20; ///< pairs of one step inwards and one step outwards
  double maximumMove = 0.0;     ///< largest distance of a point from its start in mm, finite and not negative

  /** The half axes in mm of an ellipsoid around its start that a point may not leave either, such as the edges of a
   * voxel: three directions in space. Default: no such ellipsoid. */
  std::optional<std::array<std::array<double, 3>, 3>> halfAxes = std::nullopt;

  /** Throws ExceptionObject if maximumMove is negative or not finite, or halfAxes are in one plane or not finite. */
  void
  Verify() const;
};

/** \class TriangleSurfaceSmoothingReport
 * \brief The result of smoothing in numbers. */
struct TriangleSurfaceSmoothingReport
{
  double meanMove = 0.0;            ///< mm, over all points
  double largestMove = 0.0;         ///< mm, never above maximumMove
  SizeValueType pointsAtLimit = 0;  ///< points that maximumMove or halfAxes have stopped
  SizeValueType pointsOnBorder = 0; ///< points that do not move: on open borders, at ends of curves
};

/** Smooths a surface without shrinking it, after Taubin, "A signal processing approach to fair surface design"
 * (SIGGRAPH 1995): steps towards the mean of each point's neighbours alternate with slightly longer steps away from it.
 *
 * Where three or more sheets meet in a curve, its points move towards the mean of their two neighbours on the curve.
 *
 * No point moves farther than maximumMove, or out of the ellipsoid of halfAxes. The points of a triangle that would
 * turn by 80 degrees or more, or lose more than nine tenths of its area, stay where they are. Points on open borders,
 * where curves meet, and where parts touch in one point, stay. Triangles keep their points and order. Normals, if there
 * were any, are computed anew: the triangles' normals weighted by the angle at the point.
 *
 * At the end, the points of triangles that meet others elsewhere than at shared corners and sides are put back to their
 * start, until triangles only meet where they met at the start. So there are no new self-intersections.
 *
 * Time nearly linear; memory about 120 bytes per triangle while it runs. The same bytes for any number of threads.
 * \a report receives the share of the work that is done; its exceptions leave the surface partly smoothed.
 * Throws ExceptionObject as Verify() of the settings does. */
TriangleSurfaceSmoothingReport
SmoothTriangleSurface(TriangleSurface & surface,
                      const TriangleSurfaceSmoothingSettings & settings,
                      const rhombic::ProgressFunction & report = {});

} // namespace itk

#endif
