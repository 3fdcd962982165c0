#include "rhombicDicomFrame.h"

#include "rhombicFailure.h"

#include <gdcmImageReader.h>
#include <gdcmSequenceOfFragments.h>

#include <algorithm>
#include <fstream>
#include <iterator>
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

std::uint32_t
BigEndian(const unsigned char * bytes)
{
  return std::uint32_t{ bytes[0] } << 24 | std::uint32_t{ bytes[1] } << 16 | std::uint32_t{ bytes[2] } << 8 | bytes[3];
}

/** GDCM makes up pixels that are cut off, and allocates whatever length an element claims: both are found out before it
 * reads them. Encapsulated pixels have no length to check. */
void
RequireWholeNativePixels(const DicomSlice & slice)
{
  const gdcm::Tag pixelsTag(0x7fe0, 0x0010);
  std::ifstream stream(slice.path, std::ios::binary);
  gdcm::Reader reader;
  reader.SetStream(stream);
  if (!reader.ReadUpToTag(pixelsTag, { pixelsTag }) || !stream)
  {
    Refuse(slice, "it has no pixels, or its header is damaged");
  }
  const gdcm::TransferSyntax syntax = reader.GetFile().GetHeader().GetDataSetTransferSyntax();
  if (syntax.IsEncapsulated())
  {
    return;
  }
  // GDCM stops behind the length of the element that it was told to skip.
  const std::streamoff begin = stream.tellg();
  unsigned char bytes[4] = {};
  stream.seekg(begin - 4).read(reinterpret_cast<char *>(bytes), sizeof(bytes));
  if (syntax != gdcm::TransferSyntax::ExplicitVRBigEndian)
  {
    std::reverse(std::begin(bytes), std::end(bytes));
  }
  const std::uintmax_t claimed = BigEndian(bytes);
  const std::uintmax_t available = std::filesystem::file_size(slice.path) - static_cast<std::uintmax_t>(begin);
  const std::uintmax_t needed = CountPixels(slice) * (slice.bitsAllocated / 8);
  if (claimed < needed || available < claimed)
  {
    Refuse(slice,
           "it has " + std::to_string(std::min(claimed, available)) + " of " +
             std::to_string(std::max(claimed, needed)) + " bytes of pixels");
  }
}

struct PictureSize
{
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/** From the SIZ marker that JPEG 2000 begins with. */
PictureSize
SizeInJPEG2000(const std::string & stream)
{
  constexpr std::size_t needed = 24;
  const std::size_t marker = stream.find("\xff\x4f\xff\x51");
  if (marker == std::string::npos || marker + needed > stream.size())
  {
    return {};
  }
  const auto * const bytes = reinterpret_cast<const unsigned char *>(stream.data()) + marker;
  return { BigEndian(bytes + 8) - BigEndian(bytes + 16), BigEndian(bytes + 12) - BigEndian(bytes + 20) };
}

/** From the start-of-frame marker of JPEG or JPEG-LS, which comes after other segments. */
PictureSize
SizeInJPEG(const std::string & stream)
{
  constexpr std::size_t needed = 9;
  const auto * const bytes = reinterpret_cast<const unsigned char *>(stream.data());
  for (std::size_t segment = 2; segment + needed <= stream.size() && bytes[segment] == 0xff;)
  {
    const unsigned char code = bytes[segment + 1];
    const bool isTable = code == 0xc4 || code == 0xc8 || code == 0xcc;
    if ((code >= 0xc0 && code <= 0xcf && !isTable) || code == 0xf7)
    {
      const std::uint32_t both = BigEndian(bytes + segment + 5);
      return { both & 0xffff, both >> 16 };
    }
    segment += 2 + (BigEndian(bytes + segment + 2) >> 16);
  }
  return {};
}

/** GDCM aborts or writes past its buffer when a compressed picture is not as large as the header says. */
void
RequireSameSize(const DicomSlice & slice, const PictureSize & size)
{
  if (size.width != slice.columns || size.height != slice.rows)
  {
    Refuse(slice,
           "its compressed pixels are " + std::to_string(size.width) + "x" + std::to_string(size.height) +
             ", its header says " + std::to_string(slice.columns) + "x" + std::to_string(slice.rows));
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
RequireWholeEncapsulatedPixels(const DicomSlice & slice, const gdcm::File & file)
{
  const gdcm::TransferSyntax syntax = file.GetHeader().GetDataSetTransferSyntax();
  if (!syntax.IsEncapsulated())
  {
    return;
  }
  const auto * const fragments = file.GetDataSet().GetDataElement(gdcm::Tag(0x7fe0, 0x0010)).GetSequenceOfFragments();
  if (fragments == nullptr || fragments->GetNumberOfFragments() == 0)
  {
    Refuse(slice, "its compressed pixels are missing");
  }
  if (syntax == gdcm::TransferSyntax::RLELossless)
  {
    return;
  }
  const std::string stream = JoinFragments(*fragments);
  const bool isJPEG2000 = syntax == gdcm::TransferSyntax::JPEG2000 || syntax == gdcm::TransferSyntax::JPEG2000Lossless;
  RequireSameSize(slice, isJPEG2000 ? SizeInJPEG2000(stream) : SizeInJPEG(stream));
  RequireEndMarker(slice, stream);
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
  RequireWholeNativePixels(slice);
  gdcm::ImageReader reader;
  reader.SetFileName(slice.path.c_str());
  if (!reader.Read())
  {
    Refuse(slice, "its pixels are damaged or compressed in a way that is not supported");
  }
  RequireWholeEncapsulatedPixels(slice, reader.GetFile());

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
