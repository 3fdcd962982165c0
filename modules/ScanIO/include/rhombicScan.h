#ifndef rhombicScan_h
#define rhombicScan_h

#include "itkImage.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace rhombic
{

/** A volume in the pixel type it was stored with, in LPS millimetres. */
using ScanImage = std::variant<itk::Image<std::uint8_t, 3>::Pointer,
                               itk::Image<std::int16_t, 3>::Pointer,
                               itk::Image<std::uint16_t, 3>::Pointer,
                               itk::Image<std::int32_t, 3>::Pointer,
                               itk::Image<float, 3>::Pointer>;

/** \class SeriesSummary
 * \brief One of the DICOM series in a folder. Holds nothing about the patient. */
struct SeriesSummary
{
  std::string id;           ///< made from a hash of the SeriesInstanceUID; the same wherever the files are
  std::size_t number = 0;   ///< place in the list, from 1
  std::string seriesNumber; ///< as the scanner counted (0020,0011); may be empty or not unique
  std::string modality;     ///< CT, MR, ...; may be empty
  std::size_t numberOfFiles = 0;
  std::array<std::size_t, 3> size{}; ///< columns, rows, files
  bool chosen = false;               ///< whether it is the one that was read
};

/** \class Scan
 * \brief A volume and what is known about its origin. */
struct Scan
{
  ScanImage image;        ///< with an empty metadata dictionary: no patient data travels on
  std::string format;     ///< "DICOM", "NIfTI", "NRRD" or "MetaImage"
  bool isOriented = true; ///< false when the file does not say how it lies in the patient: left and right are a guess
  std::string modality;   ///< DICOM's: CT (values are HU), MR, ...; empty when unknown
  std::vector<SeriesSummary> series; ///< all in the folder; empty for other formats than DICOM
  std::size_t filesSkipped = 0;      ///< files in the folder that are no DICOM images, symbolic links included
  std::vector<std::string> notes;    ///< what the reader had to assume or leave out, a sentence each
};

/** Size, origin, spacing and direction, whatever the pixel type. */
const itk::ImageBase<3> &
GeometryOf(const ScanImage & image);
const itk::ImageBase<3> &
GeometryOf(ScanImage &&) = delete; // it would outlive the image

/** "uint8", "int16", "uint16", "int32" or "float". */
const char *
PixelTypeName(const ScanImage & image);

} // namespace rhombic

#endif
