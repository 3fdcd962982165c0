#include "rhombicDicomPictures.h"

#include "rhombicFailure.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace rhombic
{

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

DicomStudy
OpenStudy(const PictureSource & source, const std::vector<fs::path> & paths)
{
  if (!source.surfaceFiles.empty())
  {
    throw Failure(FailureKind::Usage,
                  "Surface files name no study that DICOM pictures could belong to; leave out --dicom-sc, or draw from "
                  "the folder of the DICOM scan.");
  }
  DicomStudy study(source.scan.path, source.scan.read);
  for (const fs::path & path : paths)
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

} // namespace rhombic
