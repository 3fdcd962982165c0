#include "rhombicPictureIO.h"

#include "rhombicAtomicFile.h"
#include "rhombicFailure.h"
#include "rhombicLinearLight.h"
#include "rhombicPictureFormat.h"
#include "rhombicWording.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
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

std::string
ReadBytes(const fs::path & path)
{
  std::ifstream stream(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
}

bool
HasAllPixels(const Picture & picture)
{
  return picture.width > 0 && picture.height > 0 &&
         picture.pixels.size() == static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) *
                                    static_cast<std::size_t>(picture.channels);
}

OIIO::ImageSpec
MakeSpec(const Picture & picture, const PictureFormat & format, const PictureMetadata & metadata)
{
  OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, format.component);
  if (picture.channels == 4)
  {
    spec.attribute("oiio:UnassociatedAlpha", 1);
  }
  spec.attribute("oiio:ColorSpace", format.isLinear ? "Linear" : "sRGB");
  spec.attribute("Compression", format.compression);
  if (format.name == "jpeg")
  {
    spec.attribute("Compression", "jpeg:" + std::to_string(metadata.jpegQuality));
    spec.attribute("jpeg:subsampling", "4:4:4"); // keeps the colour of thin structures
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

/** What is written to a file. */
struct FileContents
{
  const Picture * pictures = nullptr;
  std::size_t count = 0;
  PictureMetadata metadata;
  double secondsPerFrame = 0.0; ///< 0: no animation
};

/** Writes to \a memory if it is not null, to \a file otherwise. Returns the reason of a failure, or an empty string. */
std::string
Encode(const FileContents & contents,
       const fs::path & file,
       const PictureFormat & format,
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
  for (std::size_t i = 0; i < contents.count; ++i)
  {
    OIIO::ImageSpec spec = MakeSpec(contents.pictures[i], format, contents.metadata);
    if (contents.secondsPerFrame > 0.0)
    {
      spec.attribute("FramesPerSecond", static_cast<float>(1.0 / contents.secondsPerFrame));
    }
    const auto mode = i == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendSubimage;
    if (!output->open(file.string(), spec, mode) || !WritePixels(*output, contents.pictures[i], format))
    {
      return Reason(output->geterror());
    }
  }
  return output->close() ? "" : Reason(output->geterror());
}

std::string
WriteBytes(const char * bytes, std::size_t size, const fs::path & file)
{
  std::ofstream stream(file, std::ios::binary);
  stream.write(bytes, static_cast<std::streamsize>(size));
  return stream.flush() ? "" : "not all bytes arrived; check the space on the disk";
}

/** Encodes in memory where possible, because on a full disk libjpeg ends the process and libpng prints. */
std::string
WriteFile(const FileContents & contents, const fs::path & file, const PictureFormat & format)
{
  if (format.needsFile)
  {
    return Encode(contents, file, format, nullptr);
  }
  OIIO::Filesystem::IOVecOutput memory;
  const std::string error = Encode(contents, file, format, &memory);
  const std::vector<unsigned char> & bytes = memory.buffer();
  return error.empty() ? WriteBytes(reinterpret_cast<const char *>(bytes.data()), bytes.size(), file) : error;
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

/** Whether a picture that was read back is what was written. Linear light has no colours where alpha is 0. */
bool
IsSame(const Picture & written, const Picture & picture, const PictureFormat & format)
{
  if (written.width != picture.width || written.height != picture.height)
  {
    return false;
  }
  if (!format.isLossless)
  {
    return true;
  }
  if (!format.isLinear || picture.channels < 4)
  {
    return written.pixels == picture.pixels;
  }
  for (std::size_t i = 0; i < picture.pixels.size(); i += 4)
  {
    const auto * const expected = picture.pixels.data() + i;
    const auto * const found = written.pixels.data() + i;
    if (found[3] != expected[3] || (expected[3] > 0 && !std::equal(found, found + 3, expected)))
    {
      return false;
    }
  }
  return true;
}

/** Reads the file back and compares it, because writers report success on a full disk. */
void
VerifyFile(const FileContents & contents, const fs::path & file, const PictureFormat & format, const fs::path & target)
{
  try
  {
    const auto input = OpenFile(file);
    bool isSame = true;
    for (std::size_t i = 0; i < contents.count && isSame; ++i)
    {
      isSame =
        input->seek_subimage(static_cast<int>(i), 0) && IsSame(ReadPage(*input, file), contents.pictures[i], format);
    }
    if (!isSame || input->seek_subimage(static_cast<int>(contents.count), 0))
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

void
StageFile(const FileContents & contents, const fs::path & path, PictureUse use, StagedFiles & staged)
{
  const Picture * const end = contents.pictures + contents.count;
  const bool hasAlpha = std::any_of(contents.pictures, end, [](const Picture & p) { return p.channels == 4; });
  const PictureFormat format = FormatOf(path, use, hasAlpha);
  if (contents.count == 0 || !std::all_of(contents.pictures, end, HasAllPixels))
  {
    throw Failure(FailureKind::Usage, "Cannot write the picture " + path.string() + ": it lacks pixels.");
  }
  SilenceOpenImageIO();
  AtomicFile & file = staged.Begin(path);
  const std::string error = WriteFile(contents, file.GetTemporaryPath(), format);
  if (!error.empty())
  {
    FailWriting(path, error);
  }
  VerifyFile(contents, file.GetTemporaryPath(), format, path);
  file.Flush(SmallestFile);
}

/** Whether the bytes are a whole PDF with a number of pages, which the root of its tree of pages counts. */
bool
IsPdf(const std::string & bytes, std::size_t pages)
{
  const auto tree = bytes.find("/Type /Pages");
  const auto count = tree == std::string::npos ? tree : bytes.find("/Count ", tree);
  return bytes.compare(0, 5, "%PDF-") == 0 &&
         bytes.find("%%EOF", bytes.size() - std::min<std::size_t>(bytes.size(), 8)) != std::string::npos &&
         count != std::string::npos && std::strtoull(bytes.c_str() + count + 7, nullptr, 10) == pages;
}

} // namespace

void
CheckPicturePath(const fs::path & path, int channels)
{
  FormatOf(path, PictureUse::Single, channels == 4);
}

void
CheckPagesPath(const fs::path & path, int channels)
{
  FormatOf(path, PictureUse::Pages, channels == 4);
}

void
CheckAnimationPath(const fs::path & path, int channels)
{
  FormatOf(path, PictureUse::Animation, channels == 4);
}

void
StagePicture(const Picture & picture, const fs::path & path, StagedFiles & staged, const PictureMetadata & metadata)
{
  StageFile({ &picture, 1, metadata }, path, PictureUse::Single, staged);
}

void
StagePages(const std::vector<Picture> & pages,
           const fs::path & path,
           StagedFiles & staged,
           const PictureMetadata & metadata)
{
  StageFile({ pages.data(), pages.size(), metadata }, path, PictureUse::Pages, staged);
}

void
StageAnimation(const std::vector<Picture> & frames, double secondsPerFrame, const fs::path & path, StagedFiles & staged)
{
  const bool hasOneSize = std::all_of(frames.begin(), frames.end(), [&frames](const Picture & frame) {
    return frame.width == frames[0].width && frame.height == frames[0].height;
  });
  if (!hasOneSize || !(secondsPerFrame > 0.0))
  {
    throw Failure(FailureKind::Usage,
                  "Cannot write the animation " + path.string() + ": frames must have one size and a time above 0.");
  }
  StageFile({ frames.data(), frames.size(), {}, secondsPerFrame }, path, PictureUse::Animation, staged);
}

void
StagePdf(const std::string & bytes, std::size_t pages, const fs::path & path, StagedFiles & staged)
{
  if (LowerCase(path.extension().string()) != ".pdf")
  {
    throw Failure(FailureKind::Usage, "Cannot write the pages " + path.string() + ": the extension must be .pdf.");
  }
  if (!IsPdf(bytes, pages))
  {
    FailWriting(path, "its bytes are no PDF of " + Count(pages, "page") + "; please report this as a defect");
  }
  AtomicFile & file = staged.Begin(path);
  const std::string error = WriteBytes(bytes.data(), bytes.size(), file.GetTemporaryPath());
  if (!error.empty() || ReadBytes(file.GetTemporaryPath()) != bytes)
  {
    FailWriting(path, error.empty() ? "the file does not hold the same bytes; check the space on the disk" : error);
  }
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
  return ReadPage(*OpenFile(path), path);
}

std::vector<Picture>
ReadPictures(const fs::path & path)
{
  const auto input = OpenFile(path);
  std::vector<Picture> pictures;
  do
  {
    pictures.push_back(ReadPage(*input, path));
  } while (input->seek_subimage(static_cast<int>(pictures.size()), 0));
  return pictures;
}

} // namespace rhombic
