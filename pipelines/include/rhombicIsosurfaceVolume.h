#ifndef rhombicIsosurfaceVolume_h
#define rhombicIsosurfaceVolume_h

#include "rhombicFCCImageFile.h"
#include "rhombicSurfaceRequest.h"

namespace rhombic
{

/** \class IsosurfaceVolume
 * \brief What the isosurface of a continuous field encloses, in mm^3, estimated from the field's samples alone.
 *
 * Thread safety: a value. */
struct IsosurfaceVolume
{
  double volume = 0.0;
  double uncertainty = 0.0; ///< three standard errors and 0.2 % of the volume

  /** How far another volume is from this one, relative to this one: above 0 when it is larger. */
  double
  GetErrorOf(double other) const
  {
    return other / volume - 1.0;
  }

  /** The uncertainty relative to the volume. */
  double
  GetRelativeUncertainty() const
  {
    return uncertainty / volume;
  }
};

/** Counts the lattice's samples on a request's side of its isovalue, and multiplies by the volume of a site.
 *
 * A mesh cuts corners and bridges or drops what is thinner than the samples' distance, so its volume is off in one
 * direction. Samples meet thin and thick parts in proportion to their volumes, so their number is right on average. Its
 * standard error is a^2 sqrt(A / 12) for a surface of area A and sites a apart (the cube root of a site's volume), as
 * each column of sites meets the surface at a place of its own; those of flat surfaces along the lattice's planes do
 * not, for which 0.2 % are added. At the default density, in 17 surfaces of scans and phantoms, the number was within
 * 0.4 % of that at densities of 7 to 14, and within the uncertainty in all of them, where meshes were up to 14 % off.
 *
 * The lattice's sites have to lie anywhere between the scan's samples, as those of the default density do. Those of
 * density 0.5 are samples of the scan, or all half way between some, which say less about the rest: around a single
 * bright sample the field is broader than a voxel. Nested lattices (LatticeSettings::nested) are of another field, as
 * the scan was smoothed for them.
 *
 * \param area of the isosurface in mm^2, as any mesh of it has
 * \param grid of the scan that the lattice was made from, if it is not slanted: sites at its border count by the part
 * of them that lies in its voxels, as LatticeToSurfaces() closes surfaces there
 *
 * Throws Failure(Usage) for a request without an isovalue. Threads through itk::MultiThreaderBase; the result does not
 * depend on their number. Thread safe. */
IsosurfaceVolume
EstimateIsosurfaceVolume(const FCCVolume & lattice,
                         const SurfaceRequest & request,
                         double area,
                         const itk::ImageBase<3> * grid = nullptr);

} // namespace rhombic

#endif
