#ifndef rhombicDicomSlice_h
#define rhombicDicomSlice_h

#include "itkPoint.h"
#include "itkVector.h"

#include <filesystem>
#include <optional>
#include <string>

namespace rhombic
{

/** Where a slice is, in LPS millimetres. */
struct SlicePlane
{
  itk::Point<double, 3> position;    ///< centre of the first pixel
  itk::Vector<double, 3> columnStep; ///< from a pixel to the next in its row
  itk::Vector<double, 3> rowStep;    ///< from a row to the next
};

/** What the header of one DICOM file says. */
struct DicomSlice
{
  std::filesystem::path path;
  std::string seriesUID;
  std::string seriesNumber;
  std::string modality;
  unsigned int columns = 0;
  unsigned int rows = 0;
  unsigned int bitsAllocated = 0;
  unsigned int bitsStored = 0;
  bool isSigned = false;
  bool isImage = true; ///< false for reports, plans and the like
  double slope = 1;
  double intercept = 0;
  std::optional<SlicePlane> plane; ///< absent when the header does not give it
  std::string planeProblem;        ///< why it is absent
  std::string refusal;             ///< why it can't be a slice of a volume ("it is ..."); empty when it can
};

/** Reads the header of a file; nothing when the file is not DICOM. Files on which GDCM is known to abort are told by
 * their first bytes and count as not DICOM. */
std::optional<DicomSlice>
ReadDicomSlice(const std::filesystem::path & path);

} // namespace rhombic

#endif
