#ifndef rhombicStoredVolume_h
#define rhombicStoredVolume_h

#include "rhombicScanReader.h"
#include "rhombicVolumeGeometry.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace rhombic
{

/** The type of the numbers in a file: any value of that type. */
using StoredType = std::variant<std::uint8_t,
                                std::int8_t,
                                std::uint16_t,
                                std::int16_t,
                                std::uint32_t,
                                std::int32_t,
                                std::uint64_t,
                                std::int64_t,
                                float,
                                double>;

/** Bytes of a voxel in the file. */
std::size_t
SizeOf(StoredType type);

/** true value = slope * stored value + intercept */
struct ValueScaling
{
  double slope = 1;
  double intercept = 0;
};

/** "slope 0.5, intercept -1024"; empty without a scaling. */
std::string
DescribeScaling(const std::optional<ValueScaling> & scaling);

/** Where the voxels of a file are. */
struct StoredVoxels
{
  std::filesystem::path path;
  std::uintmax_t offset = 0; ///< of the first voxel, or of the compressed stream
  std::uintmax_t skip = 0;   ///< bytes before the first voxel in the unpacked stream
  bool isDeflated = false;   ///< a zlib or gzip stream
  bool isSwapped = false;    ///< not in this machine's byte order
};

/** The content of a NIfTI, NRRD or MetaImage header. */
struct StoredVolume
{
  StoredType type;
  VolumeGeometry geometry;
  std::string matrix; ///< the header's field of the geometry's axes
  std::uintmax_t numberOfFrames = 1;
  bool areFramesInterleaved = false; ///< whether the values of a voxel in all frames are adjacent
  std::optional<ValueScaling> scaling;
  std::string encoding; ///< "raw", "gzip" or "zlib"
  StoredVoxels voxels;
  bool isOriented = true;
  std::string note; ///< assumptions, as the end of a sentence that begins with the path; may be empty
};

/** Throws Failure(Unreadable), naming \a header, when the file of the voxels can't hold as many as \a sizes say, the
 * volumes included. With \a areAtEnd, the voxels are the last bytes of their file: sets their offset. */
void
RequireVoxels(const std::vector<std::uintmax_t> & sizes,
              bool areAtEnd,
              const std::filesystem::path & header,
              StoredVolume & volume);

/** The product of sizes; nothing when it exceeds 2^60. */
std::optional<std::uintmax_t>
ProductOf(const std::vector<std::uintmax_t> & sizes);

/** \name Headers of files
 * Check the header's numbers and the length of the voxels, but do not unpack compressed voxels. A fourth axis is taken
 * as several volumes. Throw Failure: Unreadable, naming what is wrong or not supported, Geometry. */
///@{

/** A NIfTI-1 or NIfTI-2 file, or a pair of .hdr and .img by the name of either. Also checks the geometry, and describes
 * it in \a scan. */
StoredVolume
ReadNIfTIVolume(const std::filesystem::path & path, const ScanReadOptions & options, Scan & scan);

/** A NRRD file: .nrrd, or .nhdr with its data file. The fourth axis is the first or the last one. */
StoredVolume
ReadNRRDVolume(const std::filesystem::path & path);

/** A MetaImage file: .mha, or .mhd with its data file. */
StoredVolume
ReadMetaImageVolume(const std::filesystem::path & path);

/** A file of bare voxels, as the options tell. Throws Failure(Usage) when they contradict it. */
StoredVolume
DescribeRawVolume(const std::filesystem::path & path, const ScanReadOptions & options);

///@}

/** \name Voxels */
///@{

/** A volume without voxels, in the pixel type that ReadVolumePixels() tries first. */
ScanImage
NewVolumeImage(StoredType type, bool isScaled, const VolumeGeometry & geometry);

/** The largest number of bytes that ReadVolumePixels() allocates for this number of voxels. */
std::uintmax_t
MemoryOfPixels(StoredType type, bool isScaled, std::uintmax_t numberOfVoxels);

/** Reverses the bytes of each value. */
void
SwapBytes(std::byte * buffer, std::size_t size, std::size_t valueSize);

/** Reads the next \a size bytes of the voxels, a whole number of voxels, in this machine's byte order. */
using VoxelSource = std::function<void(std::byte * buffer, std::size_t size)>;

/** Reads the voxels of a volume in one pass, converted as OpenScan() documents. Throws what \a source throws.
 * \param store see NewImage() */
ScanImage
ReadVolumePixels(StoredType type,
                 const std::optional<ValueScaling> & scaling,
                 const VolumeGeometry & geometry,
                 const VoxelSource & source,
                 const TemporaryStore & store = {});

/** Whether the voxels of a frame can be used as the file holds them. */
bool
CanBeMapped(const StoredVolume & volume, std::uintmax_t frame);

/** One frame that can be mapped, as an image over the file (see IsMapped()); nothing where the system does not map it.
 */
std::optional<ScanImage>
MapVoxels(const StoredVolume & volume, std::uintmax_t frame);

/** Reads \a count voxels into \a buffer, as they are stored, or as floats when they are scaled. Throws what \a source
 * throws. */
void
ReadNativePixels(StoredType type,
                 const std::optional<ValueScaling> & scaling,
                 std::size_t count,
                 const VoxelSource & source,
                 void * buffer);

///@}

} // namespace rhombic

#endif
