#ifndef itkTriangleSurfaceSmoothing_h
#define itkTriangleSurfaceSmoothing_h

#include "itkTriangleSurface.h"

namespace itk
{

/** \class TriangleSurfaceSmoothingSettings
 * \brief How much a surface is smoothed, and how far its points may go.
 *
 * Thread safety: a value. */
struct TriangleSurfaceSmoothingSettings
{
  unsigned int iterations = 20; ///< pairs of one step inwards and one step outwards
  double maximumMove =
    0.0; ///< mm from where a point was, finite and not negative; a set fraction of the lattice spacing
};

/** \class TriangleSurfaceSmoothingReport
 * \brief What smoothing did.
 *
 * Thread safety: a value. */
struct TriangleSurfaceSmoothingReport
{
  double meanMove = 0.0;            ///< mm, over all points
  double largestMove = 0.0;         ///< mm, never above maximumMove
  SizeValueType pointsAtLimit = 0;  ///< points that maximumMove holds back
  SizeValueType pointsOnBorder = 0; ///< points that never move: on an open border, or where the surface is not manifold
};

/** Smooths a surface without shrinking it, after Taubin, "A signal processing approach to fair surface design"
 * (SIGGRAPH 1995): steps towards the mean of a point's neighbours alternate with slightly longer steps away.
 *
 * A point is never further than maximumMove from where it was. No triangle turns by 80 degrees or more or loses more
 * than nine tenths of its area: its points stay where they are instead. Points on open borders stay. Triangles keep
 * their points and order; normals, if there were any, are computed anew: the triangles' normals weighted by the angle
 * at the point. Sheets closer to each other than twice maximumMove may touch.
 *
 * Linear in time and memory: about 40 bytes a triangle while it runs. The same bytes for any number of threads.
 * Throws ExceptionObject when maximumMove is negative or not finite. Thread safe for different surfaces. */
TriangleSurfaceSmoothingReport
SmoothSurface(TriangleSurface & surface, const TriangleSurfaceSmoothingSettings & settings);

} // namespace itk

#endif
