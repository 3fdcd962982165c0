#ifndef rhombicVoxelGrid_h
#define rhombicVoxelGrid_h

#include "itkImageBase.h"

#include <vector>

namespace rhombic
{

/** \file
 * Sizes of voxels, and evenness of slices. A grid's slices may have places of their own: the positions of their first
 * samples in LPS mm. Functions are thread safe. */

/** The step in LPS mm from a sample to the next along an axis of the grid. */
itk::Vector<double, 3>
StepAlong(const itk::ImageBase<3> & grid, unsigned int axis);

/** The edge in mm of a cube with the volume of a voxel, for perpendicular axes: the cube root of the spacings' product.
 */
double
MeanSpacingOf(const itk::ImageBase<3> & grid);

/** The volume in mm^3 of a voxel of each slice. Between slices with places of their own, a voxel extends halfway to the
 * adjacent slices. \param sliceOrigins empty for slices at even steps */
std::vector<double>
VoxelVolumesOf(const itk::ImageBase<3> & grid, const std::vector<itk::Point<double, 3>> & sliceOrigins);

/** The largest distance in mm of a slice from its place on the line of equal steps from the first slice to the last.
 * Slices are even if it is at most EvenSliceTolerance(). */
double
DistanceFromEvenSlices(const std::vector<itk::Point<double, 3>> & sliceOrigins);

/** How far in mm even slices may be from their places: a hundredth of a millimetre, within which scanners round
 * positions, but at most a tenth of a step. */
double
EvenSliceTolerance(double step);

} // namespace rhombic

#endif
