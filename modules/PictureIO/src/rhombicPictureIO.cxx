#include "rhombicPictureIO.h"

#include "rhombicAtomicFile.h"
#include "rhombicFailure.h"
#include "rhombicLinearLight.h"
#include "rhombicPictureFormat.h"

#include <OpenImageIO/filesystem.h>

#include <fstream>
#include <vector>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr std::uintmax_t SmallestFile = 64; // bytes; the headers of all formats are longer
constexpr std::uint64_t LargestNumberOfPixels = std::uint64_t{ 1 } << 28;

[[noreturn]] void
FailWriting(const fs::path & path, const std::string & why)
{
  throw Failure(FailureKind::Output, "Cannot write the picture " + path.string() + ": " + why + ".");
}

[[noreturn]] void
FailReading(const fs::path & path, const std::string & why)
{
  throw Failure(FailureKind::Unreadable, "Cannot read the picture " + path.string() + ": " + why + ".");
}

/** OpenImageIO's message as part of a sentence. */
std::string
Reason(const std::string & message)
{
  const auto end = message.find_last_not_of(" .\n");
  return end == std::string::npos ? "OpenImageIO gives no reason" : message.substr(0, end + 1);
}

/** Turns off OpenImageIO's messages on the terminal, which complain about the date that MakeSpec() sets. */
void
SilenceOpenImageIO()
{
  static const bool silenced = OIIO::attribute("debug", 0);
  static_cast<void>(silenced);
}

bool
HasAllPixels(const Picture & picture)
{
  return picture.width > 0 && picture.height > 0 &&
         picture.pixels.size() ==
           static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * Picture::Channels;
}

OIIO::ImageSpec
MakeSpec(const Picture & picture, const PictureFormat & format, const PictureMetadata & metadata)
{
  OIIO::ImageSpec spec(picture.width, picture.height, Picture::Channels, format.component);
  spec.attribute("oiio:ColorSpace", format.isLinear ? "Linear" : "sRGB");
  spec.attribute("Compression", format.compression);
  if (format.name == "jpeg")
  {
    spec.attribute("jpeg:subsampling", "4:4:4"); // keeps the colour of thin structures
  }
  // Without a date the TIFF and EXR writers add the current one. They do not write a date that is not text.
  spec.attribute("DateTime", 0);
  if (!metadata.software.empty())
  {
    spec.attribute("Software", metadata.software);
  }
  if (!metadata.commandLine.empty())
  {
    spec.attribute("ImageDescription", metadata.commandLine);
  }
  return spec;
}

bool
WritePixels(OIIO::ImageOutput & output, const Picture & picture, const PictureFormat & format)
{
  if (format.isLinear)
  {
    return output.write_image(OIIO::TypeDesc::FLOAT, ToLinearLight(picture.pixels).data());
  }
  return output.write_image(OIIO::TypeDesc::UINT8, picture.pixels.data());
}

/** Writes to \a memory if it is not null, to \a file otherwise. Returns the reason of a failure, or an empty string. */
std::string
Encode(const Picture & picture,
       const fs::path & file,
       const PictureFormat & format,
       const PictureMetadata & metadata,
       OIIO::Filesystem::IOProxy * memory)
{
  const auto output = OIIO::ImageOutput::create(format.name);
  if (!output)
  {
    return Reason(OIIO::geterror());
  }
  if (memory)
  {
    output->set_ioproxy(memory);
  }
  const bool isWritten = output->open(file.string(), MakeSpec(picture, format, metadata)) &&
                         WritePixels(*output, picture, format) && output->close();
  return isWritten ? "" : Reason(output->geterror());
}

std::string
WriteBytes(const std::vector<unsigned char> & bytes, const fs::path & file)
{
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char *>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return stream.flush() ? "" : "not all bytes arrived; check the space on the disk";
}

/** Encodes in memory where possible, because on a full disk libjpeg ends the process and libpng prints. */
std::string
WriteFile(const Picture & picture,
          const fs::path & file,
          const PictureFormat & format,
          const PictureMetadata & metadata)
{
  if (format.needsFile)
  {
    return Encode(picture, file, format, metadata, nullptr);
  }
  OIIO::Filesystem::IOVecOutput memory;
  const std::string error = Encode(picture, file, format, metadata, &memory);
  return error.empty() ? WriteBytes(memory.buffer(), file) : error;
}

/** Reads the file back and compares it, because writers report success on a full disk. */
void
VerifyFile(const Picture & picture, const fs::path & file, const PictureFormat & format, const fs::path & target)
{
  try
  {
    const Picture written = ReadPicture(file);
    const bool isSame = written.width == picture.width && written.height == picture.height &&
                        (!format.isLossless || written.pixels == picture.pixels);
    if (!isSame)
    {
      FailWriting(target, "the file does not hold the same pixels; check the space on the disk");
    }
  }
  catch (const Failure & failure)
  {
    if (failure.GetKind() != FailureKind::Unreadable)
    {
      throw;
    }
    FailWriting(target, "the file can't be read back; check the space on the disk");
  }
}

/** The file's components in three channels; grey is repeated. */
template <typename TComponent>
std::vector<TComponent>
ReadComponents(OIIO::ImageInput & input, OIIO::TypeDesc type, const fs::path & path)
{
  const auto & spec = input.spec();
  const int channels = spec.nchannels < Picture::Channels ? 1 : Picture::Channels;
  std::vector<TComponent> components(spec.image_pixels() * static_cast<std::size_t>(channels));
  if (!input.read_image(0, 0, 0, channels, type, components.data()))
  {
    FailReading(path, Reason(input.geterror()));
  }
  if (channels == Picture::Channels)
  {
    return components;
  }
  std::vector<TComponent> repeated;
  repeated.reserve(components.size() * Picture::Channels);
  for (const TComponent component : components)
  {
    repeated.insert(repeated.end(), Picture::Channels, component);
  }
  return repeated;
}

} // namespace

void
CheckPicturePath(const fs::path & path)
{
  FormatOf(path);
}

void
StagePicture(const Picture & picture, const fs::path & path, StagedFiles & staged, const PictureMetadata & metadata)
{
  const PictureFormat format = FormatOf(path);
  if (!HasAllPixels(picture))
  {
    throw Failure(FailureKind::Usage, "Cannot write the picture " + path.string() + ": it lacks pixels.");
  }
  SilenceOpenImageIO();
  AtomicFile & file = staged.Begin(path);
  const std::string error = WriteFile(picture, file.GetTemporaryPath(), format, metadata);
  if (!error.empty())
  {
    FailWriting(path, error);
  }
  VerifyFile(picture, file.GetTemporaryPath(), format, path);
  file.Flush(SmallestFile);
}

void
WritePicture(const Picture & picture, const fs::path & path, const PictureMetadata & metadata)
{
  StagedFiles staged;
  StagePicture(picture, path, staged, metadata);
  staged.Commit();
}

Picture
ReadPicture(const fs::path & path)
{
  std::error_code error;
  if (!fs::is_regular_file(path, error))
  {
    throw Failure(FailureKind::NotFound, "There is no picture " + path.string() + "; check the path.");
  }
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input)
  {
    FailReading(path, Reason(OIIO::geterror()));
  }
  const auto & spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.image_pixels() > LargestNumberOfPixels)
  {
    FailReading(path, "it has no pixels, or more than " + std::to_string(LargestNumberOfPixels));
  }
  Picture picture;
  picture.width = spec.width;
  picture.height = spec.height;
  const bool isLinear = spec.get_string_attribute("oiio:ColorSpace") == "Linear";
  picture.pixels = isLinear ? FromLinearLight(ReadComponents<float>(*input, OIIO::TypeDesc::FLOAT, path))
                            : ReadComponents<std::uint8_t>(*input, OIIO::TypeDesc::UINT8, path);
  return picture;
}

} // namespace rhombic
