#ifndef rhombicDicomTestFile_h
#define rhombicDicomTestFile_h

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

/** \class DicomTestDataSet
 * \brief Elements of a DICOM data set, any of which can be wrong or left out. Values are given in little endian. */
class DicomTestDataSet
{
public:
  void
  SetText(std::uint32_t tag, const std::string & representation, std::string text)
  {
    if (text.size() % 2 != 0)
    {
      text += representation == "UI" ? '\0' : ' ';
    }
    m_Elements[tag] = { representation, text, false };
  }

  void
  SetShort(std::uint32_t tag, std::uint16_t value)
  {
    m_Elements[tag] = { "US", LittleEndian(value, 2), false };
  }

  void
  SetItems(std::uint32_t tag, const std::vector<DicomTestDataSet> & items)
  {
    std::string bytes;
    for (const DicomTestDataSet & item : items)
    {
      const std::string content = Encode(item.m_Elements);
      bytes += LittleEndian(0xe000fffe, 4) + LittleEndian(static_cast<std::uint32_t>(content.size()), 4) + content;
    }
    m_Elements[tag] = { "SQ", bytes, false };
  }

  void
  SetLongBytes(std::uint32_t tag, const std::string & bytes, const std::string & representation = "OB")
  {
    m_Elements[tag] = { representation, bytes, false };
  }

  void
  Remove(std::uint32_t tag)
  {
    m_Elements.erase(tag);
  }

protected:
  struct Element
  {
    std::string representation;
    std::string value;
    bool hasNoLength = false;
  };

  static std::string
  Even(const std::string & text)
  {
    return text.size() % 2 == 0 ? text : text + '\0';
  }

  static std::string
  LittleEndian(std::uint32_t value, std::size_t size)
  {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i)
    {
      bytes += static_cast<char>(value >> 8 * i & 255);
    }
    return bytes;
  }

  /** Sequences stay in little endian. */
  static std::string
  Encode(const std::map<std::uint32_t, Element> & elements, bool isBigEndian = false)
  {
    const auto number = [isBigEndian](std::uint32_t value, std::size_t size) {
      std::string bytes = LittleEndian(value, size);
      return isBigEndian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
    };
    std::string bytes;
    for (const auto & [tag, element] : elements)
    {
      bytes += number(tag >> 16, 2) + number(tag & 0xffff, 2) + element.representation;
      const std::string & type = element.representation;
      const bool isLong = type == "OB" || type == "OW" || type == "SQ";
      const auto length = element.hasNoLength ? 0xffffffff : static_cast<std::uint32_t>(element.value.size());
      bytes += (isLong ? std::string(2, '\0') : "") + number(length, isLong ? 4 : 2);
      std::string value = element.value;
      for (std::size_t n = 0; n + 1 < value.size() && isBigEndian && (type == "US" || type == "OW"); n += 2)
      {
        std::swap(value[n], value[n + 1]);
      }
      bytes += value;
    }
    return bytes;
  }

  std::map<std::uint32_t, Element> m_Elements;
};

/** \class DicomTestFile
 * \brief A DICOM slice in explicit encoding, written byte by byte. */
class DicomTestFile : public DicomTestDataSet
{
public:
  /** A CT slice with all that a volume needs, at the origin, along the axes, 1 mm pixels, 16 bits, values 0. */
  DicomTestFile(std::uint16_t columns, std::uint16_t rows)
  {
    this->SetText(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
    this->SetText(0x00080018, "UI", "1.2.3.4");
    this->SetText(0x00080060, "CS", "CT");
    this->SetText(0x00100010, "PN", "Secret^Name");
    this->SetText(0x0020000d, "UI", "1.2.3");
    this->SetText(0x0020000e, "UI", "1.2.3.5");
    this->SetSeries("1.2.3.4.5", "7");
    this->SetPosition("0\\0\\0");
    this->SetOrientation("1\\0\\0\\0\\1\\0");
    this->SetShort(0x00280002, 1);
    this->SetText(0x00280004, "CS", "MONOCHROME2");
    this->SetShort(0x00280010, rows);
    this->SetShort(0x00280011, columns);
    this->SetText(0x00280030, "DS", "1\\1");
    this->SetShort(0x00280100, 16);
    this->SetShort(0x00280101, 16);
    this->SetShort(0x00280102, 15);
    this->SetShort(0x00280103, 1);
    this->SetText(0x00281052, "DS", "-1024");
    this->SetText(0x00281053, "DS", "1");
    this->SetPixels(std::vector<std::int16_t>(static_cast<std::size_t>(columns) * rows));
  }

  void
  SetSeries(const std::string & uid, const std::string & number)
  {
    this->SetText(0x0020000e, "UI", uid);
    this->SetText(0x00200011, "IS", number);
  }

  void
  SetPosition(const std::string & position)
  {
    this->SetText(0x00200032, "DS", position);
  }

  void
  SetOrientation(const std::string & orientation)
  {
    this->SetText(0x00200037, "DS", orientation);
  }

  template <typename TPixel>
  void
  SetPixels(const std::vector<TPixel> & pixels)
  {
    std::string bytes;
    for (const TPixel pixel : pixels)
    {
      bytes += LittleEndian(static_cast<std::uint32_t>(pixel), sizeof(TPixel));
    }
    m_Elements[0x7fe00010] = { sizeof(TPixel) == 1 ? "OB" : "OW", bytes, false };
  }

  /** Compressed pixels; written with the transfer syntax of their kind. */
  void
  SetFragments(const std::vector<std::string> & fragments)
  {
    std::string bytes = LittleEndian(0xe000fffe, 4) + LittleEndian(0, 4);
    for (const std::string & fragment : fragments)
    {
      const std::string even = Even(fragment);
      bytes += LittleEndian(0xe000fffe, 4) + LittleEndian(static_cast<std::uint32_t>(even.size()), 4) + even;
    }
    m_Elements[0x7fe00010] = { "OB", bytes + LittleEndian(0xe0ddfffe, 4) + LittleEndian(0, 4), true };
  }

  /** A sequence whose one item holds a sequence, and so on. */
  void
  SetNestedSequences(std::uint32_t tag, int depth)
  {
    const std::string begin = LittleEndian(tag >> 16, 2) + LittleEndian(tag & 0xffff, 2) + "SQ" + std::string(2, '\0') +
                              LittleEndian(0xffffffff, 4);
    const std::string item = LittleEndian(0xe000fffe, 4) + LittleEndian(0xffffffff, 4);
    std::string bytes;
    for (int level = 0; level < depth; ++level)
    {
      bytes += item + begin;
    }
    for (int level = 0; level < depth; ++level)
    {
      bytes += LittleEndian(0xe0ddfffe, 4) + LittleEndian(0, 4) + LittleEndian(0xe00dfffe, 4) + LittleEndian(0, 4);
    }
    m_Elements[tag] = { "SQ", bytes, false };
  }

  void
  Write(const std::filesystem::path & path, const std::string & transferSyntax = "1.2.840.10008.1.2.1") const
  {
    const std::map<std::uint32_t, Element> meta{ { 0x00020001, { "OB", std::string("\0\1", 2), false } },
                                                 { 0x00020002, { "UI", Even("1.2.840.10008.5.1.4.1.1.2"), false } },
                                                 { 0x00020003, { "UI", Even("1.2.3.4"), false } },
                                                 { 0x00020010, { "UI", Even(transferSyntax), false } },
                                                 { 0x00020012, { "UI", Even("1.2.3.6"), false } } };
    const std::string metaBytes = Encode(meta);
    const std::map<std::uint32_t, Element> length{
      { 0x00020000, { "UL", LittleEndian(static_cast<std::uint32_t>(metaBytes.size()), 4), false } }
    };
    std::ofstream file(path, std::ios::binary);
    file << std::string(128, '\0') << "DICM" << Encode(length) << metaBytes
         << Encode(m_Elements, transferSyntax == "1.2.840.10008.1.2.2");
  }
};

#endif
