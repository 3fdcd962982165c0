#ifndef itkTriangleSurfaceQuality_h
#define itkTriangleSurfaceQuality_h

#include "itkTriangleSurface.h"

namespace itk
{

/** \class TriangleSurfaceQuality
 * \brief How well shaped the triangles of a surface are; all 0 without triangles. */
struct TriangleSurfaceQuality
{
  double mean = 0.0;          ///< mean of ComputeTriangleQuality() over the triangles
  double minimum = 0.0;       ///< least ComputeTriangleQuality() of the triangles
  double poorFraction = 0.0;  ///< share of the triangles with a quality below Poor
  double smallestAngle = 0.0; ///< in degrees, over all triangles

  static constexpr double Poor = 0.2;
};

/** 4 sqrt(3) area / sum of squared edges: 1 for equilateral triangles, 0 for degenerate ones. */
double
ComputeTriangleQuality(const std::array<double, 3> & a,
                       const std::array<double, 3> & b,
                       const std::array<double, 3> & c);

/** Statistics over all triangles of a surface. */
TriangleSurfaceQuality
ComputeTriangleSurfaceQuality(const TriangleSurface & surface);

} // namespace itk

#endif
