#ifndef rhombicScan_h
#define rhombicScan_h

#include "rhombicLabelTable.h"
#include "rhombicPixelTypes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** A volume in the pixel type it was stored with, in LPS millimetres. */
using ScanImage = PixelTypes::AnyImage<CartesianImage>;

/** \class SeriesSummary
 * \brief One of the DICOM series in a folder. Holds nothing about the patient.
 *
 * Thread safety: a value. */
struct SeriesSummary
{
  std::string id;           ///< made from a hash of the SeriesInstanceUID; the same wherever the files are
  std::size_t number = 0;   ///< place in the list, from 1
  std::string seriesNumber; ///< as the scanner counted (0020,0011); may be empty or not unique
  std::string modality;     ///< CT, MR, ...; may be empty
  std::string kind;         ///< what tells it from others of the same scan: ImageType, echo, ...; may be empty
  std::size_t numberOfFiles = 0;
  std::array<std::size_t, 3> size{}; ///< columns, rows, slices
  std::array<double, 3> spacing{};   ///< between them, in mm; 0, which ReadScan() leaves, when it is not known
  std::string problem;               ///< why it can't be read, as "it is ..." or a sentence; empty when it can
  bool chosen = false;               ///< whether it is the one that was read
};

/** \class SeriesList
 * \brief The DICOM series in a folder or file, and what else is there.
 *
 * Thread safety: a value. */
struct SeriesList
{
  std::vector<SeriesSummary> series; ///< with spacings; empty for other formats than DICOM
  std::size_t filesConsidered = 0;   ///< see Scan, as for the next three
  std::map<std::string, std::size_t> filesSkipped;
  std::vector<std::string> notes;
  std::vector<std::string> fileNotes;
};

/** Slices that follow each other at the same distance. Thread safety: a value. */
struct SliceBlock
{
  std::size_t numberOfSteps = 0;
  double step = 0; ///< along the slices' normal, in mm
};

/** Slices that are missing from a stack. Thread safety: a value. */
struct SliceGap
{
  double position = 0; ///< of the slice before the gap along the slices' normal, in mm
  double step = 0;     ///< to the slice behind it, in mm
  std::size_t numberOfMissing = 0;
};

/** How a DICOM volume is stacked. Thread safety: a value. */
struct StackReport
{
  double tiltDegrees = 0;   ///< between the line of the slices and their normal
  double firstPosition = 0; ///< of the first and the last slice along the normal, in mm
  double lastPosition = 0;
  std::vector<SliceBlock> blocks; ///< one for an even stack
  std::vector<SliceGap> gaps;
};

/** Which of a NIfTI file's affines was used. Thread safety: a value. */
struct AffineReport
{
  std::string source;      ///< "sform", "qform" or "none"
  double disagreement = 0; ///< of the other one at the volume's corners, in mm
};

/** \class Scan
 * \brief A volume and what is known about it. Holds nothing about the patient.
 *
 * Thread safety: any number of threads may read a scan. A filter that gets its image as input counts as a writer, as it
 * sets the image's requested region; copies share the image. */
struct Scan
{
  /** With an empty metadata dictionary. Its direction may be sheared (a tilted gantry, a sheared affine). */
  ScanImage image;

  /** Where the first sample of each slice is when the slices are not evenly placed; empty otherwise. All slices have
   * the image's in-plane axes; its third axis then leads from the first to the last slice. */
  std::vector<itk::Point<double, 3>> sliceOrigins;

  /** Names and colours of a label map's values, where its file has them; empty for other scans. */
  LabelTable labels;

  std::string format;     ///< "DICOM", "NIfTI", "NRRD" or "MetaImage"
  bool isOriented = true; ///< false when the file does not say how it lies in the patient: left and right are a guess
  std::string modality;   ///< DICOM's: CT (values are HU), MR, ...; empty when unknown
  std::string encoding;   ///< transfer syntax, or compression of the voxels, in words
  std::vector<SeriesSummary> series;               ///< all in the folder; empty for other formats than DICOM
  std::size_t filesConsidered = 0;                 ///< in the folder, and its subfolders; 0 for other formats
  std::map<std::string, std::size_t> filesSkipped; ///< how many files of a folder were left out, by reason
  std::string choice;                              ///< why the series that was read was chosen
  std::size_t numberOfFrames = 1;                  ///< volumes in the file
  std::size_t frame = 0;                           ///< which of them was read, from 0
  std::optional<StackReport> stack;                ///< of DICOM volumes
  std::optional<AffineReport> affine;              ///< of NIfTI volumes
  std::string scaling;                             ///< from stored to rescaled values, in words; empty for none
  std::optional<double> paddingValue; ///< of samples outside the scanner's view, rescaled; the lowest other value took
                                      ///< their place
  std::size_t numberOfPaddingSamples = 0;
  std::vector<std::string> notes;     ///< what the reader had to assume, repair or leave out, a sentence each
  std::vector<std::string> fileNotes; ///< the same about single files, with their names: for the person at the
                                      ///< keyboard, but for no output, as a file's name may be the patient's
};

/** Size, origin, spacing and direction, whatever the pixel type. */
const itk::ImageBase<3> &
GeometryOf(const ScanImage & image);
const itk::ImageBase<3> &
GeometryOf(ScanImage &&) = delete; // it would outlive the image

/** "uint8", "int16", "uint16", "int32" or "float". */
std::string
PixelTypeName(const ScanImage & image);

/** The volume of a voxel of each slice, in mm^3; in an unevenly spaced stack a voxel reaches halfway to the next
 * slices.
 */
std::vector<double>
VoxelVolumes(const Scan & scan);

} // namespace rhombic

#endif
