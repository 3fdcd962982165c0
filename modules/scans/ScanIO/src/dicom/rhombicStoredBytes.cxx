#include "rhombicStoredBytes.h"

#include "rhombicVolumeRefusal.h"

#include <algorithm>
#include <fstream>

namespace rhombic
{

std::vector<std::byte>
ReadStoredBytes(const DicomImageFile & file, std::uintmax_t offset, std::size_t size)
{
  // Words are counted from the first pixel of the file: a frame may begin or end inside a word.
  const std::size_t word = file.format.swappedBytes;
  const std::size_t before = offset % word;
  const std::size_t whole = (before + size + word - 1) / word * word;
  std::vector<std::byte> bytes(whole);
  std::ifstream stream(file.path, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(file.pixels.offset + offset - before));
  if (!stream.read(reinterpret_cast<char *>(bytes.data()), static_cast<std::streamsize>(whole)))
  {
    RefuseVolume(file.path, "its pixels are cut off; copy it again from its source");
  }
  for (auto value = bytes.begin(); value != bytes.end() && word > 1; value += static_cast<std::ptrdiff_t>(word))
  {
    std::reverse(value, value + static_cast<std::ptrdiff_t>(word));
  }
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(before));
  bytes.resize(size);
  return bytes;
}

} // namespace rhombic
