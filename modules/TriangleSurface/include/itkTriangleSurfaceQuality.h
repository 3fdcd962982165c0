#ifndef itkTriangleSurfaceQuality_h
#define itkTriangleSurfaceQuality_h

#include "itkTriangleSurface.h"

namespace itk
{

/** \class TriangleSurfaceQuality
 * \brief How well shaped the triangles of a surface are; all 0 without triangles.
 *
 * Thread safety: a value. */
struct TriangleSurfaceQuality
{
  double mean = 0.0;          ///< of ComputeTriangleQuality()
  double minimum = 0.0;       ///< of the same
  double poorFraction = 0.0;  ///< triangles of a quality below Poor
  double smallestAngle = 0.0; ///< of all triangles, in degrees

  static constexpr double Poor = 0.2;
};

/** 4 sqrt(3) area / sum of squared edges: 1 for equilateral triangles, 0 for degenerate ones. Thread safe. */
double
ComputeTriangleQuality(const std::array<double, 3> & a,
                       const std::array<double, 3> & b,
                       const std::array<double, 3> & c);

/** Thread safe. */
TriangleSurfaceQuality
ComputeQuality(const TriangleSurface & surface);

} // namespace itk

#endif
