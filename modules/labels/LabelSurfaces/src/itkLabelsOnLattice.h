#ifndef itkLabelsOnLattice_h
#define itkLabelsOnLattice_h

#include "itkFCCImage.h"
#include "itkFCCLabelWeights.h"
#include "rhombicForEachBlock.h"

#include <array>
#include <vector>

namespace itk
{

/** \file
 * What filters that bring labels onto the lattice have in common. */

/** Calls use(index of the first sample of a row, its offset in the buffer) for each row of a box, on threads. */
template <typename TUse>
void
ForEachRow(const ImageRegion<3> & box, const TUse & use)
{
  rhombic::ForEachInBlocks(box.GetSize(1) * box.GetSize(2), 64, [&](std::size_t n) {
    Index<3> first = box.GetIndex();
    first[1] += static_cast<IndexValueType>(n % box.GetSize(1));
    first[2] += static_cast<IndexValueType>(n / box.GetSize(1));
    use(first, n * box.GetSize(0));
  });
}

/** The numbers of parts along each axis into which voxels are divided, so that the parts are nearly cubes: 1 where a
 * voxel is at most 1.5 times as long as its shortest edge. */
std::array<SizeValueType, 3>
DivideVoxels(const Vector<double, 3> & spacing);

/** Adds the weights of a label where they are below the limit, and gives it the sites where they are the largest.
 * Throws when rows of the lattice have more than 65,535 sites.
 * \param field the weights of the label in a box of the lattice
 * \param largest the largest weight so far, of each site */
void
AddLabelWeights(const FCCImage<float> & field,
                FCCLabelWeights::LabelType label,
                FCCImage<FCCLabelWeights::LabelType> & labels,
                std::vector<float> & largest,
                FCCLabelWeights & weights);

/** Sorts all rows, as FCCLabelWeights::Find() needs it. */
void
SortWeights(const ImageRegion<3> & lattice, FCCLabelWeights & weights);

} // namespace itk

#endif
