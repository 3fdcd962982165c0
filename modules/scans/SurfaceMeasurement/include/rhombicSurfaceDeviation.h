#ifndef rhombicSurfaceDeviation_h
#define rhombicSurfaceDeviation_h

#include "rhombicScan.h"
#include "rhombicPixelTypes.h"

#include "itkSeparableTaps.h"
#include "itkTriangleSurface.h"

#include <cstddef>

namespace rhombic
{

/** \class SurfaceDeviation
 * \brief Distances from a surface to the isosurface of its scan, in mm. */
struct SurfaceDeviation
{
  std::size_t samples = 0;    ///< points and centres of triangles where the distance was measured
  std::size_t unresolved = 0; ///< samples without an isosurface within two voxels
  bool isComplete = true;     ///< false when only evenly chosen points and triangles of a large surface were measured
  double mean = 0.0;
  double percentile95 = 0.0;
  double maximum = 0.0;
  double bias = 0.0; ///< signed mean; positive when the surface lies outside the isosurface

  /** Whether any sample was resolved; otherwise the statistics are 0. */
  bool
  IsKnown() const
  {
    return samples > unresolved;
  }
};

/** Measures at the surface's points and the centres of its triangles. The distance is that along the gradient of the
 * scan's field to where it has the isovalue: a Newton step, (value - isovalue) / |gradient|, corrected by the value
 * found at its end (secant method), and a search in steps where the correction is large. The field is the scan
 * interpolated by \a kernel, as it is resampled onto the lattice. Points less than half a voxel inside the outermost
 * samples are left out, because walls close the surface there.
 *
 * \param maximumSamples a surface with more points and triangles is measured at every n-th of them
 *
 * The result does not depend on the number of threads. */
SurfaceDeviation
ComputeDeviation(const itk::TriangleSurface & surface,
                 const Scan & scan,
                 itk::SeparableKernel kernel,
                 const Threshold & threshold,
                 std::size_t maximumSamples = 2'000'000);

} // namespace rhombic

#endif
