#include "rhombicPageBytes.h"

#include "rhombicFailure.h"

#include <zlib.h>

#include <cstdint>

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
Deflate(std::string_view bytes)
{
  constexpr int level = 9;
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string stream(size, '\0');
  if (compress2(reinterpret_cast<Bytef *>(stream.data()),
                &size,
                reinterpret_cast<const Bytef *>(bytes.data()),
                static_cast<uLong>(bytes.size()),
                level) != Z_OK)
  {
    throw Failure(FailureKind::Memory, "There is too little memory to compress a part of the page.");
  }
  stream.resize(size);
  return stream;
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
