#include "rhombicVTPNumbers.h"

#include "rhombicMemoryBudget.h"
#include "rhombicWords.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <zlib.h>

namespace rhombic
{
namespace
{

/** The six bits of a letter of base64 (RFC 4648), or 64. */
unsigned int
SixBits(char letter)
{
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  return static_cast<unsigned int>(std::min(letters.find(letter), std::size_t{ 64 }));
}

/** \class EncodedBytes
 * \brief The bytes of an array as the file holds them: raw or as base64, in the file or in its XML. */
class EncodedBytes
{
public:
  EncodedBytes(const InputFile & file, const VTPDocument & document, const VTPArray & array)
    : m_File(file)
    , m_IsAppended(array.format == "appended")
    , m_IsBase64(!m_IsAppended || document.isBase64)
  {
    if (m_IsAppended)
    {
      if (document.appendedAt == 0 || array.offset > file.GetSize() - document.appendedAt)
      {
        this->RefuseEnd();
      }
      m_Place = document.appendedAt + array.offset;
    }
    else
    {
      std::copy_if(array.text.begin(), array.text.end(), std::back_inserter(m_Text), [](char letter) {
        return Trimmed({ &letter, 1 }).size() == 1;
      });
    }
  }

  bool
  IsRaw() const
  {
    return !m_IsBase64;
  }

  std::uint64_t
  GetPlace() const
  {
    return m_Place;
  }

  /** The next \a size bytes, which are encoded on their own. */
  std::string
  Take(std::uint64_t size)
  {
    std::string bytes = this->Peek(size);
    m_Place += this->EncodedSize(size);
    return bytes;
  }

  /** The same without going on. */
  std::string
  Peek(std::uint64_t size) const
  {
    const std::uint64_t end = m_IsAppended ? m_File.GetSize() : m_Text.size();
    if (size > end || this->EncodedSize(size) > end - m_Place)
    {
      this->RefuseEnd();
    }
    std::string encoded(this->EncodedSize(size), '\0');
    m_IsAppended ? m_File.Read(m_Place, encoded.data(), encoded.size())
                 : static_cast<void>(m_Text.copy(encoded.data(), encoded.size(), m_Place));
    return m_IsBase64 ? this->Decode(encoded, size) : encoded;
  }

private:
  std::uint64_t
  EncodedSize(std::uint64_t size) const
  {
    return m_IsBase64 ? (size + 2) / 3 * 4 : size;
  }

  std::string
  Decode(const std::string & text, std::uint64_t size) const
  {
    std::string bytes;
    bytes.reserve(size + 2);
    for (std::size_t n = 0; n + 4 <= text.size(); n += 4)
    {
      std::uint32_t bits = 0;
      for (std::size_t letter = n; letter < n + 4; ++letter)
      {
        const unsigned int six = text[letter] == '=' ? 0 : SixBits(text[letter]);
        if (six == 64)
        {
          m_File.Refuse("its base64 is damaged; export it again");
        }
        bits = bits << 6 | six;
      }
      bytes += static_cast<char>(bits >> 16);
      bytes += static_cast<char>(bits >> 8);
      bytes += static_cast<char>(bits);
    }
    bytes.resize(size);
    return bytes;
  }

  [[noreturn]] void
  RefuseEnd() const
  {
    m_File.Refuse("it ends before its arrays do; it may be a part of a file, so copy or export it again");
  }

  const InputFile & m_File;
  bool m_IsAppended;
  bool m_IsBase64;
  std::string m_Text; ///< in the XML, without blanks
  std::uint64_t m_Place = 0;
};

/** The sizes in front of arrays and blocks. */
class Sizes
{
public:
  Sizes(const VTPDocument & document)
    : m_IsBigEndian(document.isBigEndian)
    , m_Size(document.hasLongSizes ? 8 : 4)
  {}

  std::size_t
  GetSize() const
  {
    return m_Size;
  }

  std::uint64_t
  At(const std::string & bytes, std::size_t number) const
  {
    std::uint64_t size = 0;
    for (std::size_t n = 0; n < m_Size; ++n)
    {
      const auto byte = static_cast<unsigned char>(bytes[number * m_Size + (m_IsBigEndian ? n : m_Size - 1 - n)]);
      size = size << 8 | byte;
    }
    return size;
  }

private:
  bool m_IsBigEndian;
  std::size_t m_Size;
};

/** Bytes that zlib compressed in blocks of \a blockSize; the last may be shorter. */
std::string
Expand(const InputFile & file, EncodedBytes & encoded, const Sizes & sizes)
{
  constexpr std::uint64_t largestRatio = 1032; // of zlib
  constexpr std::size_t numbersBefore = 3;     // of blocks, their size, the last one's size if it is not full
  const std::uint64_t blocks = sizes.At(encoded.Peek(sizes.GetSize()), 0);
  if (blocks > file.GetSize())
  {
    file.Refuse("its compressed arrays are damaged; export it again");
  }
  const std::string header = encoded.Take((numbersBefore + blocks) * sizes.GetSize());
  const std::uint64_t blockSize = sizes.At(header, 1), lastSize = sizes.At(header, 2);
  std::string bytes;
  for (std::uint64_t n = 0; n < blocks; ++n)
  {
    if (sizes.At(header, numbersBefore + n) > file.GetSize())
    {
      file.Refuse("its compressed arrays are damaged; export it again");
    }
  }
  std::uint64_t compressedSize = 0;
  for (std::uint64_t n = 0; n < blocks; ++n)
  {
    compressedSize += sizes.At(header, numbersBefore + n);
  }
  const std::string compressed = encoded.Take(compressedSize);
  std::size_t place = 0;
  for (std::uint64_t n = 0; n < blocks; ++n)
  {
    const auto size = static_cast<std::size_t>(sizes.At(header, numbersBefore + n));
    const std::uint64_t expanded = n + 1 == blocks && lastSize > 0 ? lastSize : blockSize;
    if (expanded > largestRatio * size)
    {
      file.Refuse("its compressed arrays are damaged; export it again");
    }
    RequireMemory(bytes.size() + expanded, 0, "Reading " + file.GetPath().string());
    const std::size_t before = bytes.size();
    bytes.resize(before + expanded);
    uLongf written = expanded;
    if (uncompress(reinterpret_cast<Bytef *>(bytes.data() + before),
                   &written,
                   reinterpret_cast<const Bytef *>(compressed.data() + place),
                   size) != Z_OK ||
        written != expanded)
    {
      file.Refuse("its compressed arrays are damaged; export it again");
    }
    place += size;
  }
  return bytes;
}

} // namespace

VTPNumbers::VTPNumbers(const InputFile & file, const VTPDocument & document, const VTPArray & array)
  : m_File(file)
  , m_Type(ParseType(file, array))
  , m_IsBigEndian(document.isBigEndian)
  , m_IsText(array.format == "ascii")
  , m_Text(array.text)
{
  if (m_IsText)
  {
    return;
  }
  EncodedBytes encoded(file, document, array);
  const Sizes sizes(document);
  if (document.isCompressed)
  {
    m_Bytes = Expand(file, encoded, sizes);
    return;
  }
  const std::uint64_t size = sizes.At(encoded.Peek(sizes.GetSize()), 0);
  if (size > file.GetSize() - encoded.GetPlace())
  {
    file.Refuse("it ends before its arrays do; it may be a part of a file, so copy or export it again");
  }
  if (encoded.IsRaw())
  {
    const std::uint64_t begin = encoded.GetPlace() + sizes.GetSize();
    m_Stream.emplace(file, begin, begin + size);
  }
  else
  {
    m_Bytes = encoded.Take(sizes.GetSize() + size);
    m_Taken = sizes.GetSize();
  }
}

VTPNumbers::Type
VTPNumbers::ParseType(const InputFile & file, const VTPArray & array)
{
  constexpr std::array<std::string_view, 10> names{ "Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                                    "UInt32", "Int64", "UInt64", "Float32", "Float64" };
  const std::string_view name = array.type == "String" ? "UInt8" : std::string_view(array.type);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
  {
    file.Refuse("its array " + array.name + " has a type of number that VTP does not have; export it again");
  }
  return static_cast<Type>(found - names.begin());
}

std::size_t
VTPNumbers::GetTypeSize() const
{
  constexpr std::size_t sizes[]{ 1, 1, 2, 2, 4, 4, 8, 8, 4, 8 };
  return sizes[static_cast<std::size_t>(m_Type)];
}

std::uint64_t
VTPNumbers::GetRest() const
{
  return m_IsText   ? (m_Text.size() + 1) / 2
         : m_Stream ? m_Stream->GetRest() / this->GetTypeSize()
                    : (m_Bytes.size() - m_Taken) / this->GetTypeSize();
}

bool
VTPNumbers::HasMore() const
{
  return m_IsText ? !Trimmed(m_Text).empty() : this->GetRest() > 0;
}

template <typename TNumber>
double
VTPNumbers::TakeBinary()
{
  std::array<char, sizeof(TNumber)> bytes;
  if (m_Stream)
  {
    m_Stream->Take(bytes.data(), bytes.size());
  }
  else if (m_Bytes.size() - m_Taken < bytes.size())
  {
    m_File.Refuse("an array is shorter than it must be; the file is damaged, so export it again");
  }
  else
  {
    std::copy_n(m_Bytes.data() + m_Taken, bytes.size(), bytes.data());
    m_Taken += bytes.size();
  }
  if (m_IsBigEndian)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  TNumber number;
  std::memcpy(&number, bytes.data(), bytes.size());
  return static_cast<double>(number);
}

double
VTPNumbers::Take()
{
  if (m_IsText)
  {
    const auto number = ParseNumber<double>(TakeWord(m_Text));
    if (!number)
    {
      m_File.Refuse("an array has fewer numbers than it must have; the file is damaged, so export it again");
    }
    return *number;
  }
  switch (m_Type)
  {
    case Type::Int8:
      return this->TakeBinary<std::int8_t>();
    case Type::UInt8:
      return this->TakeBinary<std::uint8_t>();
    case Type::Int16:
      return this->TakeBinary<std::int16_t>();
    case Type::UInt16:
      return this->TakeBinary<std::uint16_t>();
    case Type::Int32:
      return this->TakeBinary<std::int32_t>();
    case Type::UInt32:
      return this->TakeBinary<std::uint32_t>();
    case Type::Int64:
      return this->TakeBinary<std::int64_t>();
    case Type::UInt64:
      return this->TakeBinary<std::uint64_t>();
    case Type::Float32:
      return this->TakeBinary<float>();
    default:
      return this->TakeBinary<double>();
  }
}

std::uint64_t
VTPNumbers::TakeWhole()
{
  constexpr double largest = 9007199254740992; // 2^53: all whole numbers below are doubles
  const double number = this->Take();
  if (!(number >= 0 && number < largest && number == std::floor(number)))
  {
    m_File.Refuse("an index or size is no whole number; the file is damaged, so export it again");
  }
  return static_cast<std::uint64_t>(number);
}

} // namespace rhombic
