#ifndef rhombicLabelPieces_h
#define rhombicLabelPieces_h

#include "itkImage.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rhombic
{

/** The connected pieces of labels. */
struct LabelPieces
{
  std::vector<std::uint16_t> labels;     ///< of each piece, and 0 of the background 0
  std::vector<std::size_t> counts;       ///< pieces of each label, of voxels connected through faces, edges or corners
  std::vector<std::size_t> countsByFace; ///< the same of voxels connected through faces alone
};

/** Replaces the labels of an image by the numbers of their pieces, from 1, in the order of labels and then of voxels.
 * When there are so many that numbers would not suffice, the last pieces of a label share one. Memory: 16 bytes for
 * each run of equal voxels along x.
 * \param labels all labels of the image are below it */
LabelPieces
NumberPieces(itk::Image<std::uint16_t, 3> & image, std::size_t labels);

} // namespace rhombic

#endif
