#ifndef rhombicSurfaceMeasures_h
#define rhombicSurfaceMeasures_h

#include "rhombicIsosurfaceVolume.h"
#include "rhombicScan.h"
#include "rhombicThreshold.h"

#include "itkTriangleSurface.h"

#include <array>
#include <optional>

namespace rhombic
{

/** \class SurfaceMeasures
 * \brief Size and position of a closed surface in LPS mm, and the scan's values inside it. */
struct SurfaceMeasures
{
  double volume = 0.0;            ///< mm^3
  double area = 0.0;              ///< mm^2
  std::array<double, 6> bounds{}; ///< xmin, xmax, ymin, ymax, zmin, zmax
  std::array<double, 3> centroid{};
  double longestDiameter = 0.0;

  /** Mean and standard deviation of the scan's samples inside the surface, weighted by their voxels' volumes; none
   * without a scan. */
  std::optional<double> meanValue;
  std::optional<double> standardDeviation;

  /** Volume of voxels in mm^3, counted independently of the surface's triangles. */
  std::optional<double> voxelVolume;

  /** Volume inside the scan's isosurface, estimated from the lattice's samples; none for labels. */
  std::optional<IsosurfaceVolume> isosurface;

  /** Difference of the volume from the isosurface's, or without one from the voxels', in %; positive if it is larger.
   */
  std::optional<double>
  GetVolumeError() const;
};

/** Measures size and position. */
SurfaceMeasures
MeasureSurface(const itk::TriangleSurface & surface);

/** Also measures the scan's values inside; the voxel volume is that of the samples inside the surface. In an unevenly
 * spaced stack a voxel reaches half way to the next slices. */
SurfaceMeasures
MeasureSurface(const itk::TriangleSurface & surface, const Scan & scan);

/** Volume of all voxels whose value is inside the threshold, in mm^3. */
double
CountVoxelVolume(const Scan & scan, const Threshold & threshold);

} // namespace rhombic

#endif
