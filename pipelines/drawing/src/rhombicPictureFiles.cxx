#include "rhombicPictureFiles.h"

#include "rhombicFailure.h"

#include <algorithm>
#include <array>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

Picture
Shrink(const Picture & picture, int side)
{
  const int block = (std::max(picture.width, picture.height) + side - 1) / side;
  Picture small(std::max(1, picture.width / block), std::max(1, picture.height / block), 3);
  const int columns = std::min(block, picture.width);
  const int rows = std::min(block, picture.height);
  auto component = small.pixels.begin();
  for (int y = 0; y < small.height; ++y)
  {
    for (int x = 0; x < small.width; ++x)
    {
      std::array<int, 3> sums{};
      for (int row = 0; row < rows; ++row)
      {
        const std::uint8_t * pixel = picture.At(x * block, y * block + row);
        for (int column = 0; column < columns; ++column, pixel += picture.channels)
        {
          sums = { sums[0] + pixel[0], sums[1] + pixel[1], sums[2] + pixel[2] };
        }
      }
      component = std::transform(sums.begin(), sums.end(), component, [&](int sum) {
        return static_cast<std::uint8_t>(sum / (columns * rows));
      });
    }
  }
  return small;
}

} // namespace

std::vector<fs::path>
DicomPathsOf(const std::vector<fs::path> & pictures)
{
  std::vector<fs::path> paths = pictures;
  for (fs::path & path : paths)
  {
    path.replace_extension(".dcm");
  }
  return paths;
}

std::optional<DicomStudy>
OpenStudy(const PictureSource & source, const std::vector<fs::path> & dicomPaths)
{
  if (dicomPaths.empty())
  {
    return std::nullopt;
  }
  if (!source.surfaceFiles.empty())
  {
    throw Failure(FailureKind::Usage,
                  "Surface files name no study that DICOM pictures could belong to; leave out --dicom-sc, or draw from "
                  "the folder of the DICOM scan.");
  }
  DicomStudy study(source.scan.path, source.scan.read);
  for (const fs::path & path : dicomPaths)
  {
    study.CheckPath(path);
  }
  return study;
}

void
StageDicom(const DicomStudy & study,
           const std::vector<Picture> & pictures,
           const std::vector<fs::path> & paths,
           double secondsPerFrame,
           const std::string & software,
           const Events & events,
           StagedFiles & staged)
{
  std::vector<DicomCapture> captures;
  for (const fs::path & path : paths)
  {
    captures.push_back({ path, {}, secondsPerFrame });
  }
  for (std::size_t n = 0; n < pictures.size(); ++n)
  {
    captures[std::min(n, captures.size() - 1)].frames.push_back(&pictures[n]);
  }
  study.Stage(captures, software, staged);
  events.Note("the DICOM files hold the patient's name and the other tags of the scan's patient and study");
}

void
StageThumbnail(const std::vector<Picture> & pictures,
               const std::filesystem::path & path,
               StagedFiles & staged,
               std::vector<MadeFile> & outputs)
{
  constexpr int side = 320; // pixels
  if (!pictures.empty() && !path.empty())
  {
    StagePicture(Shrink(pictures.front(), side), path, staged, {});
    outputs.push_back({ path, "thumbnail", Report::array(), false });
  }
}

} // namespace rhombic
