#ifndef rhombicSurfaceMeasures_h
#define rhombicSurfaceMeasures_h

#include "rhombicFCCImageFile.h"
#include "rhombicScan.h"
#include "rhombicPixelTypes.h"

#include "itkTriangleSurface.h"

#include <array>
#include <optional>

namespace rhombic
{

/** \class IsosurfaceVolume
 * \brief The volume inside the isosurface of a continuous field, estimated from the field's samples. */
struct IsosurfaceVolume
{
  double volume = 0.0;      ///< mm^3
  double uncertainty = 0.0; ///< mm^3: three standard errors and 0.2 % of the volume

  /** Relative difference of another volume from this one; positive when it is larger. */
  double
  GetErrorOf(double other) const
  {
    return other / volume - 1.0;
  }

  double
  GetRelativeUncertainty() const
  {
    return uncertainty / volume;
  }
};

/** Counts the lattice's samples inside a threshold, and multiplies by the volume of a site.
 *
 * A mesh cuts corners and bridges or drops what is thinner than the distance of samples, so its volume has a bias.
 * Samples fall into thin and thick parts in proportion to their volumes, so their number has none. Its standard error
 * is a^2 sqrt(A / 12) for a surface of area A and sites a apart (the cube root of a site's volume), because the surface
 * cuts each column of sites at an independent position. Flat surfaces along the lattice's planes do not; 0.2 % are
 * added for them. At the default density, on 17 surfaces of scans and phantoms, the estimate was within 0.4 % of that
 * at densities of 7 to 14, and within its uncertainty on all of them; meshes were up to 14 % off.
 *
 * The lattice's sites have to fall at varying positions between the scan's samples, as they do at the default density.
 * At density 0.5 all sites are samples of the scan, or all lie half way between some, and the estimate can be biased:
 * around a single bright sample the field is broader than a voxel. A nested lattice (LatticeSettings::nested) samples a
 * smoothed scan, whose isosurface is another one.
 *
 * \param area of the isosurface in mm^2; that of any of its meshes will do
 * \param grid the grid of the scan that the lattice was made from, or null for slanted scans. With it, sites at the
 * border count by the share of them that lies in the grid's voxels, where MoveFCCWallsToBorder() closes surfaces.
 *
 * The result does not depend on the number of threads. */
IsosurfaceVolume
EstimateIsosurfaceVolume(const FCCVolume & lattice,
                         const Threshold & threshold,
                         double area,
                         const itk::ImageBase<3> * grid = nullptr);

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
