#ifndef rhombicVoxelMetrics_h
#define rhombicVoxelMetrics_h

#include "rhombicCompareLabels.h"

#include "itkImageRegion.h"

#include <cstdint>

namespace rhombic
{

/** A label of a map. */
struct VoxelLabel
{
  const Scan & map;
  std::int32_t value;
};

/** Measures of two labels between the corners of their voxels, as the program surface-distance of DeepMind defines them
 * (Nikolov et al., "Clinically applicable segmentation of head and neck anatomy for radiotherapy", JMIR 2021).
 *
 * A corner is on the border of a label if some of its eight voxels have the label and others do not. It stands for the
 * area of marching cubes' triangles between the centres of these voxels (Lorensen and Cline, SIGGRAPH 1987: more than
 * four voxels as their complement). Its distance is that to the nearest corner on the border of the other label.
 *
 * \param region a region that holds all voxels of both labels, each of which has some
 * \param tolerance of the normalised surface Dice, in mm
 * The maps have one grid of evenly spaced slices. Thread safe. */
VoxelMetrics
ComputeVoxelMetrics(const VoxelLabel & first,
                    const VoxelLabel & second,
                    const itk::ImageRegion<3> & region,
                    double tolerance);

} // namespace rhombic

#endif
