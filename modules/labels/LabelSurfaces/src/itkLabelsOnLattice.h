#ifndef itkLabelsOnLattice_h
#define itkLabelsOnLattice_h

#include "itkBulkAllocator.h"
#include "itkFCCImage.h"
#include "itkFCCLabelWeights.h"
#include "itkImage.h"
#include "rhombicForEachBlock.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace itk
{

/** \file
 * Passes of the filters that bring labels onto the lattice. */

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

/** \class StrongestLabels
 * \brief Gives each site of a lattice the label of largest weight, label by label, and stores the weights below the
 * limit. */
class StrongestLabels
{
public:
  using LabelType = FCCLabelWeights::LabelType;

  /** Empties the labels, which are allocated, and the weights. */
  StrongestLabels(FCCImage<LabelType> & labels, FCCLabelWeights & weights);

  /** Adds the weights of a label in a box of the lattice. Throws when rows of the lattice have more than 65,535
   * sites. */
  void
  Add(const FCCImage<float> & field, LabelType label);

  /** Adds the weights of label 0 in a box of the lattice, after those of all other labels: the values of \a field,
   * and where label 0 has one neighbour the negative weight of the label that is strongest so far.
   * \param hasOneNeighbor for each site of the lattice, 1 or 0 */
  void
  AddZero(const FCCImage<float> & field, const BulkVector<std::uint8_t> & hasOneNeighbor);

  /** Sorts the weights, as FCCLabelWeights::Find() needs it. */
  void
  SortWeights();

private:
  /** Adds a label's weight(value, site) at each site of a box. */
  template <typename TWeight>
  void
  AddWeights(const FCCImage<float> & field, LabelType label, const TWeight & weightOf);

  FCCImage<LabelType> & m_Labels;
  FCCLabelWeights & m_Weights;
  BulkVector<float> m_Largest; ///< weight so far, of each site
};

/** The sites whose Voronoi cells hold a part of the middle of thin parts, sorted. The middle is made of the convex
 * hulls of the inside voxels' centres in each cube of eight neighbouring centres that has a thin voxel. Voronoi cells
 * are convex and fill space, so the sites of a middle that is connected are connected, and those of a plane have no
 * holes. In itkThinPartSites.cxx.
 *
 * \param mask voxels other than 0 are inside
 * \param region the voxels of the mask that count
 * \param thin offsets of the thin voxels in the mask's buffer, ascending
 * \param placeVoxel gives the position of a voxel's centre in lattice coordinates; is called on several threads */
BulkVector<FCCLattice::SiteType>
FindThinPartSites(const Image<std::uint8_t, 3> & mask,
                  const ImageRegion<3> & region,
                  const BulkVector<SizeValueType> & thin,
                  const std::function<std::array<double, 3>(const Index<3> &)> & placeVoxel);

} // namespace itk

#endif
