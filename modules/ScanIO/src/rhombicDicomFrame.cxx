#include "rhombicDicomFrame.h"

#include "rhombicFailure.h"

#include <gdcmImageReader.h>
#include <gdcmSequenceOfFragments.h>

#include <cstring>
#include <string>

namespace rhombic
{
namespace
{

[[noreturn]] void
Refuse(const DicomSlice & slice, const std::string & why)
{
  throw Failure(FailureKind::Unreadable,
                "Cannot read " + slice.path.string() + ": " + why + "; copy it again from its source.");
}

std::size_t
CountPixels(const DicomSlice & slice)
{
  return static_cast<std::size_t>(slice.rows) * slice.columns;
}

/** GDCM leaves the rest of the picture unset when native pixels are cut off. */
void
RequireWholeNativePixels(const DicomSlice & slice, const gdcm::DataElement & pixels)
{
  const std::size_t needed = CountPixels(slice) * (slice.bitsAllocated / 8);
  const auto * value = pixels.GetByteValue();
  const std::size_t available = value ? static_cast<std::size_t>(value->GetLength()) : 0;
  if (available < needed)
  {
    Refuse(slice, "it has " + std::to_string(available) + " of " + std::to_string(needed) + " bytes of pixels");
  }
}

std::uint32_t
BigEndian(const std::string & bytes, std::size_t offset)
{
  std::uint32_t value = 0;
  for (std::size_t i = offset; i < offset + 4; ++i)
  {
    value = value << 8 | static_cast<unsigned char>(bytes[i]);
  }
  return value;
}

/** GDCM writes past its buffer when a JPEG 2000 picture is larger than the header says: its SIZ marker is compared
 * first. */
void
RequireSameSizeInJPEG2000(const DicomSlice & slice, const std::string & stream)
{
  constexpr std::size_t sizeEnd = 24;
  const std::size_t marker = stream.find("\xff\x4f\xff\x51");
  if (marker == std::string::npos || marker + sizeEnd > stream.size())
  {
    Refuse(slice, "its JPEG 2000 pixels have no header");
  }
  const std::uint32_t width = BigEndian(stream, marker + 8) - BigEndian(stream, marker + 16);
  const std::uint32_t height = BigEndian(stream, marker + 12) - BigEndian(stream, marker + 20);
  if (width != slice.columns || height != slice.rows)
  {
    Refuse(slice,
           "its JPEG 2000 pixels are " + std::to_string(width) + "x" + std::to_string(height) + ", its header says " +
             std::to_string(slice.columns) + "x" + std::to_string(slice.rows));
  }
}

/** JPEG, JPEG-LS and JPEG 2000 all end with the bytes FF D9, maybe followed by padding. */
void
RequireEndMarker(const DicomSlice & slice, const std::string & stream)
{
  const std::size_t last = stream.find_last_not_of(std::string("\0\xff", 2));
  if (last == std::string::npos || last == 0 || stream[last] != '\xd9' || stream[last - 1] != '\xff')
  {
    Refuse(slice, "its compressed pixels are cut off");
  }
}

std::string
JoinFragments(const gdcm::SequenceOfFragments & fragments)
{
  std::string stream;
  for (gdcm::SequenceOfFragments::SizeType i = 0; i < fragments.GetNumberOfFragments(); ++i)
  {
    if (const gdcm::ByteValue * const value = fragments.GetFragment(i).GetByteValue())
    {
      stream.append(value->GetPointer(), value->GetLength());
    }
  }
  return stream;
}

void
RequireWholeEncapsulatedPixels(const DicomSlice & slice,
                               const gdcm::DataElement & pixels,
                               const gdcm::TransferSyntax & syntax)
{
  const gdcm::SequenceOfFragments * const fragments = pixels.GetSequenceOfFragments();
  if (fragments == nullptr || fragments->GetNumberOfFragments() == 0)
  {
    Refuse(slice, "its compressed pixels are missing");
  }
  if (syntax == gdcm::TransferSyntax::RLELossless)
  {
    return;
  }
  const std::string stream = JoinFragments(*fragments);
  if (syntax == gdcm::TransferSyntax::JPEG2000 || syntax == gdcm::TransferSyntax::JPEG2000Lossless)
  {
    RequireSameSizeInJPEG2000(slice, stream);
  }
  RequireEndMarker(slice, stream);
}

void
RequireWholePixels(const DicomSlice & slice, const gdcm::File & file)
{
  const gdcm::Tag pixelsTag(0x7fe0, 0x0010);
  if (!file.GetDataSet().FindDataElement(pixelsTag))
  {
    Refuse(slice, "it has no pixels");
  }
  const gdcm::DataElement & pixels = file.GetDataSet().GetDataElement(pixelsTag);
  const gdcm::TransferSyntax syntax = file.GetHeader().GetDataSetTransferSyntax();
  if (syntax.IsEncapsulated())
  {
    RequireWholeEncapsulatedPixels(slice, pixels, syntax);
  }
  else
  {
    RequireWholeNativePixels(slice, pixels);
  }
}

template <typename TStored>
DicomFrame
Decode(const DicomSlice & slice, const gdcm::Image & image)
{
  std::vector<TStored> values(CountPixels(slice));
  if (image.GetBufferLength() != values.size() * sizeof(TStored))
  {
    Refuse(slice, "its pixels are of another size than its header says");
  }
  if (!image.GetBuffer(reinterpret_cast<char *>(values.data())))
  {
    Refuse(slice, "its pixels can't be decoded");
  }
  return values;
}

} // namespace

DicomFrame
DecodeDicomFrame(const DicomSlice & slice)
{
  gdcm::ImageReader reader;
  reader.SetFileName(slice.path.c_str());
  if (!reader.Read())
  {
    Refuse(slice, "its pixels are damaged or compressed in a way that is not supported");
  }
  RequireWholePixels(slice, reader.GetFile());

  const gdcm::Image & image = reader.GetImage();
  switch (image.GetPixelFormat().GetScalarType())
  {
    case gdcm::PixelFormat::UINT8:
      return Decode<std::uint8_t>(slice, image);
    case gdcm::PixelFormat::INT8:
      return Decode<std::int8_t>(slice, image);
    case gdcm::PixelFormat::UINT16:
      return Decode<std::uint16_t>(slice, image);
    case gdcm::PixelFormat::INT16:
      return Decode<std::int16_t>(slice, image);
    case gdcm::PixelFormat::UINT32:
      return Decode<std::uint32_t>(slice, image);
    case gdcm::PixelFormat::INT32:
      return Decode<std::int32_t>(slice, image);
    default:
      Refuse(slice, "its pixels are of a type that is not supported");
  }
}

} // namespace rhombic
