#ifndef rhombicSurfaceDeviation_h
#define rhombicSurfaceDeviation_h

#include "rhombicLatticePipeline.h"
#include "rhombicScan.h"
#include "rhombicScanReport.h"
#include "rhombicSurfaceRequest.h"

#include "itkTriangleSurface.h"

#include <cstddef>

namespace rhombic
{

/** \class SurfaceDeviation
 * \brief How far a surface is from the scan's own isosurface, in mm.
 *
 * Thread safety: a value. */
struct SurfaceDeviation
{
  std::size_t samples = 0;    ///< points and centres of triangles where it was measured
  std::size_t unresolved = 0; ///< of these, where there is no isosurface within two samples of the scan
  bool isComplete = true;     ///< false: only so many, evenly chosen, of a large surface
  double mean = 0.0;
  double percentile95 = 0.0;
  double maximum = 0.0;
  double bias = 0.0; ///< the mean with a sign: above 0 when the surface lies outside the isosurface

  /** Whether there is any place from which the isosurface was found; without one, the statistics are 0. */
  bool
  IsKnown() const
  {
    return samples > unresolved;
  }
};

/** Measures at the surface's points and the centres of its triangles. There, the distance is that along the gradient of
 * the scan's field to where it has the isovalue: a Newton step, (value - isovalue) / |gradient|, corrected by the value
 * found at its end (secant), and a search in steps where that does not settle. The field is what the lattice was
 * sampled from, by the same kernel. Points less than half a sample inside the scan's border are left out, as surfaces
 * are closed there by walls; so are unresolved ones from all statistics.
 *
 * \param isovalue in the scan's units
 * \param maximumSamples measured at most; a surface with more is measured at every n-th of them
 *
 * Threads through itk::MultiThreaderBase; the result does not depend on their number. Thread safe. */
SurfaceDeviation
ComputeDeviation(const itk::TriangleSurface & surface,
                 const Scan & scan,
                 itk::SeparableKernel kernel,
                 double isovalue,
                 SurfaceRequest::Side side,
                 std::size_t maximumSamples = 2'000'000);

/** With units in the keys. */
Report
ReportDeviation(const SurfaceDeviation & deviation);

} // namespace rhombic

#endif
