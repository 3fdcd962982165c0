#include "detail/rhombicPictureCodec.h"

#include "rhombicFailure.h"
#include "rhombicGif.h"
#include "rhombicLinearLight.h"
#include "rhombicPictureComparison.h"
#include "rhombicPictureFormat.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <memory>

// The only file that calls functions of OpenImageIO's libraries.

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr std::uint64_t LargestNumberOfPixels = std::uint64_t{ 1 } << 28;

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

OIIO::ImageSpec
MakeSpec(const Picture & picture, const PictureFormat & format, const PictureMetadata & metadata)
{
  const OIIO::TypeDesc component = format.isLinear ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8;
  OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, component);
  if (picture.channels == 4)
  {
    spec.attribute("oiio:UnassociatedAlpha", 1);
  }
  spec.attribute("oiio:ColorSpace", format.isLinear ? "Linear" : "sRGB");
  spec.attribute("Compression", format.compression);
  if (format.name == "jpeg")
  {
    spec.attribute("Compression", "jpeg:" + std::to_string(metadata.jpegQuality));
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  if (metadata.pixelsPerInch > 0.0)
  {
    const auto resolution = static_cast<float>(metadata.pixelsPerInch);
    spec.attribute("XResolution", resolution);
    spec.attribute("YResolution", resolution);
    spec.attribute("ResolutionUnit", "in");
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
    return output.write_image(OIIO::TypeDesc::FLOAT, ToLinearLight(picture).data());
  }
  return output.write_image(OIIO::TypeDesc::UINT8, picture.pixels.data());
}

/** PictureCodec::Encode(), through \a memory if it is not null. */
std::string
EncodeTo(OIIO::Filesystem::IOProxy * memory,
         const PictureFile & contents,
         const PictureFormat & format,
         const fs::path & file)
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
  for (std::size_t i = 0; i < contents.count; ++i)
  {
    const OIIO::ImageSpec spec = MakeSpec(contents.pictures[i], format, contents.metadata);
    const auto mode = i == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendSubimage;
    if (!output->open(file.string(), spec, mode) || !WritePixels(*output, contents.pictures[i], format))
    {
      return Reason(output->geterror());
    }
  }
  return output->close() ? "" : Reason(output->geterror());
}

/** The file's components in 3 channels, or 4 with alpha; grey is repeated. */
template <typename TComponent>
std::vector<TComponent>
ReadComponents(OIIO::ImageInput & input, OIIO::TypeDesc type, const fs::path & path)
{
  const auto & spec = input.spec();
  constexpr int colours = 3;
  const int channels = spec.nchannels < colours ? 1 : std::min(spec.nchannels, colours + 1);
  std::vector<TComponent> components(spec.image_pixels() * static_cast<std::size_t>(channels));
  if (!input.read_image(input.current_subimage(), 0, 0, channels, type, components.data()))
  {
    FailReading(path, Reason(input.geterror()));
  }
  if (channels >= colours)
  {
    return components;
  }
  std::vector<TComponent> repeated;
  repeated.reserve(components.size() * colours);
  for (const TComponent component : components)
  {
    repeated.insert(repeated.end(), colours, component);
  }
  return repeated;
}

std::unique_ptr<OIIO::ImageInput>
OpenFile(const fs::path & path)
{
  std::error_code error;
  if (!fs::is_regular_file(path, error))
  {
    throw Failure(FailureKind::NotFound, "There is no picture " + path.string() + "; check the path.");
  }
  OIIO::ImageSpec straightAlpha;
  straightAlpha.attribute("oiio:UnassociatedAlpha", 1);
  auto input = OIIO::ImageInput::open(path.string(), &straightAlpha);
  if (!input)
  {
    FailReading(path, Reason(OIIO::geterror()));
  }
  return input;
}

/** The page or frame that \a input is at. */
Picture
ReadPage(OIIO::ImageInput & input, const fs::path & path)
{
  const auto & spec = input.spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.image_pixels() > LargestNumberOfPixels)
  {
    FailReading(path, "it has no pixels, or more than " + std::to_string(LargestNumberOfPixels));
  }
  Picture picture;
  picture.width = spec.width;
  picture.height = spec.height;
  picture.channels = spec.nchannels >= 4 ? 4 : 3;
  const bool isLinear = spec.get_string_attribute("oiio:ColorSpace") == "Linear";
  picture.pixels = isLinear
                     ? FromLinearLight(ReadComponents<float>(input, OIIO::TypeDesc::FLOAT, path), picture.channels)
                     : ReadComponents<std::uint8_t>(input, OIIO::TypeDesc::UINT8, path);
  return picture;
}

/** An image that shares the picture's pixels. OpenImageIO has no image of constant memory, but comparing only reads. */
OIIO::ImageBuf
ViewOf(const Picture & picture)
{
  const OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, OIIO::TypeDesc::UINT8);
  return OIIO::ImageBuf(spec, const_cast<std::uint8_t *>(picture.pixels.data()));
}

class OpenImageIO : public PictureCodec
{
public:
  OpenImageIO()
  {
    OIIO::attribute("debug", 0); // no messages on the terminal, which complain about the date that MakeSpec() sets
  }

  std::string
  Encode(const PictureFile & contents,
         const PictureFormat & format,
         const fs::path & file,
         std::vector<unsigned char> & bytes) const override
  {
    if (format.name == "gif")
    {
      return EncodeGif(contents, bytes); // OpenImageIO would dither, with another palette for each frame
    }
    OIIO::Filesystem::IOVecOutput memory;
    std::string error = EncodeTo(format.needsFile ? nullptr : &memory, contents, format, file);
    bytes = memory.buffer();
    return error;
  }

  void
  Decode(const fs::path & file, const std::function<bool(Picture &&)> & usePage) const override
  {
    const auto input = OpenFile(file);
    int page = 0;
    while (usePage(ReadPage(*input, file)) && input->seek_subimage(++page, 0))
    {}
  }

  PictureDifference
  Compare(const Picture & a, const Picture & b, double threshold) const override
  {
    constexpr int oneThread = 1; // the order of summation changes the last digits
    const auto limit = static_cast<float>(threshold);
    const auto result = OIIO::ImageBufAlgo::compare(ViewOf(a), ViewOf(b), limit, limit, OIIO::ROI(), oneThread);
    PictureDifference difference;
    difference.meanError = result.meanerror;
    difference.rmsError = result.rms_error;
    difference.maxError = result.maxerror;
    difference.differingPixels = result.nfail;
    difference.worstX = result.maxx;
    difference.worstY = result.maxy;
    return difference;
  }
};

} // namespace

const PictureCodec &
GetPictureCodec()
{
  static const OpenImageIO codec;
  return codec;
}

} // namespace rhombic
