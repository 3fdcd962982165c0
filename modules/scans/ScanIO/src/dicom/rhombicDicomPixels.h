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
  ScanImage image; ///< unset when files failed
  std::optional<double> paddingValue;
  std::size_t numberOfPaddingSamples = 0;
  std::map<std::filesystem::path, std::string> failures; ///< a sentence for each unreadable file
};

/** The volume of slices without voxels, in the pixel type that ReadDicomPixels() tries first. Values beyond int16
 * become uint16 or int32. */
ScanImage
NewDicomImage(const std::vector<DicomSlice> & slices, const VolumeGeometry & geometry);

/** Reads slices in their order into one volume; their files must have no pixelDamage. Uncompressed pixels are read
 * here, the others by the options' decoder, which must be set, in as many files at once as it has workers. Padding is
 * replaced by the lowest other value. It is kept when there is only one other value or padding is the next value below
 * the others: then it is the background of a mask or label map. Throws Failure(Memory) when the volume takes more
 * memory than the options allow. */
DicomPixels
ReadDicomPixels(const std::vector<DicomSlice> & slices,
                const VolumeGeometry & geometry,
                const ScanReadOptions & options);

} // namespace rhombic

#endif
