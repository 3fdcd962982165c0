#ifndef rhombicDicomPixels_h
#define rhombicDicomPixels_h

#include "rhombicDicomSlice.h"
#include "rhombicScanReader.h"
#include "rhombicVolumeGeometry.h"
#include "rhombicVoxelDecoder.h"

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
 * read here, the others by the options' decoder, which must be set, as many files at once as it has workers. Samples
 * that are padding get the lowest value of the others, unless these have one value only or padding is the value next to
 * theirs: it is then the background of a mask or of labels, and stays. Throws Failure(Memory) when that would take more than the
 * options allow. */
DicomPixels
ReadDicomPixels(const std::vector<DicomSlice> & slices,
                const VolumeGeometry & geometry,
                const ScanReadOptions & options);

} // namespace rhombic

#endif
