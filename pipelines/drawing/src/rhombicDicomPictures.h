#ifndef rhombicDicomPictures_h
#define rhombicDicomPictures_h

#include "rhombicDicomCapture.h"
#include "rhombicEvents.h"
#include "rhombicPictureSource.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** The DICOM files beside pictures: with .dcm in place of their extensions. */
std::vector<std::filesystem::path>
DicomPathsOf(const std::vector<std::filesystem::path> & pictures);

/** The study that pictures are added to. Throws Failure as DicomStudy does, and Usage for surface files, and for a path
 * in the scan's own folder. */
DicomStudy
OpenStudy(const PictureSource & source, const std::vector<std::filesystem::path> & paths);

/** Writes each picture as a DICOM file, or with one path all as the frames of one file. Throws Failure. */
void
StageDicom(const DicomStudy & study,
           const std::vector<Picture> & pictures,
           const std::vector<std::filesystem::path> & paths,
           double secondsPerFrame,
           const std::string & software,
           const Events & events,
           StagedFiles & staged);

} // namespace rhombic

#endif
