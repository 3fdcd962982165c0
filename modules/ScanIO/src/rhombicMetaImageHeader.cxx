#include "rhombicMetaImageHeader.h"

#include "rhombicCompressedFile.h"
#include "rhombicFailure.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

struct MetaImageHeader
{
  std::map<std::string, std::string> fields;
  std::uintmax_t size = 0; ///< bytes up to the first after the line of ElementDataFile

  std::string
  Get(const std::string & key) const
  {
    const auto found = fields.find(key);
    return found == fields.end() ? "" : found->second;
  }
};

MetaImageHeader
ReadHeader(const fs::path & path)
{
  constexpr int maximumLines = 1000;
  MetaImageHeader header;
  std::ifstream file(path, std::ios::binary);
  std::string line;
  for (int i = 0; i < maximumLines && header.fields.count("ElementDataFile") == 0 && std::getline(file, line); ++i)
  {
    header.size += line.size() + 1;
    std::string key, equals, value;
    std::istringstream words(line);
    words >> key >> equals;
    std::getline(words >> std::ws, value);
    value.erase(value.find_last_not_of(" \t\r") + 1);
    header.fields[key] = value;
  }
  return header;
}

/** Bytes of a voxel, or 0 for a type whose pixels are no single numbers. */
std::uintmax_t
SizeOfType(const std::string & type)
{
  static const std::map<std::string, std::uintmax_t> sizes{
    { "MET_CHAR", 1 },  { "MET_UCHAR", 1 },  { "MET_SHORT", 2 },     { "MET_USHORT", 2 },
    { "MET_INT", 4 },   { "MET_UINT", 4 },   { "MET_LONG", 4 },      { "MET_ULONG", 4 },
    { "MET_FLOAT", 4 }, { "MET_DOUBLE", 8 }, { "MET_LONG_LONG", 8 }, { "MET_ULONG_LONG", 8 }
  };
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

std::uintmax_t
SizeOfPixels(const MetaImageHeader & header)
{
  double size = static_cast<double>(SizeOfType(header.Get("ElementType")));
  std::istringstream dimensions(header.Get("DimSize"));
  for (double dimension; dimensions >> dimension;)
  {
    size *= dimension;
  }
  return size >= 0 && size < 1e18 ? static_cast<std::uintmax_t>(size) : UINTMAX_MAX;
}

bool
IsTrue(const std::string & value)
{
  return !value.empty() && (value.front() == 'T' || value.front() == 't' || value.front() == '1');
}

} // namespace

void
CheckMetaImageData(const fs::path & path)
{
  const MetaImageHeader header = ReadHeader(path);
  const std::string name = header.Get("ElementDataFile");
  if (name.empty())
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() +
                    ": its content is not MetaImage, as its name says; check where it came from.");
  }
  if (name == "LIST" || name.find('%') != std::string::npos)
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() +
                    ": its pixels are spread over several files, which is not supported; write it as one file.");
  }
  const bool isLocal = name == "LOCAL" || name == "Local" || name == "local";
  const fs::path data = isLocal ? path : path.parent_path() / name;
  std::error_code error;
  const auto available = fs::file_size(data, error);
  if (error)
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() + ": its pixels should be in " + data.string() +
                    ", which is missing; put the two files into one folder.");
  }
  if (!header.Get("BinaryData").empty() && !IsTrue(header.Get("BinaryData")))
  {
    return; // numbers as text, of any length
  }
  const auto needed = SizeOfPixels(header);
  const auto begin = isLocal ? std::min(header.size, available) : 0;
  const auto pixels = IsTrue(header.Get("CompressedData")) ? CountInflated(data, begin, needed) : available - begin;
  if (pixels < needed)
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() + ": " + data.string() + " has " + std::to_string(pixels) + " of " +
                    std::to_string(needed) + " bytes of pixels; it is cut off, so copy it again.");
  }
}

} // namespace rhombic
