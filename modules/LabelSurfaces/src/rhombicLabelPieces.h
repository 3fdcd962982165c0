#ifndef rhombicLabelPieces_h
#define rhombicLabelPieces_h

#include "itkImage.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rhombic
{

/** The number of connected pieces of each label below \a labels; 0 for the background 0. Voxels are connected through
 * faces, or through edges and corners too. Memory: 24 bytes for each run of equal voxels along x. */
std::vector<std::size_t>
CountPieces(const itk::Image<std::uint16_t, 3> & image, std::size_t labels, bool throughFacesOnly);

} // namespace rhombic

#endif
