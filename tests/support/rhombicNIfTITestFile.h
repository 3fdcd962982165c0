#ifndef rhombicNIfTITestFile_h
#define rhombicNIfTITestFile_h

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <zlib.h>

/** A NIfTI file to write as a test needs it, right or wrong: 3x2x2 int16 by default, with the values 0 to 11. */
struct NIfTITestFile
{
  int version = 1;
  bool isBigEndian = false;
  std::string magic; ///< empty: as the version has it
  std::vector<std::int64_t> dimensions{ 3, 3, 2, 2, 1, 1, 1, 1 };
  int datatype = 4;
  int bits = 16;
  int intent = 0;
  std::array<double, 4> pixdim{ 1, 1, 1, 1 };
  double offset = -1; ///< below 0: behind the header
  double slope = 0;
  double intercept = 0;
  int units = 2;
  int qformCode = 0;
  int sformCode = 1;
  std::array<double, 3> quaternion{ 0, 0, 0 };
  std::array<double, 3> qformOffset{ 0, 0, 0 };
  std::array<double, 12> sform{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 };
  std::string voxels; ///< empty: the values 0 to 11 (or as many as there are) of the datatype

  template <typename TValue>
  void
  Append(std::string & bytes, TValue value) const
  {
    char text[sizeof(TValue)];
    std::memcpy(text, &value, sizeof(TValue));
    if (isBigEndian)
    {
      std::reverse(text, text + sizeof(TValue));
    }
    bytes.append(text, sizeof(TValue));
  }

  template <typename TValue>
  std::string
  Values(std::vector<TValue> values) const
  {
    std::string bytes;
    for (const TValue value : values)
    {
      this->Append(bytes, value);
    }
    return bytes;
  }

  std::string
  Header() const
  {
    return version == 1 ? this->HeaderOf<float, std::int16_t>() : this->Header2();
  }

  std::string
  Voxels() const
  {
    if (!voxels.empty())
    {
      return voxels;
    }
    std::vector<std::int16_t> values;
    std::int64_t count = 1;
    for (std::size_t i = 1; i < dimensions.size(); ++i)
    {
      count *= std::clamp<std::int64_t>(dimensions[i], 1, 10); // of headers that lie too
    }
    for (std::int64_t i = 0; i < count; ++i)
    {
      values.push_back(static_cast<std::int16_t>(i));
    }
    return this->Values(values);
  }

  /** The bytes of a single file. */
  std::string
  Bytes() const
  {
    return this->Header() + std::string(4, '\0') + this->Voxels();
  }

private:
  template <typename TFloat, typename TDimension>
  std::string
  HeaderOf() const
  {
    std::string bytes;
    this->Append(bytes, std::int32_t(348));
    bytes.resize(40);
    for (const auto dimension : dimensions)
    {
      this->Append(bytes, static_cast<TDimension>(dimension));
    }
    bytes.resize(68);
    this->Append(bytes, static_cast<std::int16_t>(intent));
    this->Append(bytes, static_cast<std::int16_t>(datatype));
    this->Append(bytes, static_cast<std::int16_t>(bits));
    bytes.resize(76);
    for (const double size : pixdim)
    {
      this->Append(bytes, static_cast<TFloat>(size));
    }
    bytes.resize(108);
    this->Append(bytes, static_cast<TFloat>(offset < 0 ? 352 : offset));
    this->Append(bytes, static_cast<TFloat>(slope));
    this->Append(bytes, static_cast<TFloat>(intercept));
    bytes.resize(123);
    bytes.push_back(static_cast<char>(units));
    bytes.resize(252);
    this->Append(bytes, static_cast<std::int16_t>(qformCode));
    this->Append(bytes, static_cast<std::int16_t>(sformCode));
    for (const double value : quaternion)
    {
      this->Append(bytes, static_cast<TFloat>(value));
    }
    for (const double value : qformOffset)
    {
      this->Append(bytes, static_cast<TFloat>(value));
    }
    for (const double value : sform)
    {
      this->Append(bytes, static_cast<TFloat>(value));
    }
    bytes.resize(344);
    bytes += magic.empty() ? std::string("n+1\0", 4) : magic;
    return bytes;
  }

  std::string
  Header2() const
  {
    std::string bytes;
    this->Append(bytes, std::int32_t(540));
    bytes += magic.empty() ? std::string("n+2\0\r\n\x1a\n", 8) : magic;
    this->Append(bytes, static_cast<std::int16_t>(datatype));
    this->Append(bytes, static_cast<std::int16_t>(bits));
    for (const auto dimension : dimensions)
    {
      this->Append(bytes, dimension);
    }
    bytes.resize(104);
    for (const double size : pixdim)
    {
      this->Append(bytes, size);
    }
    bytes.resize(168);
    this->Append(bytes, static_cast<std::int64_t>(offset < 0 ? 544 : offset));
    this->Append(bytes, slope);
    this->Append(bytes, intercept);
    bytes.resize(344);
    this->Append(bytes, std::int32_t(qformCode));
    this->Append(bytes, std::int32_t(sformCode));
    for (const double value : quaternion)
    {
      this->Append(bytes, value);
    }
    for (const double value : qformOffset)
    {
      this->Append(bytes, value);
    }
    for (const double value : sform)
    {
      this->Append(bytes, value);
    }
    bytes.resize(500);
    this->Append(bytes, std::int32_t(units));
    this->Append(bytes, std::int32_t(intent));
    bytes.resize(540);
    return bytes;
  }
};

inline std::filesystem::path
WriteBytes(const std::filesystem::path & path, const std::string & bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/** The bytes as a gzip stream. */
inline std::string
Gzipped(const std::string & bytes)
{
  z_stream stream{};
  constexpr int gzip = 15 + 16;
  deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, bytes.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef *>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

#endif
