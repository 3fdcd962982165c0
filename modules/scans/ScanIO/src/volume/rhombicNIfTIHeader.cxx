#include "rhombicNIfTIHeader.h"

#include "rhombicCompressedFile.h"
#include "rhombicFiles.h"
#include "rhombicVolumeRefusal.h"

#include <string>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr std::int32_t Size1 = 348;
constexpr std::int32_t Size2 = 540;

/** The numbers of a header of either byte order. */
class HeaderBytes
{
public:
  HeaderBytes(const std::string & bytes, bool isSwapped)
    : m_Bytes(bytes)
    , m_IsSwapped(isSwapped)
  {}

  template <typename TValue>
  TValue
  Get(std::size_t offset) const
  {
    return NumberAt<TValue>(m_Bytes, offset, m_IsSwapped);
  }

  template <typename TValue, typename TArray>
  void
  GetAll(std::size_t offset, TArray & values) const
  {
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = this->Get<TValue>(offset + i * sizeof(TValue));
    }
  }

  bool
  Has(std::size_t offset, const std::string & text) const
  {
    return m_Bytes.compare(offset, text.size(), text) == 0;
  }

private:
  const std::string m_Bytes;
  const bool m_IsSwapped;
};

NIfTIHeader::Kind
KindOf(const HeaderBytes & bytes, std::size_t offset, char version)
{
  using namespace std::string_literals;
  return bytes.Has(offset, "n+"s + version + '\0')   ? NIfTIHeader::Kind::SingleFile
         : bytes.Has(offset, "ni"s + version + '\0') ? NIfTIHeader::Kind::Pair
                                                     : NIfTIHeader::Kind::Analyze;
}

/** Parses a header with the offsets of nifti1.h. */
NIfTIHeader
ParseVersion1(const HeaderBytes & bytes)
{
  NIfTIHeader header;
  header.kind = KindOf(bytes, 344, '1');
  bytes.GetAll<std::int16_t>(40, header.dimensions);
  header.intent = bytes.Get<std::int16_t>(68);
  header.datatype = bytes.Get<std::int16_t>(70);
  header.bits = bytes.Get<std::int16_t>(72);
  bytes.GetAll<float>(76, header.pixdim);
  header.voxelsOffset = bytes.Get<float>(108);
  header.slope = bytes.Get<float>(112);
  header.intercept = bytes.Get<float>(116);
  header.units = bytes.Get<std::uint8_t>(123);
  header.qformCode = bytes.Get<std::int16_t>(252);
  header.sformCode = bytes.Get<std::int16_t>(254);
  bytes.GetAll<float>(256, header.quaternion);
  bytes.GetAll<float>(268, header.qformOffset);
  for (std::size_t row = 0; row < 3; ++row)
  {
    bytes.GetAll<float>(280 + 16 * row, header.sform[row]);
  }
  return header;
}

/** Parses a header with the offsets of nifti2.h. */
NIfTIHeader
ParseVersion2(const HeaderBytes & bytes)
{
  NIfTIHeader header;
  header.version = 2;
  header.kind = KindOf(bytes, 4, '2');
  header.datatype = bytes.Get<std::int16_t>(12);
  header.bits = bytes.Get<std::int16_t>(14);
  bytes.GetAll<std::int64_t>(16, header.dimensions);
  bytes.GetAll<double>(104, header.pixdim);
  header.voxelsOffset = static_cast<double>(bytes.Get<std::int64_t>(168));
  header.slope = bytes.Get<double>(176);
  header.intercept = bytes.Get<double>(184);
  header.qformCode = bytes.Get<std::int32_t>(344);
  header.sformCode = bytes.Get<std::int32_t>(348);
  bytes.GetAll<double>(352, header.quaternion);
  bytes.GetAll<double>(376, header.qformOffset);
  for (std::size_t row = 0; row < 3; ++row)
  {
    bytes.GetAll<double>(400 + 32 * row, header.sform[row]);
  }
  header.units = bytes.Get<std::int32_t>(500);
  header.intent = bytes.Get<std::int32_t>(504);
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
    const HeaderBytes bytes(content, isSwapped);
    const std::int32_t size = content.size() >= sizeof(std::int32_t) ? bytes.Get<std::int32_t>(0) : 0;
    if ((size == Size1 || size == Size2) && content.size() >= static_cast<std::size_t>(size))
    {
      NIfTIHeader header = size == Size1 ? ParseVersion1(bytes) : ParseVersion2(bytes);
      header.size = static_cast<std::size_t>(size);
      header.isSwapped = isSwapped;
      return header;
    }
  }
  return std::nullopt;
}

NIfTIHeader
ReadNIfTIHeader(const fs::path & path)
{
  if (const auto header = FindNIfTIHeader(path))
  {
    return *header;
  }
  RefuseVolume(path, "its content is not NIfTI, as its name says; check where it came from");
}

} // namespace rhombic
