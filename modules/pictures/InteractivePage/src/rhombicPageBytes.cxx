#include "rhombicPageBytes.h"

#include "rhombicFailure.h"

#include <zlib.h>

#include <cstdint>
#include <limits>
#include <stdexcept>

namespace rhombic
{

std::string
ToBase64(std::string_view bytes)
{
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byteAt = [&bytes](std::size_t n) {
    return n < bytes.size() ? static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[n])) : 0u;
  };
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t n = 0; n < bytes.size(); n += 3)
  {
    const std::uint32_t word = byteAt(n) << 16 | byteAt(n + 1) << 8 | byteAt(n + 2);
    text += digits[word >> 18];
    text += digits[word >> 12 & 63];
    text += n + 1 < bytes.size() ? digits[word >> 6 & 63] : '=';
    text += n + 2 < bytes.size() ? digits[word & 63] : '=';
  }
  return text;
}

std::string
HashToBase64(std::string_view hexadecimal)
{
  std::string bytes;
  for (std::size_t n = 0; n + 1 < hexadecimal.size(); n += 2)
  {
    bytes += static_cast<char>(std::stoi(std::string(hexadecimal.substr(n, 2)), nullptr, 16));
  }
  return ToBase64(bytes);
}

std::string
Deflate(std::string_view bytes, DeflateSearch search)
{
  constexpr int level = 9;
  constexpr int windowBits = 15;
  constexpr int memoryLevel = 9;
  const int strategy = search == DeflateSearch::Runs ? Z_RLE : Z_DEFAULT_STRATEGY;
  z_stream stream{};
  if (bytes.size() > std::numeric_limits<uInt>::max() ||
      deflateInit2(&stream, level, Z_DEFLATED, windowBits, memoryLevel, strategy) != Z_OK)
  {
    throw Failure(FailureKind::Memory, "There is too little memory to compress a part of the page.");
  }
  std::string compressed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(bytes.data())); // zlib does not change the input
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef *>(compressed.data());
  stream.avail_out = static_cast<uInt>(compressed.size());
  const int result = deflate(&stream, Z_FINISH);
  compressed.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != Z_STREAM_END)
  {
    throw std::logic_error("A part of the page could not be compressed.");
  }
  return compressed;
}

std::string
EscapeHtml(std::string_view text)
{
  std::string escaped;
  for (const char letter : text)
  {
    switch (letter)
    {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += letter;
    }
  }
  return escaped;
}

std::string
EscapeJsonInHtml(const std::string & json)
{
  std::string escaped;
  for (const char letter : json)
  {
    escaped += letter == '<' ? std::string("\\u003c") : letter == '>' ? std::string("\\u003e") : std::string(1, letter);
  }
  return escaped;
}

} // namespace rhombic
