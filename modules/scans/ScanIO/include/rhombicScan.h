#ifndef rhombicScan_h
#define rhombicScan_h

#include "rhombicLabelTable.h"
#include "rhombicPixelTypes.h"

#include "itkSlicePlacement.h"

#include "itkCommonEnums.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * A scan and its description. */

/** A volume in the pixel type it was stored with, in LPS millimetres. */
using ScanImage = PixelTypes::AnyImage<CartesianImage>;

/** \class SeriesSummary
 * \brief One of the DICOM series in a folder, without anything about the patient. */
struct SeriesSummary
{
  std::string id;           ///< made from a hash of the SeriesInstanceUID; the same wherever the files are
  std::size_t number = 0;   ///< position in the list, from 1
  std::string seriesNumber; ///< as the scanner counted (0020,0011); may be empty or not unique
  std::string modality;     ///< CT, MR, ...; may be empty
  std::string kind;         ///< ImageType, echo, ... that differ from other series of the scan; may be empty
  std::size_t numberOfFiles = 0;
  std::array<std::size_t, 3> size{}; ///< columns, rows, slices
  std::array<double, 3> spacing{}; ///< distances of columns, rows and slices, in mm; 0 when unknown, as from OpenScan()
  std::string problem;             ///< why it can't be read, as "it is ..." or a sentence; empty if it can
  bool chosen = false;             ///< whether it was read
};

/** \class SeriesList
 * \brief The DICOM series in a folder or file, and the other files there. */
struct SeriesList
{
  std::vector<SeriesSummary> series; ///< with spacings; empty for other formats than DICOM
  std::size_t filesConsidered = 0;   ///< as Scan::filesConsidered, and so are the next three
  std::map<std::string, std::size_t> filesSkipped;
  std::vector<std::string> notes;
  std::vector<std::string> fileNotes;
};

/** Consecutive slices at equal distances. */
struct SliceBlock
{
  std::size_t numberOfSteps = 0;
  double step = 0; ///< distance of two slices along their normal, in mm
};

/** A gap in a stack: slices are missing between two others. */
struct SliceGap
{
  double position = 0; ///< position of the last slice before the gap along the slices' normal, in mm
  double step = 0;     ///< distance from that slice to the next, in mm
  std::size_t numberOfMissing = 0;
};

/** The geometry of a stack of DICOM slices. */
struct StackReport
{
  double tiltDegrees = 0;   ///< angle between the line through the slices and their normal
  double firstPosition = 0; ///< positions of the first and the last slice along the normal, in mm
  double lastPosition = 0;
  std::vector<SliceBlock> blocks; ///< one block for an even stack
  std::vector<SliceGap> gaps;
};

/** The affine of a NIfTI file that was used. */
struct AffineReport
{
  std::string source;      ///< "sform", "qform" or "none"
  double disagreement = 0; ///< largest distance to the other affine at the volume's corners, in mm
};

/** \class Scan
 * \brief A volume and its description, without anything about the patient.
 *
 * Thread safety: any number of threads may read a scan. A filter with its image as input writes the scan, because it
 * sets the image's requested region. Copies share the image. */
struct Scan
{
  /** The voxels. The direction may be sheared (a tilted gantry, a sheared affine); the metadata dictionary holds at
   * most a SlicePlacement. */
  ScanImage image;

  /** Of a label map whose labels overlap: further label maps on the grid of \a image. No label is in two of them, and
   * no two labels have the same value. Empty otherwise. */
  std::vector<ScanImage> furtherLayers;

  /** The position of the first voxel of each slice, in LPS mm, when the slices are unevenly spaced; empty otherwise.
   * All slices have the image's in-plane axes; its third axis then leads from the first to the last slice. */
  std::vector<itk::Point<double, 3>> sliceOrigins;

  /** Names and colours of a label map's values, where its file has them; empty for other scans. */
  LabelTable labels;

  std::string format;     ///< "DICOM", "NIfTI", "NRRD", "MetaImage", "OME-Zarr", "pictures" or "raw"
  bool isOriented = true; ///< false when the file has no orientation in the patient: left and right are a guess
  std::string modality;   ///< DICOM's: CT (values are HU), MR, ...; empty when unknown
  std::string encoding;   ///< transfer syntax or compression of the voxels, in words
  std::vector<SeriesSummary> series;               ///< all series in the folder; empty for other formats than DICOM
  std::size_t filesConsidered = 0;                 ///< in the folder and its subfolders; 0 for other formats
  std::map<std::string, std::size_t> filesSkipped; ///< numbers of files that were left out, by reason
  std::string choice;                              ///< why the series that was read was chosen
  std::size_t numberOfFrames = 1;                  ///< volumes in the file
  std::size_t frame = 0;                           ///< the volume that was read, from 0
  std::size_t numberOfLevels = 1;                  ///< of the pyramid of an OME-Zarr image
  std::size_t level = 0;                           ///< the level that was read, from 0
  std::optional<StackReport> stack;                ///< for DICOM volumes
  std::optional<AffineReport> affine;              ///< for NIfTI volumes
  std::string scaling;                ///< how stored values became true ones, in words; empty for unchanged values
  std::optional<double> paddingValue; ///< rescaled value of voxels outside the scanner's view; they were replaced by
                                      ///< the lowest other value
  std::size_t numberOfPaddingSamples = 0;
  std::vector<std::filesystem::path> files; ///< those that hold the volume, sorted; as names for fileNotes
  std::vector<std::string> notes;           ///< sentences about assumptions, repairs and parts that were left out
  std::vector<std::string> fileNotes; ///< sentences about single files, with their names: to be shown, but not written
                                      ///< to outputs, as a file's name may be the patient's
};

/** Size, origin, spacing and direction of an image of any pixel type. */
const itk::ImageBase<3> &
GeometryOf(const ScanImage & image);
const itk::ImageBase<3> &
GeometryOf(ScanImage &&) = delete; // the reference would outlive the image

/** The image of a label map and its further layers. */
std::vector<ScanImage>
LayersOf(const Scan & scan);

/** "uint8", "int16", "uint16", "int32" or "float". */
std::string
PixelTypeName(const ScanImage & image);

/** The same as "uint8" and so on are to ITK; UNKNOWNCOMPONENTTYPE for a null pointer. */
itk::IOComponentEnum
ComponentTypeOf(const ScanImage & image);

/** A copy whose image has size, position and pixel type, but no voxels. */
Scan
WithoutVoxels(const Scan & scan);

/** Whether the slices are tilted, sheared or unevenly spaced. */
bool
IsSlanted(const Scan & scan);

/** Where the scan's slices lie: what SetScan() of the filters to the lattice takes. Throws Failure (Usage) for a scan
 * without an image, as a reader has before UpdateOutputInformation(). */
itk::SlicePlacement
PlacementOf(const Scan & scan);

/** Sets the SlicePlacement of an unevenly spaced scan's image. */
void
AttachPlacement(const Scan & scan);

/** The texts that ScanFileReader documents, for an image's MetaDataDictionary. */
std::map<std::string, std::string>
SummarizeScan(const Scan & scan);

/** The volume of a voxel of each slice, in mm^3. In an unevenly spaced stack, a voxel extends halfway to the adjacent
 * slices. */
std::vector<double>
VoxelVolumes(const Scan & scan);

} // namespace rhombic

#endif
