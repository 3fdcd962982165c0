#include "rhombicZarrArray.h"

#include "rhombicFiles.h"
#include "rhombicSandbox.h"
#include "rhombicWording.h"

#include "itkByteSwapper.h"
#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr std::uintmax_t MostValues = std::uintmax_t(1) << 60;
constexpr std::uintmax_t MostChunks = std::uintmax_t(1) << 24;
constexpr std::uintmax_t LargestPackedChunk = std::uintmax_t(1) << 29; // bytes
constexpr std::size_t LongestAxis = std::numeric_limits<std::int32_t>::max();

/** The product of numbers, each at least 1; nothing when it exceeds \a most. */
std::optional<std::size_t>
BoundedProduct(const ZarrNumbers & numbers, std::uintmax_t most)
{
  std::size_t product = 1;
  for (const std::size_t number : numbers)
  {
    if (number > most / product)
    {
      return std::nullopt;
    }
    product *= number;
  }
  return product;
}

/** The position of an element in an array whose last axis is the fastest. */
std::size_t
PositionIn(const ZarrNumbers & size, const ZarrNumbers & place)
{
  std::size_t position = 0;
  for (std::size_t axis = 0; axis < MostZarrAxes; ++axis)
  {
    position = position * size[axis] + place[axis];
  }
  return position;
}

/** The fill value as bytes of a type; nothing for null. \a isValid says whether the type has such a value. */
template <typename TValue>
std::optional<std::vector<std::byte>>
FillBytes(const nlohmann::json & fill, bool & isValid)
{
  [[maybe_unused]] static const std::map<std::string, double> words{
    { "NaN", std::numeric_limits<double>::quiet_NaN() },
    { "Infinity", std::numeric_limits<double>::infinity() },
    { "-Infinity", -std::numeric_limits<double>::infinity() }
  };
  isValid = true;
  if (fill.is_null())
  {
    return std::nullopt;
  }
  using Limits = std::numeric_limits<TValue>;
  TValue value{};
  if constexpr (std::is_floating_point_v<TValue>)
  {
    const auto word = fill.is_string() ? words.find(fill.get<std::string>()) : words.end();
    isValid = word != words.end() || fill.is_number();
    value = static_cast<TValue>(word != words.end() ? word->second : isValid ? fill.get<double>() : 0.0);
  }
  else if (fill.is_number_unsigned())
  {
    isValid = fill.get<std::uint64_t>() <= static_cast<std::uint64_t>(Limits::max());
    value = static_cast<TValue>(fill.get<std::uint64_t>());
  }
  else
  {
    isValid = fill.is_number_integer() && fill.get<std::int64_t>() >= static_cast<std::int64_t>(Limits::lowest());
    value = static_cast<TValue>(isValid ? fill.get<std::int64_t>() : 0);
  }
  std::vector<std::byte> bytes(sizeof(TValue));
  std::memcpy(bytes.data(), &value, sizeof(TValue));
  return bytes;
}

/** A file that is open for reading. */
class RawChunk
{
public:
  explicit RawChunk(const fs::path & path)
    : m_Path(path)
    , m_File(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) // pipes would be waited for
  {
    if (m_File < 0)
    {
      RefuseZarr(path, std::string(std::strerror(errno)) + "; check that it is yours");
    }
  }

  ~RawChunk()
  {
    close(m_File);
  }

  RawChunk(const RawChunk &) = delete;
  RawChunk &
  operator=(const RawChunk &) = delete;

  /** Throws Failure unless it is a file of this size. */
  void
  RequireSize(std::uintmax_t size) const
  {
    struct stat status
    {};
    if (fstat(m_File, &status) != 0 || !S_ISREG(status.st_mode))
    {
      RefuseZarr(m_Path, "it is no file; copy the folder again from its source");
    }
    if (static_cast<std::uintmax_t>(status.st_size) != size)
    {
      RefuseZarr(m_Path,
                 "it has " + std::to_string(status.st_size) + " bytes, and a chunk of its array has " +
                   std::to_string(size) + "; it is damaged or cut off, so copy it again from its source");
    }
  }

  void
  Read(std::byte * buffer, std::size_t size, std::size_t offset) const
  {
    while (size > 0)
    {
      const ssize_t count = pread(m_File, buffer, size, static_cast<off_t>(offset));
      if (count < 0 && errno == EINTR)
      {
        continue;
      }
      if (count <= 0)
      {
        RefuseZarr(m_Path, "it can't be read to its end; copy it again from its source");
      }
      buffer += count;
      size -= static_cast<std::size_t>(count);
      offset += static_cast<std::size_t>(count);
    }
  }

private:
  const fs::path & m_Path;
  const int m_File;
};

void
ReverseValues(std::byte * buffer, std::size_t size, std::size_t valueSize)
{
  for (std::byte * value = buffer; value != buffer + size; value += valueSize)
  {
    std::reverse(value, value + valueSize);
  }
}

} // namespace

bool
ExistsInZarr(const fs::path & folder, const fs::path & parts, bool followsLinks)
{
  fs::path path = folder;
  for (auto part = parts.begin(); part != parts.end(); ++part)
  {
    path /= *part;
    std::error_code error;
    fs::file_status status = fs::symlink_status(path, error);
    if (!fs::status_known(status))
    {
      RefuseZarr(path, error.message() + "; check that it is yours");
    }
    if (!fs::exists(status))
    {
      return false;
    }
    if (fs::is_symlink(status))
    {
      status = fs::status(path, error);
      if (!followsLinks || !fs::exists(status))
      {
        RefuseZarr(path,
                   followsLinks ? "it is a symbolic link to nothing; bring its content here"
                                : "it is a symbolic link; accept these with OMEZarrOptions::followsLinks");
      }
    }
    if (fs::is_directory(status) != (std::next(part) != parts.end()))
    {
      RefuseZarr(path,
                 fs::is_directory(status) ? "it is a folder, where a file should be; copy it again from its source"
                                          : "it is no folder, as it should be; copy it again from its source");
    }
  }
  return true;
}

nlohmann::json
ReadZarrMetadata(const fs::path & folder, const fs::path & name, bool followsLinks)
{
  constexpr std::size_t longest = 1 << 24;
  constexpr int deepest = 64;
  const fs::path path = folder / name;
  if (!ExistsInZarr(folder, name, followsLinks))
  {
    RefuseZarr(path, "it is missing; copy the folder again from its source");
  }
  const std::string text = ReadTextFile(path, "metadata file", longest);
  if (text.size() > longest)
  {
    RefuseZarr(path, "it has more than 16 MiB of metadata; check where it came from");
  }
  const auto check = [&path](int depth, nlohmann::json::parse_event_t, nlohmann::json &) {
    if (depth > deepest)
    {
      RefuseZarr(path, "its metadata is nested more than 64 levels deep; check where it came from");
    }
    return true;
  };
  nlohmann::json metadata = nlohmann::json::parse(text, check, false);
  if (!metadata.is_object())
  {
    RefuseZarr(path, "it holds no JSON object; copy it again from its source");
  }
  return metadata;
}

ZarrArray::ZarrArray(const fs::path & root, const fs::path & name, bool followsLinks)
  : m_Root(root)
  , m_Name(name)
  , m_FollowsLinks(followsLinks)
{
  const nlohmann::json metadata = ReadZarrMetadata(root, name / ".zarray", followsLinks);
  if (metadata.value("zarr_format", nlohmann::json()) != 2)
  {
    this->Refuse("its zarr_format is not 2, the only one that is read; write it in that format");
  }
  if (metadata.value("order", nlohmann::json()) != "C")
  {
    this->Refuse("its values are not in the order C, the only one that is read; write it in that order");
  }
  const nlohmann::json filters = metadata.value("filters", nlohmann::json());
  if (!filters.is_null() && !filters.empty())
  {
    this->Refuse("its values went through filters, which are not supported; write it without filters");
  }
  const nlohmann::json separator = metadata.value("dimension_separator", nlohmann::json("."));
  if (separator != "." && separator != "/")
  {
    this->Refuse("its dimension_separator is neither '.' nor '/'; copy it again from its source");
  }
  m_Separator = separator.get<std::string>();
  this->TakeType(metadata);
  this->TakeFill(metadata);
  this->TakeCodec(metadata);
  this->TakeSizes(metadata);
}

void
ZarrArray::TakeType(const nlohmann::json & metadata)
{
  static const std::map<std::string, ZarrType> types{ { "u1", std::uint8_t() },  { "i1", std::int8_t() },
                                                      { "u2", std::uint16_t() }, { "i2", std::int16_t() },
                                                      { "u4", std::uint32_t() }, { "i4", std::int32_t() },
                                                      { "u8", std::uint64_t() }, { "i8", std::int64_t() },
                                                      { "f4", float() },         { "f8", double() } };
  const nlohmann::json dtype = metadata.value("dtype", nlohmann::json());
  const std::string text = dtype.is_string() ? dtype.get<std::string>() : "";
  const auto found = text.empty() ? types.end() : types.find(text.substr(1));
  if (found == types.end())
  {
    this->Refuse("its values are not of a supported type; convert them to integers or floats first");
  }
  m_Type = found->second;
  m_ValueSize = std::visit([](auto value) { return sizeof(value); }, m_Type);
  const bool isBig = text[0] == '>';
  if (!isBig && text[0] != '<' && !(text[0] == '|' && m_ValueSize == 1))
  {
    this->Refuse("it does not say in which byte order its values are; copy it again from its source");
  }
  m_IsSwapped = m_ValueSize > 1 && isBig != itk::ByteSwapper<int>::SystemIsBigEndian();
}

void
ZarrArray::TakeFill(const nlohmann::json & metadata)
{
  const nlohmann::json fill = metadata.value("fill_value", nlohmann::json());
  bool isValid = false;
  m_Fill = std::visit([&](auto value) { return FillBytes<decltype(value)>(fill, isValid); }, m_Type);
  if (!isValid)
  {
    this->Refuse("its fill_value is none of the values that its type has; copy it again from its source");
  }
}

void
ZarrArray::TakeCodec(const nlohmann::json & metadata)
{
  static const std::vector<std::string> codecs{ "blosc", "zlib", "gzip", "zstd" };
  const nlohmann::json compressor = metadata.value("compressor", nlohmann::json());
  const nlohmann::json id = compressor.is_object() ? compressor.value("id", nlohmann::json()) : nlohmann::json();
  m_Encoding = compressor.is_null() ? "raw" : id.is_string() ? id.get<std::string>() : "";
  if (!compressor.is_null() && std::find(codecs.begin(), codecs.end(), m_Encoding) == codecs.end())
  {
    this->Refuse("the compressor of its chunks is not supported; write it with " + Enumerate(codecs) +
                 ", or without a compressor");
  }
}

void
ZarrArray::TakeSizes(const nlohmann::json & metadata)
{
  const auto take = [&](const char * field, ZarrNumbers & numbers) {
    const nlohmann::json sizes = metadata.value(field, nlohmann::json());
    const auto isSize = [](const nlohmann::json & size) {
      return size.is_number_unsigned() && size.get<std::uint64_t>() > 0 && size.get<std::uint64_t>() <= LongestAxis;
    };
    if (!sizes.is_array() || sizes.empty() || sizes.size() > MostZarrAxes ||
        !std::all_of(sizes.begin(), sizes.end(), isSize))
    {
      this->Refuse(std::string("its ") + field +
                   " is not made of one to five numbers of at least 1; copy it again "
                   "from its source");
    }
    numbers.fill(1);
    std::transform(sizes.begin(), sizes.end(), numbers.end() - sizes.size(), [](const nlohmann::json & size) {
      return size.get<std::size_t>();
    });
    return sizes.size();
  };
  m_NumberOfAxes = take("shape", m_Shape);
  if (take("chunks", m_Chunk) != m_NumberOfAxes)
  {
    this->Refuse("its shape and its chunks have different numbers of axes; copy it again from its source");
  }
  const auto values = BoundedProduct(m_Chunk, MostValues / m_ValueSize);
  if (!BoundedProduct(m_Shape, MostValues / m_ValueSize) || !values)
  {
    this->Refuse("its shape or its chunks are larger than any volume; copy it again from its source");
  }
  if (m_Encoding != "raw" && *values * m_ValueSize > LargestPackedChunk)
  {
    this->Refuse("its compressed chunks are larger than 512 MiB each, which is not supported; write smaller ones");
  }
  const auto touched = this->FindTouched({}, m_Shape);
  if (!BoundedProduct(touched.second, MostChunks))
  {
    this->Refuse("it has more than 16,777,216 chunks, which is not supported; write larger ones");
  }
}

void
ZarrArray::Refuse(const std::string & why) const
{
  RefuseZarr(m_Root / m_Name / ".zarray", why);
}

std::size_t
ZarrArray::GetChunkBytes() const
{
  return *BoundedProduct(m_Chunk, MostValues) * m_ValueSize;
}

std::uintmax_t
ZarrArray::GetWorkingMemory() const
{
  const std::uintmax_t threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  const std::uintmax_t plane = m_Chunk[MostZarrAxes - 2] * m_Chunk[MostZarrAxes - 1] * m_ValueSize;
  const std::uintmax_t slot = 2 * this->GetChunkBytes(); // of a child process
  return threads * (m_Encoding == "raw" ? plane : slot);
}

std::pair<ZarrNumbers, ZarrNumbers>
ZarrArray::FindTouched(const ZarrNumbers & begin, const ZarrNumbers & size) const
{
  std::pair<ZarrNumbers, ZarrNumbers> touched;
  for (std::size_t axis = 0; axis < MostZarrAxes; ++axis)
  {
    touched.first[axis] = begin[axis] / m_Chunk[axis];
    touched.second[axis] =
      size[axis] == 0 ? 0 : (begin[axis] + size[axis] - 1) / m_Chunk[axis] - touched.first[axis] + 1;
  }
  return touched;
}

ZarrArray::Part
ZarrArray::FindPart(std::size_t n, const ZarrNumbers & begin, const ZarrNumbers & size) const
{
  const auto [first, count] = this->FindTouched(begin, size);
  Part part;
  for (std::size_t axis = MostZarrAxes; axis-- > 0; n /= count[axis])
  {
    part.chunk[axis] = first[axis] + n % count[axis];
    const std::size_t chunkBegin = part.chunk[axis] * m_Chunk[axis];
    const std::size_t low = std::max(begin[axis], chunkBegin);
    part.inChunk[axis] = low - chunkBegin;
    part.inRegion[axis] = low - begin[axis];
    part.size[axis] = std::min(begin[axis] + size[axis], chunkBegin + m_Chunk[axis]) - low;
  }
  return part;
}

fs::path
ZarrArray::NameOf(const ZarrNumbers & chunk) const
{
  std::string name;
  for (std::size_t axis = MostZarrAxes - m_NumberOfAxes; axis < MostZarrAxes; ++axis)
  {
    name += (name.empty() ? "" : m_Separator) + std::to_string(chunk[axis]);
  }
  return m_Name / name;
}

std::vector<fs::path>
ZarrArray::FindChunks(const ZarrNumbers & begin, const ZarrNumbers & size) const
{
  std::vector<fs::path> paths;
  const std::size_t count = BoundedProduct(this->FindTouched(begin, size).second, MostChunks).value_or(0);
  for (std::size_t n = 0; n < count; ++n)
  {
    const fs::path name = this->NameOf(this->FindPart(n, begin, size).chunk);
    if (ExistsInZarr(m_Root, name, m_FollowsLinks))
    {
      paths.push_back(m_Root / name);
    }
  }
  return paths;
}

void
ZarrArray::Read(const ZarrNumbers & begin,
                const ZarrNumbers & size,
                std::byte * buffer,
                const ProgressFunction & progress) const
{
  const ZarrNumbers touched = this->FindTouched(begin, size).second;
  const std::size_t count =
    std::count(touched.begin(), touched.end(), 0) > 0 ? 0 : *BoundedProduct(touched, MostChunks);
  ForEachOnThreads(
    count, [&](std::size_t n) { this->ReadPart(this->FindPart(n, begin, size), size, buffer); }, progress);
}

void
ZarrArray::ReadPart(const Part & part, const ZarrNumbers & size, std::byte * buffer) const
{
  const fs::path name = this->NameOf(part.chunk);
  const fs::path path = m_Root / name;
  if (!ExistsInZarr(m_Root, name, m_FollowsLinks))
  {
    if (!m_Fill)
    {
      RefuseZarr(path, "it is missing, and its array has no fill_value; copy the folder again from its source");
    }
    this->Fill(part, size, buffer);
    return;
  }
  m_Encoding == "raw" ? this->ReadRaw(path, part, size, buffer) : this->ReadPacked(path, part, size, buffer);
}

namespace
{

/** Calls \a use(place) for each row of a part, with the row's place in the part. */
template <typename TUse>
void
ForEachRow(const ZarrNumbers & size, const TUse & use)
{
  ZarrNumbers place{};
  std::size_t rows = 1;
  std::for_each(size.begin(), size.end() - 1, [&rows](std::size_t length) { rows *= length; });
  for (std::size_t row = 0; row < rows; ++row)
  {
    std::size_t rest = row;
    for (std::size_t axis = MostZarrAxes - 1; axis-- > 0; rest /= size[axis])
    {
      place[axis] = rest % size[axis];
    }
    use(place);
  }
}

ZarrNumbers
Sum(ZarrNumbers a, const ZarrNumbers & b)
{
  std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<>());
  return a;
}

} // namespace

void
ZarrArray::ReadRaw(const fs::path & path, const Part & part, const ZarrNumbers & size, std::byte * buffer) const
{
  const RawChunk file(path);
  file.RequireSize(this->GetChunkBytes());
  const std::size_t rowBytes = part.size.back() * m_ValueSize;
  const std::size_t step = m_Chunk.back() * m_ValueSize;
  const std::size_t rows = part.size[MostZarrAxes - 2];
  std::vector<std::byte> plane((rows - 1) * step + rowBytes);
  ForEachRow(part.size, [&](const ZarrNumbers & place) {
    const std::size_t row = place[MostZarrAxes - 2];
    if (row == 0)
    {
      file.Read(plane.data(), plane.size(), PositionIn(m_Chunk, Sum(part.inChunk, place)) * m_ValueSize);
    }
    std::byte * const target = buffer + PositionIn(size, Sum(part.inRegion, place)) * m_ValueSize;
    std::memcpy(target, plane.data() + row * step, rowBytes);
    if (m_IsSwapped)
    {
      ReverseValues(target, rowBytes, m_ValueSize);
    }
  });
}

void
ZarrArray::ReadPacked(const fs::path & path, const Part & part, const ZarrNumbers & size, std::byte * buffer) const
{
  SandboxRun run({ "rhombic-unpack-chunk", path, m_Encoding, this->GetChunkBytes() });
  const auto piece = run.Next();
  if (!piece || piece->size != this->GetChunkBytes())
  {
    RefuseZarr(path, "its decoder gave another number of bytes than a chunk has; copy it again from its source");
  }
  const std::size_t rowBytes = part.size.back() * m_ValueSize;
  ForEachRow(part.size, [&](const ZarrNumbers & place) {
    std::byte * const target = buffer + PositionIn(size, Sum(part.inRegion, place)) * m_ValueSize;
    std::memcpy(target, piece->data + PositionIn(m_Chunk, Sum(part.inChunk, place)) * m_ValueSize, rowBytes);
    if (m_IsSwapped)
    {
      ReverseValues(target, rowBytes, m_ValueSize);
    }
  });
  run.Next(); // nothing; the child is kept for other chunks
}

void
ZarrArray::Fill(const Part & part, const ZarrNumbers & size, std::byte * buffer) const
{
  ForEachRow(part.size, [&](const ZarrNumbers & place) {
    std::byte * target = buffer + PositionIn(size, Sum(part.inRegion, place)) * m_ValueSize;
    for (std::size_t n = 0; n < part.size.back(); ++n)
    {
      target = std::copy(m_Fill->begin(), m_Fill->end(), target);
    }
  });
}

} // namespace rhombic
