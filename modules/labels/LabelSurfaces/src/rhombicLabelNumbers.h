#ifndef rhombicLabelNumbers_h
#define rhombicLabelNumbers_h

#include "rhombicLabelMap.h"

#include "itkImage.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Numbers of the labels that get surfaces, and of the pieces of labels. */

/** The labels of the map that are wanted, or the labels that its table shows if none are named. Throws Failure: Usage
 * for names that fit none, Empty when there is none to show. */
std::vector<LabelSummary>
ChooseLabels(const LabelMap & map, const std::vector<std::string> & wanted);

using NumberImage = itk::Image<std::uint16_t, 3>;

/** The number of the label of each voxel, from 1, by its place in the list; 0 for all other labels.
 * \param labels at most 65,535, in the order of their values */
NumberImage::Pointer
NumberLabels(const ScanImage & image, const std::vector<LabelSummary> & labels);

constexpr itk::SizeValueType BoxMargin = 12; ///< voxels around labels, beyond which they have no effect on walls

/** Voxels around a part of a map, beyond which they hardly have an effect on the walls in it: as far as smoothing
 * reaches, six times the shortest edge of a voxel, and four voxels at least. */
itk::Size<3>
MarginOfPart(const itk::ImageBase<3> & grid);

/** The numbers of the voxels in a region of an image, row by row. */
void
NumberRows(const ScanImage & image,
           const std::vector<LabelSummary> & labels,
           const itk::ImageRegion<3> & region,
           std::uint16_t * numbers);

/** Calls use(label, begin, end) for the runs of one label of some voxels that lie in a row. */
template <typename TUse>
void
ForEachRun(const std::uint16_t * voxels, std::size_t count, const TUse & use)
{
  for (std::size_t begin = 0, end = 0; begin < count; begin = end)
  {
    const auto isOther = [label = voxels[begin]](std::uint16_t other) { return other != label; };
    end = static_cast<std::size_t>(std::find_if(voxels + begin, voxels + count, isOther) - voxels);
    use(voxels[begin], begin, end);
  }
}

/** The connected pieces of labels. */
struct LabelPieces
{
  std::vector<std::uint16_t> labels;     ///< of each piece, and 0 of the background 0
  std::vector<std::size_t> counts;       ///< pieces of each label, of voxels connected through faces, edges or corners
  std::vector<std::size_t> countsByFace; ///< the same of voxels connected through faces alone
};

/** Replaces the numbers of labels in an image by the numbers of their pieces, from 1, in the order of labels and then
 * of voxels. When there are so many that numbers would not suffice, the last pieces of a label share one. Memory: 16
 * bytes for each run of equal voxels along x. \param labels all numbers in the image are below it */
LabelPieces
NumberPieces(NumberImage & image, std::size_t labels);

} // namespace rhombic

#endif
