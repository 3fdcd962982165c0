#ifndef rhombicPictureFiles_h
#define rhombicPictureFiles_h

#include "rhombicDicomCapture.h"
#include "rhombicPictureIO.h"
#include "rhombicRenderScan.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Files beside pictures and pages: as DICOM, and small. */

/** A path with a part added to its stem. */
std::filesystem::path
WithPart(const std::filesystem::path & path, const std::string & part);

/** The DICOM files beside pictures, if any are written: with .dcm in place of their extensions. */
std::vector<std::filesystem::path>
DicomPathsOf(const PictureSettings & settings, std::vector<std::filesystem::path> pictures);

/** The study that DICOM files are added to; nothing without any. Throws Failure as DicomStudy does, and Usage for
 * surface files, and for a path in the scan's own folder. */
std::optional<DicomStudy>
OpenStudy(const PictureSource & source, const std::vector<std::filesystem::path> & dicomPaths);

/** Writes the thumbnail, the first picture with at most 320 pixels a side, made of means of blocks; and, if there is a
 * study, each picture as a DICOM file, or with one path all as the frames of one file. Throws Failure. */
void
StageFilesBeside(const std::vector<Picture> & pictures,
                 const PictureSettings & settings,
                 const std::optional<DicomStudy> & study,
                 const std::vector<std::filesystem::path> & dicomPaths,
                 double secondsPerFrame,
                 const Events & events,
                 OutputFiles & outputs);

} // namespace rhombic

#endif
