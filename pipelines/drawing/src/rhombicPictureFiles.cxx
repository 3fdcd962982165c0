#include "rhombicPictureSteps.h"

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

fs::path
WithPart(const fs::path & path, const std::string & part)
{
  return path.parent_path() / (path.stem().string() + "-" + part + path.extension().string());
}

std::vector<fs::path>
DicomPathsOf(const PictureSettings & settings, std::vector<fs::path> pictures)
{
  for (fs::path & path : pictures)
  {
    path.replace_extension(".dcm");
  }
  return settings.writesDicom ? pictures : std::vector<fs::path>();
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
StageFilesBeside(const std::vector<Picture> & pictures,
                 const PictureSettings & settings,
                 const std::optional<DicomStudy> & study,
                 const std::vector<fs::path> & dicomPaths,
                 double secondsPerFrame,
                 const Events & events,
                 OutputFiles & outputs)
{
  constexpr int side = 320; // pixels
  if (!pictures.empty() && !settings.thumbnail.empty())
  {
    StagePicture(Shrink(pictures.front(), side), settings.thumbnail, outputs.staged, {});
    AddOutputs({ settings.thumbnail }, "thumbnail", outputs.made, false);
  }
  if (!study)
  {
    return;
  }
  std::vector<DicomCapture> captures;
  for (const fs::path & path : dicomPaths)
  {
    captures.push_back({ path, {}, secondsPerFrame });
  }
  for (std::size_t n = 0; n < pictures.size(); ++n)
  {
    captures[std::min(n, captures.size() - 1)].frames.push_back(&pictures[n]);
  }
  study->Stage(captures, settings.provenance.software, outputs.staged);
  AddOutputs(dicomPaths, "dicom", outputs.made);
  events.Note("the DICOM files hold the patient's name and the other tags of the scan's patient and study");
}

} // namespace rhombic
