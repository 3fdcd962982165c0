#include "rhombicDicomHeader.h"

#include "rhombicFiles.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <istream>

namespace rhombic
{
namespace
{

constexpr DicomTag Item = 0xfffee000;
constexpr DicomTag ItemEnd = 0xfffee00d;
constexpr DicomTag SequenceEnd = 0xfffee0dd;
constexpr DicomTag TransferSyntaxUID = 0x00020010;
constexpr std::uint32_t UndefinedLength = 0xffffffff;
constexpr std::uint16_t MetaGroup = 0x0002;
constexpr int DeepestSequence = 64;
constexpr std::size_t LongestValue = 1 << 16;
constexpr std::size_t MostElements = 1 << 24; // takes some seconds, for a file of zeros
constexpr std::size_t MostItems = 1 << 20;    // each takes at least 8 bytes of the file and a hundred of memory

#define RHOMBIC_TAKE(name, number) number,
#define RHOMBIC_LEAVE(name, number)
const std::set<DicomTag> WantedValues{ RHOMBIC_DICOM_TAGS(RHOMBIC_TAKE, RHOMBIC_LEAVE, RHOMBIC_LEAVE) };
const std::set<DicomTag> WantedSequences{ RHOMBIC_DICOM_TAGS(RHOMBIC_LEAVE, RHOMBIC_TAKE, RHOMBIC_LEAVE) };
#undef RHOMBIC_TAKE
#undef RHOMBIC_LEAVE

/** The encoding of the elements of a data set (PS3.5, 7.1). */
struct Encoding
{
  bool isExplicit = true; ///< whether each element names the type of its value
  bool isBigEndian = false;
};

struct Element
{
  DicomTag tag = 0;
  std::string representation; ///< "SQ", "DS", ...; empty when implicit
  std::uint32_t length = 0;
};

/** A defect of the header. Thrown and caught in this file only. */
struct Damage
{
  std::string what;
};

std::string
NameOf(DicomTag tag)
{
  char name[16];
  std::snprintf(name, sizeof(name), "(%04x,%04x)", tag >> 16, tag & 0xffff);
  return name;
}

bool
IsCapital(char letter)
{
  return letter >= 'A' && letter <= 'Z';
}

/** Whether a type has a length of four bytes, after two empty bytes. */
bool
HasLongLength(const std::string & representation)
{
  static const std::set<std::string> types{
    "OB", "OD", "OF", "OL", "OV", "OW", "SQ", "SV", "UC", "UN", "UR", "UT", "UV"
  };
  return types.count(representation) != 0;
}

/** Reads a file in large pieces: std::ifstream discards its buffer with each seek over an element. */
class Pieces
{
public:
  explicit Pieces(std::istream & file)
    : m_File(file)
  {}

  /** False when the file ends before \a count bytes. */
  bool
  Read(std::uintmax_t position, char * bytes, std::size_t count)
  {
    constexpr std::size_t pieceSize = 1 << 15;
    while (count > 0)
    {
      if (position < m_Begin || position >= m_Begin + m_Piece.size())
      {
        m_Piece.resize(pieceSize);
        m_Begin = position;
        m_File.clear();
        m_File.seekg(static_cast<std::streamoff>(position));
        m_File.read(m_Piece.data(), static_cast<std::streamsize>(m_Piece.size()));
        m_Piece.resize(static_cast<std::size_t>(std::max<std::streamsize>(m_File.gcount(), 0)));
        if (m_Piece.empty())
        {
          return false;
        }
      }
      const auto offset = static_cast<std::size_t>(position - m_Begin);
      const std::size_t available = std::min(count, m_Piece.size() - offset);
      std::memcpy(bytes, m_Piece.data() + offset, available);
      position += available;
      bytes += available;
      count -= available;
    }
    return true;
  }

private:
  std::istream & m_File;
  std::string m_Piece;
  std::uintmax_t m_Begin = 0;
};

class Parser
{
public:
  Parser(std::istream & file, std::uintmax_t size, const std::set<DicomTag> & wanted)
    : m_File(file)
    , m_Size(size)
    , m_Wanted(wanted)
  {}

  /** Reads from the beginning of a data set to its pixels or its end. */
  void
  ReadImageDataSet(DicomHeader & header, bool isBigEndian)
  {
    const Encoding encoding{ this->IsExplicit(isBigEndian), isBigEndian };
    header.dataSet.isBigEndian = isBigEndian;
    while (m_Position < m_Size)
    {
      const Element element = this->ReadElement(encoding);
      if (element.tag == DicomTags::PixelData)
      {
        header.hasPixels = true;
        header.pixels = { m_Position, element.length };
        header.hasWords = element.representation == "OW";
        header.isEncapsulated = element.length == UndefinedLength;
        if (header.isEncapsulated)
        {
          header.fragments = this->ReadFragments(encoding);
        }
        else
        {
          this->RefuseValuesAfter(element, encoding);
        }
        return;
      }
      this->ReadValue(element, encoding, 0, header.dataSet);
    }
  }

  /** The transfer syntax from the elements of group 2, which are always explicit little endian. */
  std::string
  ReadMetaInformation()
  {
    std::string transferSyntax;
    while (m_Position + 2 <= m_Size && this->Peek<std::uint16_t>() == MetaGroup)
    {
      const Element element = this->ReadElement(Encoding());
      const std::string value = this->ReadBytes(element, LongestValue);
      if (element.tag == TransferSyntaxUID)
      {
        transferSyntax = value.substr(0, value.find_last_not_of(std::string(" \0", 2)) + 1);
      }
    }
    return transferSyntax;
  }

  bool
  HasBytes(std::uintmax_t position, const std::string & expected)
  {
    std::string bytes(expected.size(), '\0');
    return m_File.Read(position, bytes.data(), bytes.size()) && bytes == expected;
  }

  void
  MoveTo(std::uintmax_t position)
  {
    if (position > m_Size)
    {
      throw Damage{ "its header ends too early" };
    }
    m_Position = position;
  }

  /** The next bytes, without moving on; 0 at the end of the file. */
  template <typename TNumber>
  TNumber
  Peek()
  {
    TNumber number{};
    if (m_Position + sizeof(number) <= m_Size)
    {
      m_File.Read(m_Position, reinterpret_cast<char *>(&number), sizeof(number));
    }
    return number;
  }

private:
  void
  Read(char * bytes, std::size_t count)
  {
    if (count > m_Size - m_Position || !m_File.Read(m_Position, bytes, count))
    {
      throw Damage{ "its header ends too early" };
    }
    m_Position += count;
  }

  template <typename TNumber>
  TNumber
  ReadNumber(bool isBigEndian)
  {
    char bytes[sizeof(TNumber)];
    this->Read(bytes, sizeof(bytes));
    return NumberAt<TNumber>({ bytes, sizeof(bytes) }, 0, isBigEndian);
  }

  /** Whether the next element names the type of its value. The transfer syntax may be wrong about it, also for single
   * items. */
  bool
  IsExplicit(bool isBigEndian)
  {
    const auto bytes = this->Peek<std::uint64_t>();
    char text[sizeof(bytes)];
    std::memcpy(text, &bytes, sizeof(bytes));
    return isBigEndian || (IsCapital(text[4]) && IsCapital(text[5]));
  }

  Element
  ReadElement(const Encoding & encoding)
  {
    if (++m_NumberOfElements > MostElements)
    {
      throw Damage{ "its header holds more than " + std::to_string(MostElements) + " elements" };
    }
    Element element;
    const auto group = this->ReadNumber<std::uint16_t>(encoding.isBigEndian);
    element.tag = DicomTag{ group } << 16 | this->ReadNumber<std::uint16_t>(encoding.isBigEndian);
    if (!encoding.isExplicit || element.tag == Item || element.tag == ItemEnd || element.tag == SequenceEnd)
    {
      element.length = this->ReadNumber<std::uint32_t>(encoding.isBigEndian);
      return element;
    }
    char type[2];
    this->Read(type, sizeof(type));
    element.representation.assign(type, sizeof(type));
    if (!IsCapital(type[0]) || !IsCapital(type[1]))
    {
      throw Damage{ "its element " + NameOf(element.tag) + " has a type that does not exist" };
    }
    if (HasLongLength(element.representation))
    {
      this->ReadNumber<std::uint16_t>(encoding.isBigEndian);
      element.length = this->ReadNumber<std::uint32_t>(encoding.isBigEndian);
    }
    else
    {
      element.length = this->ReadNumber<std::uint16_t>(encoding.isBigEndian);
    }
    return element;
  }

  std::uintmax_t
  EndOf(const Element & element) const
  {
    if (element.length > m_Size - m_Position)
    {
      throw Damage{ "its element " + NameOf(element.tag) + " claims " + std::to_string(element.length) +
                    " bytes, more than are left in the file" };
    }
    return m_Position + element.length;
  }

  /** Reads the value of an element unless it is longer than \a longest, and moves to its end. */
  std::string
  ReadBytes(const Element & element, std::size_t longest)
  {
    const std::uintmax_t end = this->EndOf(element);
    std::string bytes;
    if (element.length <= longest)
    {
      bytes.resize(element.length);
      this->Read(bytes.data(), bytes.size());
    }
    this->MoveTo(end);
    return bytes;
  }

  /** Throws Damage for values after native pixels, where none is looked for; signatures and padding may be there. */
  void
  RefuseValuesAfter(const Element & pixels, const Encoding & encoding)
  {
    DicomTag found = 0;
    try
    {
      for (this->MoveTo(this->EndOf(pixels)); m_Position < m_Size && found == 0;)
      {
        const Element element = this->ReadElement(encoding);
        found = m_Wanted.count(element.tag) + WantedSequences.count(element.tag) > 0 ? element.tag : 0;
        this->MoveTo(this->EndOf(element));
      }
    }
    catch (const Damage &)
    {
      return; // no elements, or pixels that are cut off, which is said elsewhere
    }
    if (found != 0)
    {
      throw Damage{ "its element " + NameOf(found) + " comes after the pixels, where it does not belong" };
    }
  }

  void
  ReadValue(const Element & element, const Encoding & encoding, int depth, DicomDataSet & dataSet)
  {
    const bool isUnknown = element.representation == "UN";
    if (element.length == UndefinedLength || element.representation == "SQ" ||
        ((element.representation.empty() || isUnknown) && WantedSequences.count(element.tag) != 0))
    {
      const Encoding inside = isUnknown ? Encoding{ false, false } : encoding;
      this->ReadSequence(element, inside, depth + 1, dataSet);
    }
    else if (m_Wanted.count(element.tag) != 0)
    {
      const std::string value = this->ReadBytes(element, LongestValue);
      if (dataSet.values.emplace(element.tag, value).first->second != value)
      {
        throw Damage{ "its element " + NameOf(element.tag) + " is there twice, with other values" };
      }
    }
    else
    {
      this->MoveTo(this->EndOf(element));
    }
  }

  void
  ReadSequence(const Element & sequence, const Encoding & encoding, int depth, DicomDataSet & dataSet)
  {
    const bool isWanted = WantedSequences.count(sequence.tag) != 0;
    const bool hasLength = sequence.length != UndefinedLength;
    const std::uintmax_t end = hasLength ? this->EndOf(sequence) : m_Size;
    if (hasLength && !isWanted)
    {
      this->MoveTo(end);
      return;
    }
    if (depth > DeepestSequence)
    {
      throw Damage{ "its sequences are nested more than " + std::to_string(DeepestSequence) + " deep" };
    }
    while (m_Position < end)
    {
      const Element item = this->ReadElement(encoding);
      if (item.tag == SequenceEnd)
      {
        return;
      }
      if (item.tag != Item)
      {
        throw Damage{ "its sequence " + NameOf(sequence.tag) + " holds something else than items" };
      }
      DicomDataSet content;
      this->ReadItem(item, encoding, depth, content);
      if (isWanted)
      {
        if (++m_NumberOfItems > MostItems)
        {
          throw Damage{ "its sequences hold more than " + std::to_string(MostItems) + " items" };
        }
        dataSet.sequences[sequence.tag].push_back(std::move(content));
      }
      if (hasLength && m_Position > end)
      {
        throw Damage{ "an item of its sequence " + NameOf(sequence.tag) + " is longer than the sequence" };
      }
    }
    if (!hasLength)
    {
      throw Damage{ "its sequence " + NameOf(sequence.tag) + " has no end" };
    }
  }

  void
  ReadItem(const Element & item, const Encoding & outside, int depth, DicomDataSet & dataSet)
  {
    const bool hasLength = item.length != UndefinedLength;
    const std::uintmax_t end = hasLength ? this->EndOf(item) : m_Size;
    const Encoding encoding{ outside.isExplicit && this->IsExplicit(outside.isBigEndian), outside.isBigEndian };
    dataSet.isBigEndian = encoding.isBigEndian;
    while (m_Position < end)
    {
      const Element element = this->ReadElement(encoding);
      if (element.tag == ItemEnd)
      {
        return;
      }
      this->ReadValue(element, encoding, depth, dataSet);
      if (hasLength && m_Position > end)
      {
        throw Damage{ "its element " + NameOf(element.tag) + " is longer than the item around it" };
      }
    }
    if (!hasLength)
    {
      throw Damage{ "an item of a sequence has no end" };
    }
  }

  std::vector<ByteRange>
  ReadFragments(const Encoding & encoding)
  {
    std::vector<ByteRange> fragments;
    bool isTable = true;
    while (m_Position < m_Size)
    {
      const Element item = this->ReadElement(encoding);
      if (item.tag == SequenceEnd)
      {
        return fragments;
      }
      if (item.tag != Item)
      {
        throw Damage{ "its compressed pixels turn into something else" };
      }
      const std::uintmax_t end = this->EndOf(item);
      if (!isTable)
      {
        fragments.push_back({ m_Position, item.length });
      }
      isTable = false;
      this->MoveTo(end);
    }
    throw Damage{ "its compressed pixels have no end" };
  }

  Pieces m_File;
  std::uintmax_t m_Size;
  const std::set<DicomTag> & m_Wanted;
  std::uintmax_t m_Position = 0;
  std::size_t m_NumberOfElements = 0;
  std::size_t m_NumberOfItems = 0; ///< items of the sequences that are kept
};

/** Whether a file without preamble begins as a data set: with an element of group 8 or 2. */
bool
LooksLikeDataSet(std::uint64_t start)
{
  char bytes[sizeof(start)];
  std::memcpy(bytes, &start, sizeof(start));
  const auto group = static_cast<unsigned char>(bytes[0]);
  const bool isTag = (group == 8 || group == 2) && bytes[1] == 0 && bytes[3] == 0;
  const bool isExplicit = IsCapital(bytes[4]) && IsCapital(bytes[5]);
  const bool isShortImplicit = bytes[6] == 0 && bytes[7] == 0 && bytes[5] == 0 && bytes[4] != 0;
  return isTag && (isExplicit || (group == 8 && isShortImplicit));
}

template <typename TNumber>
std::vector<TNumber>
NumbersIn(const std::string & bytes, bool isBigEndian)
{
  std::vector<TNumber> numbers;
  for (std::size_t offset = 0; offset + sizeof(TNumber) <= bytes.size(); offset += sizeof(TNumber))
  {
    numbers.push_back(NumberAt<TNumber>(bytes, offset, isBigEndian));
  }
  return numbers;
}

} // namespace

bool
DicomDataSet::Has(DicomTag tag) const
{
  return values.count(tag) != 0 || sequences.count(tag) != 0;
}

std::string
DicomDataSet::GetText(DicomTag tag) const
{
  const auto found = values.find(tag);
  std::string text = found == values.end() ? std::string() : found->second;
  const std::string padding(" \0", 2);
  text.erase(text.find_last_not_of(padding) + 1);
  text.erase(0, text.find_first_not_of(padding));
  return text;
}

std::vector<double>
DicomDataSet::GetDecimals(DicomTag tag) const
{
  std::vector<double> numbers;
  for (std::string part : Split(this->GetText(tag), "\\"))
  {
    part.erase(part.find_last_not_of(' ') + 1);
    part.erase(0, part.find_first_not_of(" +"));
    const auto number = ToNumber<double>(part);
    if (!number || !std::isfinite(*number))
    {
      return {};
    }
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<std::uint16_t>
DicomDataSet::GetShorts(DicomTag tag) const
{
  const auto found = values.find(tag);
  return found == values.end() ? std::vector<std::uint16_t>() : NumbersIn<std::uint16_t>(found->second, isBigEndian);
}

std::optional<std::uint16_t>
DicomDataSet::GetShort(DicomTag tag) const
{
  const auto numbers = this->GetShorts(tag);
  return numbers.empty() ? std::nullopt : std::optional<std::uint16_t>(numbers.front());
}

std::optional<double>
DicomDataSet::GetDouble(DicomTag tag) const
{
  const auto found = values.find(tag);
  const auto numbers = found == values.end() ? std::vector<double>() : NumbersIn<double>(found->second, isBigEndian);
  return numbers.empty() ? std::nullopt : std::optional<double>(numbers.front());
}

const std::vector<DicomDataSet> &
DicomDataSet::GetItems(DicomTag tag) const
{
  static const std::vector<DicomDataSet> none;
  const auto found = sequences.find(tag);
  return found == sequences.end() ? none : found->second;
}

const DicomDataSet &
DicomDataSet::GetItem(DicomTag tag) const
{
  static const DicomDataSet empty;
  const auto & items = this->GetItems(tag);
  return items.empty() ? empty : items.front();
}

std::optional<DicomHeader>
ParseDicomHeader(std::istream & file, std::uintmax_t fileSize, const std::set<DicomTag> & wanted)
{
  constexpr std::uintmax_t preamble = 128;
  const std::string magic = "DICM";
  const std::string bigEndian = "1.2.840.10008.1.2.2";
  const std::string deflated = "1.2.840.10008.1.2.1.99";

  DicomHeader header;
  header.fileSize = fileSize;
  Parser parser(file, fileSize, wanted.empty() ? WantedValues : wanted);
  const bool hasPreamble = parser.HasBytes(preamble, magic);
  if (!hasPreamble && !LooksLikeDataSet(parser.Peek<std::uint64_t>()))
  {
    return {};
  }
  try
  {
    parser.MoveTo(hasPreamble ? preamble + magic.size() : 0);
    header.transferSyntax = parser.ReadMetaInformation();
    if (header.transferSyntax != deflated)
    {
      parser.ReadImageDataSet(header, header.transferSyntax == bigEndian);
    }
  }
  catch (const Damage & damage)
  {
    header.damage = damage.what;
  }
  if (header.transferSyntax.empty() && header.dataSet.values.empty() && !header.hasPixels && header.damage.empty())
  {
    header.damage = "it ends before its header begins";
  }
  return header;
}

std::optional<DicomHeader>
ReadDicomHeader(const std::filesystem::path & path, const std::set<DicomTag> & wanted)
{
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file)
  {
    return {};
  }
  return ParseDicomHeader(file, size, wanted);
}

} // namespace rhombic
