#include "rhombicPictureIO.h"

#include "detail/rhombicPictureCodec.h"
#include "rhombicAtomicFile.h"
#include "rhombicFailure.h"
#include "rhombicPictureFormat.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr std::uintmax_t SmallestFile = 64; // bytes; the headers of all formats are longer

[[noreturn]] void
FailWriting(const fs::path & path, const std::string & why)
{
  throw Failure(FailureKind::Output, "Cannot write the picture " + path.string() + ": " + why + ".");
}

std::string
ReadBytes(const fs::path & path)
{
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf(); // a disk that fails ends them
  return bytes.str();
}

bool
HasAllPixels(const Picture & picture)
{
  return picture.width > 0 && picture.height > 0 &&
         picture.pixels.size() == static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) *
                                    static_cast<std::size_t>(picture.channels);
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
WriteFile(const PictureFile & contents, const fs::path & file, const PictureFormat & format)
{
  std::vector<unsigned char> bytes;
  const std::string error = GetPictureCodec().Encode(contents, format, file, bytes);
  return !error.empty() || format.needsFile
           ? error
           : WriteBytes(reinterpret_cast<const char *>(bytes.data()), bytes.size(), file);
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
VerifyFile(const PictureFile & contents, const fs::path & file, const PictureFormat & format, const fs::path & target)
{
  try
  {
    std::size_t page = 0;
    bool isSame = true;
    GetPictureCodec().Decode(file, [&](const Picture & picture) {
      isSame = page < contents.count && IsSame(picture, contents.pictures[page], format);
      ++page;
      return isSame;
    });
    if (!isSame || page < contents.count)
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
StageFile(const PictureFile & contents, const fs::path & path, PictureUse use, StagedFiles & staged)
{
  const Picture * const end = contents.pictures + contents.count;
  const bool hasAlpha = std::any_of(contents.pictures, end, [](const Picture & p) { return p.channels == 4; });
  const PictureFormat format = FormatOf(path, use, hasAlpha);
  if (contents.count == 0 || !std::all_of(contents.pictures, end, HasAllPixels))
  {
    throw Failure(FailureKind::Usage, "Cannot write the picture " + path.string() + ": it lacks pixels.");
  }
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
  Picture first;
  GetPictureCodec().Decode(path, [&first](Picture && page) {
    first = std::move(page);
    return false;
  });
  return first;
}

std::vector<Picture>
ReadPictures(const fs::path & path)
{
  std::vector<Picture> pictures;
  GetPictureCodec().Decode(path, [&pictures](Picture && page) {
    pictures.push_back(std::move(page));
    return true;
  });
  return pictures;
}

} // namespace rhombic
