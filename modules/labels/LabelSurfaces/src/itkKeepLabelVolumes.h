#ifndef itkKeepLabelVolumes_h
#define itkKeepLabelVolumes_h

#include "itkFCCImage.h"
#include "itkFCCLabelWeights.h"
#include "itkLabelTopology.h"

#include <vector>

namespace itk
{

/** Where the labels of a lattice are, and what their walls are to enclose; by label. */
struct LabelsToKeep
{
  std::vector<double> volumes;       ///< in mm^3
  std::vector<ImageRegion<3>> sites; ///< boxes that hold all sites of a label and their neighbours
};

/** Adds offsets to the weights of labels, so that their walls enclose the volumes of their voxels.
 *
 * A round corrects all labels together from the walls of the whole lattice. Labels whose offset has changed
 * much, mostly specks, are corrected again, each from the walls around it, as long as they are few. What is left, some
 * hundredths of a voxel, RelaxLabelWalls() makes up for.
 *
 * \param voxelEdge in mm
 * \param topology of the labels and weights */
void
KeepLabelVolumes(const LabelsToKeep & keep,
                 double voxelEdge,
                 const FCCImage<FCCLabelWeights::LabelType> & labels,
                 const FCCLabelWeights & weights,
                 LabelTopology & topology);

} // namespace itk

#endif
