#ifndef rhombicDicomPixels_h
#define rhombicDicomPixels_h

#include "rhombicDicomSlice.h"
#include "rhombicScan.h"
#include "rhombicVolumeGeometry.h"
#include "rhombicVoxelDecoder.h"

#include <functional>
#include <map>
#include <vector>

namespace rhombic
{

/** The rescaled values of a stack of slices. */
struct DicomPixels
{
  ScanImage image; ///< not set when files failed
  std::optional<double> paddingValue;
  std::size_t numberOfPaddingSamples = 0;
  std::map<std::filesystem::path, std::string> failures; ///< a sentence for each file that could not be read
};

/** Reads slices, in their order, whose files have no pixelDamage, into one volume. Pixels that are not compressed are
 * read here, the others by the decoder, as many files at once as it has workers. Samples that are padding get the
 * lowest value of the others. \a progress, if any, is called on this thread with numbers from 0 to 1. */
DicomPixels
ReadDicomPixels(const std::vector<DicomSlice> & slices,
                const VolumeGeometry & geometry,
                VoxelDecoder & decoder,
                const std::function<void(double)> & progress);

} // namespace rhombic

#endif
