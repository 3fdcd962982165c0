#include "rhombicDicomHeader.h"
#include "rhombicDicomSlice.h"
#include "rhombicFuzzFile.h"

#include <sstream>

using rhombic::DicomDataSet;
using rhombic::DicomHeader;
using rhombicfuzz::Require;

namespace
{

struct Contents
{
  std::size_t bytes = 0;
  std::size_t items = 0;
};

/** Asks for every value as every type. */
void
Visit(const DicomDataSet & dataSet, int depth, Contents & contents)
{
  Require(depth <= 64, "sequences end at 64 levels");
  for (const auto & [tag, value] : dataSet.values)
  {
    contents.bytes += value.size();
    dataSet.GetText(tag);
    dataSet.GetDecimals(tag);
    dataSet.GetShorts(tag);
    dataSet.GetDouble(tag);
  }
  for (const auto & [tag, items] : dataSet.sequences)
  {
    contents.items += items.size();
    for (const DicomDataSet & item : items)
    {
      Visit(item, depth + 1, contents);
    }
  }
}

void
CheckHeader(const DicomHeader & header, std::size_t size)
{
  Contents contents;
  Visit(header.dataSet, 0, contents);
  Require(contents.bytes <= size, "values are parts of the file");
  Require(contents.items <= size / 8, "items are parts of the file");
  std::uintmax_t end = 0;
  for (const rhombic::ByteRange & fragment : header.fragments)
  {
    Require(fragment.offset >= end, "fragments follow each other");
    Require(fragment.size <= size && fragment.offset <= size - fragment.size, "fragments lie inside the file");
    end = fragment.offset + fragment.size;
  }
  Require(!header.hasPixels || header.pixels.offset <= size, "the pixels begin inside the file");
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  const std::string bytes(reinterpret_cast<const char *>(data), size);
  std::istringstream file(bytes);
  if (const auto header = rhombic::ParseDicomHeader(file, size))
  {
    CheckHeader(*header, size);

    // As when the file shrinks while it is read.
    std::istringstream shrunk(bytes.substr(0, size / 2));
    rhombic::ParseDicomHeader(shrunk, size);

    const rhombicfuzz::FuzzFile fuzzFile(data, size);
    Require(!rhombic::ReadDicomSlices(fuzzFile.Path()).empty(), "a DICOM file has at least one slice");
  }
  return 0;
}
