#ifndef rhombicDicomCapture_h
#define rhombicDicomCapture_h

#include "rhombicAtomicFile.h"
#include "rhombicPicture.h"
#include "rhombicScanReader.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rhombic
{

/** \class DicomCapture
 * \brief Pictures of one size, which become one DICOM file. */
struct DicomCapture
{
  std::filesystem::path path;
  std::vector<const Picture *> frames; ///< of three channels; not owned
  double secondsPerFrame = 0.0;        ///< for several frames
};

/** \class DicomStudy
 * \brief The study of a DICOM scan, to which pictures are added as Secondary Capture images. It holds the names of the
 * patient and the study, and writes them to these images only.
 *
 * Thread safety: any number of threads may use one object. */
class DicomStudy
{
public:
  /** Takes patient and study from the first file of the series that OpenScan() opens. Throws Failure: as OpenScan();
   * Usage when the scan is no DICOM; Unreadable when its study has no UID. */
  DicomStudy(const std::filesystem::path & scan, const ScanReadOptions & options);

  /** Throws Failure(Usage) for a path in the scan's own folder, where the file would become part of the scan. */
  void
  CheckPath(const std::filesystem::path & path) const;

  /** Writes the captures as one new series of the study: Secondary Capture for one frame, Multi-frame True Color
   * Secondary Capture for more. The pixels are stored as they are (Explicit VR Little Endian).
   *
   * The same pictures of the same scan give the same bytes: the UIDs are made from a digest of the study, the pictures
   * and \a software ("2.25." and a UUID, PS3.5 B.2), and no date is written but the study's.
   *
   * Throws Failure: Usage for a picture with alpha or for more than 4 GB in a file; Output.
   * \param software name and version of the program */
  void
  Stage(const std::vector<DicomCapture> & captures, const std::string & software, StagedFiles & staged) const;

private:
  std::filesystem::path m_Folder;                ///< of the scan
  std::map<std::uint32_t, std::string> m_Values; ///< of the elements that are copied, by tag
};

} // namespace rhombic

#endif
