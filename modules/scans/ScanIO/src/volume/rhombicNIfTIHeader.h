#ifndef rhombicNIfTIHeader_h
#define rhombicNIfTIHeader_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace rhombic
{

/** The fields of a NIfTI-1 or NIfTI-2 header that are used, as stored. */
struct NIfTIHeader
{
  enum class Kind
  {
    SingleFile, ///< the voxels follow in the same file
    Pair,       ///< the voxels are in an .img file
    Analyze     ///< Analyze 7.5, or a NIfTI file whose magic word is damaged
  };

  std::size_t size = 0; ///< bytes: 348 in version 1, 540 in version 2
  Kind kind = Kind::SingleFile;
  int version = 1;
  bool isSwapped = false; ///< not in this machine's byte order
  std::array<std::int64_t, 8> dimensions{};
  int intent = 0;
  int datatype = 0;
  int bits = 0;
  std::array<double, 8> pixdim{};
  double voxelsOffset = 0; ///< bytes
  double slope = 0;
  double intercept = 0;
  int units = 0;
  int qformCode = 0;
  int sformCode = 0;
  std::array<double, 3> quaternion{};
  std::array<double, 3> qformOffset{};
  std::array<std::array<double, 4>, 3> sform{};
};

/** The header of a .nii or .hdr file, compressed or not; nothing when the file begins with none. The values of its
 * fields are not checked. Throws Failure(Unreadable) when the file can't be read. */
std::optional<NIfTIHeader>
FindNIfTIHeader(const std::filesystem::path & path);

} // namespace rhombic

#endif
