#ifndef rhombicVolumePixels_h
#define rhombicVolumePixels_h

#include "rhombicScan.h"
#include "rhombicVolumeGeometry.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace rhombic
{

/** What a file stores for each voxel. */
enum class StoredType
{
  UInt8,
  Int8,
  UInt16,
  Int16,
  UInt32,
  Int32,
  UInt64,
  Int64,
  Float,
  Double
};

/** Bytes of a voxel in the file. */
std::size_t
SizeOf(StoredType type);

/** From stored to true values. */
struct ValueScaling
{
  double slope = 1;
  double intercept = 0;
};

/** "slope 0.5, intercept -1024", or empty for none. */
std::string
DescribeScaling(const std::optional<ValueScaling> & scaling);

/** The most bytes that ReadVolumePixels() allocates for this many voxels. */
std::uintmax_t
MemoryOfPixels(StoredType type, bool isScaled, std::uintmax_t numberOfVoxels);

/** Turns each value's bytes around. */
void
SwapBytes(std::byte * buffer, std::size_t size, std::size_t valueSize);

/** Gives the next \a size bytes of the voxels, in this machine's byte order: whole numbers of voxels. */
using VoxelSource = std::function<void(std::byte * buffer, std::size_t size)>;

/** Reads the voxels of a volume in one pass, converted as ReadScan() says. Throws what \a source throws. */
ScanImage
ReadVolumePixels(StoredType type,
                 const std::optional<ValueScaling> & scaling,
                 const VolumeGeometry & geometry,
                 const VoxelSource & source);

} // namespace rhombic

#endif
