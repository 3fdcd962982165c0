#ifndef rhombicVolumePixels_h
#define rhombicVolumePixels_h

#include "rhombicScan.h"
#include "rhombicVolumeGeometry.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>

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

/** Reads the voxels of a volume in one pass, converted as OpenScan() documents. Throws what \a source throws. */
ScanImage
ReadVolumePixels(StoredType type,
                 const std::optional<ValueScaling> & scaling,
                 const VolumeGeometry & geometry,
                 const VoxelSource & source);

} // namespace rhombic

#endif
