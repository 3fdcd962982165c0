#include "rhombicDicomDecoding.h"

#include "rhombicCompressedFrame.h"
#include "rhombicDicomSlice.h"
#include "rhombicQuietLibraries.h"
#include "rhombicVolumeRefusal.h"

#include <gdcmImageReader.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

[[noreturn]] void
Refuse(const fs::path & path, const std::string & why)
{
  RefuseVolume(path, why + "; copy it again from its source");
}

/** The compressed stream of each frame. A frame may be spread over several fragments; a fragment that begins with the
 * codec's marker begins a new frame. */
std::vector<std::string>
ReadFrames(const DicomImageFile & image, PixelCodec codec)
{
  std::ifstream file(image.path, std::ios::binary);
  std::vector<std::string> frames;
  for (const ByteRange & fragment : image.fragments)
  {
    std::string bytes(fragment.size, '\0');
    file.seekg(static_cast<std::streamoff>(fragment.offset));
    if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    {
      Refuse(image.path, "its compressed pixels are cut off");
    }
    const std::string_view marker = codec == PixelCodec::JPEG2000 ? "\xff\x4f" : "\xff\xd8";
    const bool isBeginning = codec == PixelCodec::RunLength || std::string_view(bytes).substr(0, 2) == marker;
    if (frames.empty() || (image.format.frames > 1 && isBeginning))
    {
      frames.push_back(std::move(bytes));
    }
    else
    {
      frames.back() += bytes;
    }
  }
  return frames;
}

/** Checks the streams. Returns the number of bits of their values; 0 for codecs that do not store it. */
unsigned int
CheckFrames(const DicomImageFile & image)
{
  unsigned int bits = 0;
  const PixelCodec codec = FindTransferSyntax(image.format.transferSyntax).codec;
  const std::vector<std::string> frames = ReadFrames(image, codec);
  if (frames.size() != image.format.frames)
  {
    Refuse(image.path,
           "it has " + std::to_string(frames.size()) + " compressed frames, its header says " +
             std::to_string(image.format.frames));
  }
  for (const std::string & frame : frames)
  {
    if (const std::string damage = FindFrameDamage(frame, codec, image.format); !damage.empty())
    {
      Refuse(image.path, damage);
    }
    bits = std::max(bits, BitsInFrame(frame, codec));
  }
  return bits;
}

/** Makes GDCM keep all bits of the stream; it would cut off those beyond the header's number. */
void
KeepBits(gdcm::Image & image, unsigned int bits)
{
  gdcm::PixelFormat format = image.GetPixelFormat();
  format.SetBitsStored(static_cast<unsigned short>(bits));
  format.SetHighBit(static_cast<unsigned short>(bits - 1));
  image.SetPixelFormat(format);
}

/** Whether values other than padding use bits beyond the header's number. */
template <typename TRaw>
bool
HasUnannouncedBits(const std::byte * voxels, std::size_t size, const DicomPixelFormat & format)
{
  const auto * const begin = reinterpret_cast<const TRaw *>(voxels);
  // Negative numbers have ones in all bits above their own.
  const auto above = static_cast<TRaw>(~std::uintmax_t{ 0 } << format.highBit << (format.isSigned ? 0 : 1));
  const TRaw negative = format.isSigned ? above : TRaw{ 0 };
  const auto isBeyond = [above, negative](TRaw raw) { return (raw & above) != 0 && (raw & above) != negative; };
  return std::any_of(begin, begin + size / sizeof(TRaw), [&](TRaw raw) {
    return isBeyond(raw) && !(format.padding && format.IsPadding(raw));
  });
}

bool
HasUnannouncedBits(const std::byte * voxels, std::size_t size, const DicomPixelFormat & format)
{
  switch (format.bitsAllocated)
  {
    case 8:
      return HasUnannouncedBits<std::uint8_t>(voxels, size, format);
    case 16:
      return HasUnannouncedBits<std::uint16_t>(voxels, size, format);
    default:
      return HasUnannouncedBits<std::uint32_t>(voxels, size, format);
  }
}

} // namespace

std::size_t
DecodeDicomFile(const fs::path & path, std::byte * voxels, std::size_t size)
{
  const QuietLibraries quiet; // only libjpeg's warnings of damage remain
  const std::vector<DicomSlice> slices = ReadDicomSlices(path);
  if (slices.empty())
  {
    Refuse(path, "it is not DICOM");
  }
  const DicomImageFile & image = *slices.front().file;
  if (!image.pixelDamage.empty() || !image.format.isEncapsulated)
  {
    Refuse(path, image.pixelDamage.empty() ? "its pixels are not compressed" : image.pixelDamage);
  }
  const unsigned int bits = CheckFrames(image);
  const bool hasMoreBits = bits > image.format.highBit + 1;

  gdcm::ImageReader reader;
  reader.SetFileName(path.c_str());
  if (!reader.Read())
  {
    Refuse(path, "its pixels are damaged or compressed in a way that is not supported");
  }
  if (reader.GetImage().GetBufferLength() != size)
  {
    Refuse(path, "its pixels are of another size than its header says");
  }
  if (hasMoreBits)
  {
    KeepBits(reader.GetImage(), bits);
  }
  if (!reader.GetImage().GetBuffer(reinterpret_cast<char *>(voxels)))
  {
    Refuse(path, "its pixels can't be decoded");
  }
  if (hasMoreBits && HasUnannouncedBits(voxels, size, image.format))
  {
    Refuse(path,
           "its compressed pixels have values of more than the " + std::to_string(image.format.bitsStored) +
             " bits that its header says");
  }
  return size;
}

} // namespace rhombic
