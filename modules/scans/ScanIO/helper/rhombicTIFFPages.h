#ifndef rhombicTIFFPages_h
#define rhombicTIFFPages_h

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include <expat.h>

namespace rhombic
{

/** The pages of a TIFF file. */
struct TIFFPages
{
  std::size_t ofFirstSize = 0; ///< whose size is that of the first one
  std::size_t others = 0;      ///< as levels of a pyramid
};

/** \class TIFFNumbers
 * \brief The numbers of a TIFF or BigTIFF file, in its own order of bytes. */
class TIFFNumbers
{
public:
  TIFFNumbers(const std::byte * file, std::size_t size)
    : m_File(file)
    , m_Size(size)
    , m_IsBigEndian(size > 0 && file[0] == std::byte{ 'M' })
  {}

  /** The number in some bytes from \a place on; nothing beyond the end. */
  std::optional<std::uint64_t>
  Read(std::uint64_t place, std::size_t bytes) const
  {
    if (place > m_Size || m_Size - place < bytes)
    {
      return std::nullopt;
    }
    std::uint64_t number = 0;
    for (std::size_t n = 0; n < bytes; ++n)
    {
      const std::size_t at = place + (m_IsBigEndian ? n : bytes - 1 - n);
      number = number << 8 | std::to_integer<std::uint64_t>(m_File[at]);
    }
    return number;
  }

private:
  const std::byte * m_File;
  std::size_t m_Size;
  bool m_IsBigEndian;
};

/** Counts the pages, following the offsets from one to the next; nothing for a list that is damaged or cut off. */
inline std::optional<TIFFPages>
CountTIFFPages(const std::byte * file, std::size_t size)
{
  constexpr std::uint64_t width = 256, height = 257, shortType = 3;
  const TIFFNumbers numbers(file, size);
  const bool isBig = numbers.Read(2, 2) == 43u;
  const std::size_t word = isBig ? 8 : 4;      // of offsets
  const std::size_t ofCount = isBig ? 8 : 2;   // of the number of entries
  const std::size_t ofEntry = isBig ? 20 : 12; // tag, type, count, value
  TIFFPages pages;
  std::array<std::uint64_t, 2> first{};
  auto place = numbers.Read(isBig ? 8 : 4, word);
  for (std::size_t most = size / (ofCount + word); place && *place != 0; --most)
  {
    const auto entries = numbers.Read(*place, ofCount);
    if (most == 0 || !entries || *entries > size / ofEntry)
    {
      return std::nullopt;
    }
    std::array<std::uint64_t, 2> found{};
    for (std::uint64_t n = 0; n < *entries; ++n)
    {
      const std::uint64_t entry = *place + ofCount + n * ofEntry;
      const auto tag = numbers.Read(entry, 2), type = numbers.Read(entry + 2, 2);
      if (tag == width || tag == height)
      {
        const auto value = numbers.Read(entry + 4 + word, type == shortType ? 2 : 4);
        found[*tag - width] = value.value_or(0);
      }
    }
    first = pages.ofFirstSize == 0 ? found : first;
    ++(found == first ? pages.ofFirstSize : pages.others);
    place = numbers.Read(*place + ofCount + *entries * ofEntry, word);
  }
  return place && pages.ofFirstSize > 0 ? std::make_optional(pages) : std::nullopt;
}

/** What the ImageDescription of a page tells about all of them. */
struct PageDescription
{
  std::size_t announced = 0;          ///< by ImageJ, which writes one page for all where a file has more than 4 GB
  std::array<std::size_t, 3> sizes{}; ///< by OME-XML: slices, channels and times; 0 where it is not told
  std::array<double, 3> voxel{};      ///< by OME-XML, in mm along x, y and z; 0 where it is not told
};

/** The number that is all of a text; 0 for others. */
template <typename TNumber>
TNumber
NumberIn(const std::string & text)
{
  TNumber number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : TNumber{};
}

/** Millimetres of OME's unit of length, which are micrometres if none is written; 0 for pixels and other units. */
inline double
MillimetresOfOME(const std::string & unit)
{
  static const std::map<std::string, double> units{ { "", 1e-3 },   { "um", 1e-3 },      { "\xC2\xB5m", 1e-3 },
                                                    { "nm", 1e-6 }, { "mm", 1.0 },       { "\xCE\xBCm", 1e-3 },
                                                    { "pm", 1e-9 }, { "cm", 10.0 },      { "m", 1e3 },
                                                    { "in", 25.4 }, { "\xC3\x85", 1e-7 } };
  const auto found = units.find(unit);
  return found == units.end() ? 0.0 : found->second;
}

/** The attributes of the first element Pixels of OME-XML, by their names; none for other texts. */
inline std::map<std::string, std::string>
FindPixelsOfOME(const std::string & text)
{
  std::map<std::string, std::string> found;
  if (text.find("OME") == std::string::npos)
  {
    return found;
  }
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr), &XML_ParserFree);
  XML_SetUserData(parser.get(), &found);
  XML_SetStartElementHandler(parser.get(), [](void * data, const char * name, const char ** attributes) {
    auto & pixels = *static_cast<std::map<std::string, std::string> *>(data);
    const std::string element = name;
    if (pixels.empty() && element.substr(element.find(':') + 1) == "Pixels") // with or without a prefix
    {
      for (; *attributes != nullptr; attributes += 2)
      {
        pixels.emplace(attributes[0], attributes[1]);
      }
    }
  });
  const bool isWhole = XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), XML_TRUE) == XML_STATUS_OK;
  return isWhole ? found : std::map<std::string, std::string>();
}

/** Reads the first element Pixels of OME-XML, or the number of pictures that ImageJ writes. */
inline PageDescription
ReadPageDescription(const std::string & text)
{
  PageDescription described;
  if (text.rfind("ImageJ=", 0) == 0)
  {
    const auto place = text.find("\nimages=");
    const auto begin = place == std::string::npos ? text.size() : place + 8;
    described.announced = NumberIn<std::size_t>(text.substr(begin, text.find_first_of("\r\n", begin) - begin));
    return described;
  }
  std::map<std::string, std::string> pixels = FindPixelsOfOME(text);
  const char axes[] = "XYZ", counts[] = "ZCT";
  for (std::size_t n = 0; n < 3; ++n)
  {
    const std::string name = std::string("PhysicalSize") + axes[n];
    const double size = NumberIn<double>(pixels[name]) * MillimetresOfOME(pixels[name + "Unit"]);
    described.voxel[n] = size > 0.0 && std::isfinite(size) ? size : 0.0;
    described.sizes[n] = NumberIn<std::size_t>(pixels[std::string("Size") + counts[n]]);
  }
  return described;
}

} // namespace rhombic

#endif
