#include "rhombicVTPNumbers.h"

#include "rhombicWords.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <zlib.h>

namespace rhombic
{
namespace
{

/** The value of a letter of base64 (RFC 4648), or 64 if it is none. */
unsigned int
SixBits(char letter)
{
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  return static_cast<unsigned int>(std::min(letters.find(letter), std::size_t{ 64 }));
}

/** \class EncodedBytes
 * \brief Decodes the bytes of an array: raw or base64, appended to the XML or in it. */
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

  /** Takes the next \a size bytes, which are encoded by themselves. */
  std::string
  Take(std::uint64_t size)
  {
    std::string bytes = this->Peek(size);
    m_Place += this->EncodedSize(size);
    return bytes;
  }

  /** As Take(), but the bytes are not taken. */
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

/** Decodes the sizes in front of arrays and blocks. */
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

/** Expands an array that zlib has compressed in blocks of equal size; the last block may be shorter. */
std::string
Expand(const InputFile & file, EncodedBytes & encoded, const Sizes & sizes)
{
  constexpr std::uint64_t largestRatio = 1032; // largest ratio of zlib
  constexpr std::size_t numbersBefore = 3;     // number of blocks, block size, size of the last block if it is not full
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
    file.RequireMemoryToRead(bytes.size() + expanded);
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

NumberType
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
  return static_cast<NumberType>(found - names.begin());
}

std::uint64_t
VTPNumbers::GetRest() const
{
  return m_IsText   ? (m_Text.size() + 1) / 2
         : m_Stream ? m_Stream->GetRest() / SizeOf(m_Type)
                    : (m_Bytes.size() - m_Taken) / SizeOf(m_Type);
}

bool
VTPNumbers::HasMore() const
{
  return m_IsText ? !Trimmed(m_Text).empty() : this->GetRest() > 0;
}

void
VTPNumbers::TakeBytes(char * to, std::size_t size)
{
  if (m_Stream)
  {
    m_Stream->Take(to, size);
    return;
  }
  if (m_Bytes.size() - m_Taken < size)
  {
    m_File.RefuseDamaged("an array is shorter than it must be");
  }
  std::copy_n(m_Bytes.data() + m_Taken, size, to);
  m_Taken += size;
}

double
VTPNumbers::Take()
{
  if (m_IsText)
  {
    const auto number = ParseNumber<double>(TakeWord(m_Text));
    if (!number)
    {
      m_File.RefuseDamaged("an array has fewer numbers than it must have");
    }
    return *number;
  }
  return TakeNumber(m_Type, m_IsBigEndian, [this](char * to, std::size_t size) { this->TakeBytes(to, size); });
}

std::uint64_t
VTPNumbers::TakeWhole()
{
  constexpr double largest = 9007199254740992; // 2^53: all whole numbers below are doubles
  const double number = this->Take();
  if (!(number >= 0 && number < largest && number == std::floor(number)))
  {
    m_File.RefuseDamaged("an index or size is no whole number");
  }
  return static_cast<std::uint64_t>(number);
}

} // namespace rhombic
