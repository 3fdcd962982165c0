// rhombic-unpack-dicom: unpacks the compressed pixels of DICOM files by GDCM, which damaged files can crash.

#include "rhombicCompressedFrame.h"
#include "rhombicDicomFrames.h"
#include "rhombicSandboxChild.h"

#include <gdcmImage.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace rhombic
{
namespace
{

[[noreturn]] void
Refuse(const std::string & why)
{
  throw SandboxRefusal(why + "; copy it again from its source");
}

/** The compressed stream of each frame. A frame may be spread over several fragments; a fragment that begins with the
 * codec's marker begins a new frame. */
std::vector<std::string>
ReadFrames(const SandboxInput & input, const DicomImageFile & image, PixelCodec codec)
{
  std::vector<std::string> frames;
  for (const ByteRange & fragment : image.fragments)
  {
    if (fragment.offset > input.size || fragment.size > input.size - fragment.offset)
    {
      Refuse("its compressed pixels are cut off");
    }
    const std::string_view bytes(reinterpret_cast<const char *>(input.file) + fragment.offset, fragment.size);
    const std::string_view marker = codec == PixelCodec::JPEG2000 ? "\xff\x4f" : "\xff\xd8";
    const bool isBeginning = codec == PixelCodec::RunLength || bytes.substr(0, 2) == marker;
    if (frames.empty() || (image.format.frames > 1 && isBeginning))
    {
      frames.emplace_back(bytes);
    }
    else
    {
      frames.back() += bytes;
    }
  }
  return frames;
}

void
CheckFrames(const std::vector<std::string> & frames, PixelCodec codec, const DicomPixelFormat & format)
{
  if (frames.size() != format.frames)
  {
    Refuse("it has " + std::to_string(frames.size()) + " compressed frames, its header says " +
           std::to_string(format.frames));
  }
  for (const std::string & frame : frames)
  {
    if (const std::string damage = FindFrameDamage(frame, codec, format); !damage.empty())
    {
      Refuse(damage);
    }
  }
}

/** \class FrameImage
 * \brief One frame for GDCM, as gdcm::ImageReader makes it of a file with this frame only. */
class FrameImage : public gdcm::Image
{
public:
  FrameImage(const std::string & frame, const DicomPixelFormat & format)
  {
    const auto bits = [](unsigned int number) { return static_cast<unsigned short>(number); };
    this->SetNumberOfDimensions(2);
    this->SetDimension(0, format.columns);
    this->SetDimension(1, format.rows);
    this->SetPixelFormat(gdcm::PixelFormat(
      1, bits(format.bitsAllocated), bits(format.bitsStored), bits(format.highBit), format.isSigned ? 1 : 0));
    this->SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
    this->SetTransferSyntax(gdcm::TransferSyntax::GetTSType(format.transferSyntax.c_str()));
    gdcm::Fragment fragment;
    fragment.SetByteValue(frame.data(), static_cast<std::uint32_t>(frame.size()));
    const auto fragments = gdcm::SequenceOfFragments::New();
    fragments->AddFragment(fragment);
    gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
    pixels.SetVR(gdcm::VR::OB);
    pixels.SetValue(*fragments);
    this->SetDataElement(pixels);
    this->ComputeLossyFlag(); // which corrects the pixel format by the stream's
  }

  /** Keeps all bits of the stream; GDCM would cut off those beyond the header's number. */
  void
  KeepBits(unsigned int bits)
  {
    this->GetPixelFormat().SetBitsStored(static_cast<unsigned short>(bits));
    this->GetPixelFormat().SetHighBit(static_cast<unsigned short>(bits - 1));
  }
};

/** Whether values other than padding use bits beyond the header's number. */
template <typename TRaw>
bool
HasUnannouncedBits(const std::byte * voxels, const DicomPixelFormat & format)
{
  const auto * const begin = reinterpret_cast<const TRaw *>(voxels);
  // Negative numbers have ones in all bits above their own.
  const auto above = static_cast<TRaw>(~std::uintmax_t{ 0 } << format.highBit << (format.isSigned ? 0 : 1));
  const TRaw negative = format.isSigned ? above : TRaw{ 0 };
  const auto isBeyond = [above, negative](TRaw raw) { return (raw & above) != 0 && (raw & above) != negative; };
  return std::any_of(begin, begin + format.FrameBytes() / sizeof(TRaw), [&](TRaw raw) {
    return isBeyond(raw) && !(format.padding && format.IsPadding(raw));
  });
}

bool
HasUnannouncedBits(const std::byte * voxels, const DicomPixelFormat & format)
{
  switch (format.bitsAllocated)
  {
    case 8:
      return HasUnannouncedBits<std::uint8_t>(voxels, format);
    case 16:
      return HasUnannouncedBits<std::uint16_t>(voxels, format);
    default:
      return HasUnannouncedBits<std::uint32_t>(voxels, format);
  }
}

/** Unpacks a checked frame to format.FrameBytes() bytes. */
void
UnpackFrame(const std::string & frame, PixelCodec codec, const DicomPixelFormat & format, std::byte * voxels)
{
  FrameImage image(frame, format);
  if (image.GetBufferLength() != format.FrameBytes())
  {
    Refuse("its pixels are of another size than its header says");
  }
  const unsigned int bits = BitsInFrame(frame, codec);
  const bool hasMoreBits = bits > format.highBit + 1;
  if (hasMoreBits)
  {
    image.KeepBits(bits);
  }
  if (!image.GetBuffer(reinterpret_cast<char *>(voxels)))
  {
    Refuse("its pixels can't be decoded");
  }
  if (hasMoreBits && HasUnannouncedBits(voxels, format))
  {
    Refuse("its compressed pixels have values of more than the " + std::to_string(format.bitsStored) +
           " bits that its header says");
  }
}

/** Unpacks all frames, each as a piece. */
void
UnpackDicom(const SandboxInput & input, SandboxOutput & output)
{
  const auto description = nlohmann::json::parse(input.arguments);
  const auto image = description.get<DicomImageFile>();
  const auto codec = description.at("codec").get<PixelCodec>();
  const std::vector<std::string> frames = ReadFrames(input, image, codec);
  CheckFrames(frames, codec, image.format);
  for (const std::string & frame : frames)
  {
    UnpackFrame(frame, codec, image.format, output.GetBuffer());
    output.Deliver(image.format.FrameBytes());
  }
}

} // namespace
} // namespace rhombic

int
main(int argc, char ** argv)
{
  gdcm::Trace::WarningOff(); // only libjpeg's warnings of damage remain
  gdcm::Trace::ErrorOff();
  gdcm::Trace::DebugOff();
  return rhombic::RunSandboxChild(argc, argv, rhombic::UnpackDicom);
}
