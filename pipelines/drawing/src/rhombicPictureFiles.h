#ifndef rhombicPictureFiles_h
#define rhombicPictureFiles_h

#include "rhombicDicomCapture.h"
#include "rhombicEvents.h"
#include "rhombicPictureIO.h"
#include "rhombicPictureSource.h"
#include "rhombicSidecar.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Files beside pictures and pages: as DICOM, and small. */

/** The DICOM files beside pictures: with .dcm in place of their extensions. */
std::vector<std::filesystem::path>
DicomPathsOf(const std::vector<std::filesystem::path> & pictures);

/** The study that DICOM files are added to; nothing without any. Throws Failure as DicomStudy does, and Usage for
 * surface files, and for a path in the scan's own folder. */
std::optional<DicomStudy>
OpenStudy(const PictureSource & source, const std::vector<std::filesystem::path> & dicomPaths);

/** Writes each picture as a DICOM file, or with one path all as the frames of one file. Throws Failure. */
void
StageDicom(const DicomStudy & study,
           const std::vector<Picture> & pictures,
           const std::vector<std::filesystem::path> & paths,
           double secondsPerFrame,
           const std::string & software,
           const Events & events,
           StagedFiles & staged);

/** Writes the first of some pictures as one of at most 320 pixels a side: means of blocks, and adds it to the
 * outputs. Does nothing without pictures or path. Throws Failure as StagePicture() does. */
void
StageThumbnail(const std::vector<Picture> & pictures,
               const std::filesystem::path & path,
               StagedFiles & staged,
               std::vector<MadeFile> & outputs);

} // namespace rhombic

#endif
