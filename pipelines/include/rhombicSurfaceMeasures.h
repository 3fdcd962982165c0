#ifndef rhombicSurfaceMeasures_h
#define rhombicSurfaceMeasures_h

#include "rhombicIsosurfaceVolume.h"
#include "rhombicScan.h"
#include "rhombicScanReport.h"
#include "rhombicSurfaceRequest.h"

#include "itkTriangleSurface.h"

#include <array>
#include <cstddef>
#include <optional>

namespace rhombic
{

/** \class SurfaceMeasures
 * \brief What a closed surface encloses, in LPS mm.
 *
 * Thread safety: a value. */
struct SurfaceMeasures
{
  double volume = 0.0;            ///< mm^3
  double area = 0.0;              ///< mm^2
  std::array<double, 6> bounds{}; ///< xmin, xmax, ymin, ymax, zmin, zmax
  std::array<double, 3> centroid{};
  double longestDiameter = 0.0;

  /** Of the scan's samples inside the surface, weighted by their voxels' volumes; none without a scan. */
  std::optional<double> meanValue;
  std::optional<double> standardDeviation;

  /** What counting voxels comes to, in mm^3: an independent check of the volume. */
  std::optional<double> voxelVolume;

  /** What the scan's isosurface encloses, estimated from the lattice's samples; none of labels. */
  std::optional<IsosurfaceVolume> isosurface;

  /** How far the volume is from the isosurface's, or, without one, from the voxels', in %; positive if it is larger. */
  std::optional<double>
  GetVolumeError() const;
};

/** Shape alone. */
SurfaceMeasures
MeasureSurface(const itk::TriangleSurface & surface);

/** Shape, and the scan's values inside. The voxel volume is that of the samples inside the surface. In an unevenly
 * spaced stack a voxel reaches halfway to the next slices. Thread safe. */
SurfaceMeasures
MeasureSurface(const itk::TriangleSurface & surface, const Scan & scan);

/** The volume of all voxels whose value is on a request's side of its isovalue, in mm^3. */
double
CountVoxelVolume(const Scan & scan, double isovalue, SurfaceRequest::Side side);

/** With units in the keys; volumes in ml. */
Report
ReportMeasures(const SurfaceMeasures & measures);

} // namespace rhombic

#endif
