#ifndef rhombicIsosurfaceVolume_h
#define rhombicIsosurfaceVolume_h

#include "rhombicFCCImageFile.h"
#include "rhombicThreshold.h"

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

} // namespace rhombic

#endif
