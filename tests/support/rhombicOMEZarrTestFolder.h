#ifndef rhombicOMEZarrTestFolder_h
#define rhombicOMEZarrTestFolder_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <zlib.h>

namespace rhombictest
{

/** Bytes packed by zlib; with window bits of 31 as gzip. */
inline std::string
Deflated(const std::string & bytes, int windowBits)
{
  z_stream stream{};
  std::string packed(bytes.size() + bytes.size() / 100 + 100, '\0');
  if (deflateInit2(&stream, 5, Z_DEFLATED, windowBits, 8, Z_DEFAULT_STRATEGY) != Z_OK)
  {
    throw std::runtime_error("deflateInit2 failed");
  }
  stream.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef *>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/** A compressor of chunks: what .zarray holds of it, and the function. */
struct ZarrCodec
{
  std::string name;
  std::string json;
  std::function<std::string(const std::string &)> pack;
};

inline ZarrCodec
RawCodec()
{
  return { "raw", "null", [](const std::string & bytes) { return bytes; } };
}

inline std::vector<ZarrCodec>
DeflateCodecs()
{
  return { { "zlib", R"({"id": "zlib", "level": 5})", [](const std::string & bytes) { return Deflated(bytes, 15); } },
           { "gzip", R"({"id": "gzip", "level": 5})", [](const std::string & bytes) { return Deflated(bytes, 31); } } };
}

/** A folder of OME-Zarr of one level, which tests write: sizes are those of the axes of the array, the last one
 * fastest. */
struct OMEZarrTestFolder
{
  std::vector<std::size_t> shape{ 4, 5, 6 };
  std::vector<std::size_t> chunks{ 2, 3, 4 };
  std::string separator = "/";
  std::string fill = "0";
  bool isBigEndian = false;
  ZarrCodec codec = RawCodec();
  std::string axes = R"([{"name": "z", "type": "space", "unit": "micrometer"},
                         {"name": "y", "type": "space", "unit": "micrometer"},
                         {"name": "x", "type": "space", "unit": "micrometer"}])";
  std::string transformations = R"([{"type": "scale", "scale": [4, 3, 2]}])";
  std::string imageTransformations; ///< of all levels; empty for none
  std::string further;              ///< more members of the image, before the others

  static void
  WriteText(const std::filesystem::path & path, const std::string & text)
  {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
  }

  /** The metadata of an image whose levels have the names 0, 1, ... */
  std::string
  Attributes(std::size_t levels = 1) const
  {
    std::string datasets;
    for (std::size_t level = 0; level < levels; ++level)
    {
      datasets += (level > 0 ? ", " : "") + std::string(R"({"path": ")") + std::to_string(level) +
                  R"(", "coordinateTransformations": )" + transformations + "}";
    }
    return R"({"multiscales": [{)" + further + R"("version": "0.4", "axes": )" + axes + R"(, "datasets": [)" +
           datasets + "]" +
           (imageTransformations.empty() ? "" : R"(, "coordinateTransformations": )" + imageTransformations) + "}]}";
  }

  template <typename TValue>
  std::string
  Dtype() const
  {
    const std::string order = sizeof(TValue) == 1 ? "|" : isBigEndian ? ">" : "<";
    return order +
           (std::is_floating_point_v<TValue> ? "f"
            : std::is_signed_v<TValue>       ? "i"
                                             : "u") +
           std::to_string(sizeof(TValue));
  }

  template <typename TValue>
  std::string
  ArrayMetadata() const
  {
    const auto list = [](const std::vector<std::size_t> & numbers) {
      std::string text;
      for (const std::size_t number : numbers)
      {
        text += (text.empty() ? "[" : ", ") + std::to_string(number);
      }
      return text + "]";
    };
    return R"({"zarr_format": 2, "shape": )" + list(shape) + R"(, "chunks": )" + list(chunks) + R"(, "dtype": ")" +
           this->Dtype<TValue>() + R"(", "compressor": )" + codec.json + R"(, "fill_value": )" + fill +
           R"(, "order": "C", "filters": null, "dimension_separator": ")" + separator + R"("})";
  }

  /** The name of a chunk by its numbers along the axes. */
  std::string
  ChunkName(const std::vector<std::size_t> & numbers) const
  {
    std::string name;
    for (const std::size_t number : numbers)
    {
      name += (name.empty() ? "" : separator) + std::to_string(number);
    }
    return name;
  }

  /** Writes the chunks of an array, filled up by zeros at its ends, and its metadata. */
  template <typename TValue>
  void
  WriteArray(const std::filesystem::path & folder, const std::vector<TValue> & values) const
  {
    WriteText(folder / ".zarray", this->ArrayMetadata<TValue>());
    const std::size_t dimension = shape.size();
    std::vector<std::size_t> chunk(dimension, 0);
    for (bool isMore = true; isMore;)
    {
      WriteText(folder / this->ChunkName(chunk), codec.pack(this->BytesOfChunk(chunk, values)));
      std::size_t axis = dimension;
      do
      {
        --axis;
        chunk[axis] = (chunk[axis] + 1) * chunks[axis] < shape[axis] ? chunk[axis] + 1 : 0;
      } while (chunk[axis] == 0 && axis > 0);
      isMore = chunk != std::vector<std::size_t>(dimension, 0);
    }
  }

  /** Writes an image of one level, "0". */
  template <typename TValue>
  std::filesystem::path
  Write(const std::filesystem::path & folder, const std::vector<TValue> & values) const
  {
    WriteText(folder / ".zgroup", R"({"zarr_format": 2})");
    WriteText(folder / ".zattrs", this->Attributes());
    this->WriteArray(folder / "0", values);
    return folder;
  }

private:
  template <typename TValue>
  std::string
  BytesOfChunk(const std::vector<std::size_t> & chunk, const std::vector<TValue> & values) const
  {
    std::size_t count = 1;
    for (const std::size_t size : chunks)
    {
      count *= size;
    }
    std::string bytes(count * sizeof(TValue), '\0');
    for (std::size_t n = 0; n < count; ++n)
    {
      std::size_t rest = n, position = 0, stride = 1;
      bool isInside = true;
      for (std::size_t axis = shape.size(); axis-- > 0; rest /= chunks[axis])
      {
        const std::size_t place = chunk[axis] * chunks[axis] + rest % chunks[axis];
        isInside = isInside && place < shape[axis];
        position += place * stride;
        stride *= shape[axis];
      }
      if (isInside)
      {
        char * const target = bytes.data() + n * sizeof(TValue);
        std::memcpy(target, &values.at(position), sizeof(TValue));
        if (isBigEndian)
        {
          std::reverse(target, target + sizeof(TValue));
        }
      }
    }
    return bytes;
  }
};

} // namespace rhombictest

#endif
