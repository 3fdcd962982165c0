#include "rhombicNIfTIHeader.h"

#include "rhombicCompressedFile.h"
#include "rhombicFiles.h"

#include <string>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr std::int32_t Size1 = 348;
constexpr std::int32_t Size2 = 540;

/** Where the fields of a version of the header are: bytes from its beginning. */
struct FieldOffsets
{
  std::size_t magic, dimensions, intent, datatype, bits, pixdim, voxelsOffset, slope, intercept, units, qformCode;
  std::size_t sformCode, quaternion, qformOffset, sform;
};

constexpr FieldOffsets Offsets1{ 344, 40, 68, 70, 72, 76, 108, 112, 116, 123, 252, 254, 256, 268, 280 }; // nifti1.h
constexpr FieldOffsets Offsets2{ 4, 16, 504, 12, 14, 104, 168, 176, 184, 500, 344, 348, 352, 376, 400 }; // nifti2.h

template <typename TValue, typename TArray>
void
GetAll(std::string_view bytes, std::size_t offset, bool isSwapped, TArray & values)
{
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = NumberAt<TValue>(bytes, offset + i * sizeof(TValue), isSwapped);
  }
}

/** Parses a header whose dimensions, voxels' offset, real numbers, codes and units are of the given types. */
template <typename TDimension, typename TOffset, typename TReal, typename TCode, typename TUnits>
NIfTIHeader
ParseHeader(std::string_view bytes, const FieldOffsets & at, int version, bool isSwapped)
{
  const std::string ending = std::to_string(version) + '\0';
  const std::string_view magic = bytes.substr(at.magic, 4);
  NIfTIHeader header;
  header.version = version;
  header.isSwapped = isSwapped;
  header.kind = magic == "n+" + ending   ? NIfTIHeader::Kind::SingleFile
                : magic == "ni" + ending ? NIfTIHeader::Kind::Pair
                                         : NIfTIHeader::Kind::Analyze;
  GetAll<TDimension>(bytes, at.dimensions, isSwapped, header.dimensions);
  header.intent = NumberAt<TCode>(bytes, at.intent, isSwapped);
  header.datatype = NumberAt<std::int16_t>(bytes, at.datatype, isSwapped);
  header.bits = NumberAt<std::int16_t>(bytes, at.bits, isSwapped);
  GetAll<TReal>(bytes, at.pixdim, isSwapped, header.pixdim);
  header.voxelsOffset = static_cast<double>(NumberAt<TOffset>(bytes, at.voxelsOffset, isSwapped));
  header.slope = NumberAt<TReal>(bytes, at.slope, isSwapped);
  header.intercept = NumberAt<TReal>(bytes, at.intercept, isSwapped);
  header.units = NumberAt<TUnits>(bytes, at.units, isSwapped);
  header.qformCode = NumberAt<TCode>(bytes, at.qformCode, isSwapped);
  header.sformCode = NumberAt<TCode>(bytes, at.sformCode, isSwapped);
  GetAll<TReal>(bytes, at.quaternion, isSwapped, header.quaternion);
  GetAll<TReal>(bytes, at.qformOffset, isSwapped, header.qformOffset);
  for (std::size_t row = 0; row < 3; ++row)
  {
    GetAll<TReal>(bytes, at.sform + 4 * row * sizeof(TReal), isSwapped, header.sform[row]);
  }
  return header;
}

} // namespace

std::optional<NIfTIHeader>
FindNIfTIHeader(const fs::path & path)
{
  std::string content(Size2, '\0');
  content.resize(ByteStream(path, 0, IsGzip(path)).Read(content.data(), content.size()));

  for (const bool isSwapped : { false, true })
  {
    const auto size = content.size() >= sizeof(std::int32_t) ? NumberAt<std::int32_t>(content, 0, isSwapped) : 0;
    if ((size == Size1 || size == Size2) && content.size() >= static_cast<std::size_t>(size))
    {
      using Integer = std::int32_t;
      NIfTIHeader header =
        size == Size1
          ? ParseHeader<std::int16_t, float, float, std::int16_t, std::uint8_t>(content, Offsets1, 1, isSwapped)
          : ParseHeader<std::int64_t, std::int64_t, double, Integer, Integer>(content, Offsets2, 2, isSwapped);
      header.size = static_cast<std::size_t>(size);
      return header;
    }
  }
  return std::nullopt;
}

} // namespace rhombic
