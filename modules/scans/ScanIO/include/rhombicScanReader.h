#ifndef rhombicScanReader_h
#define rhombicScanReader_h

#include "rhombicMappedVoxels.h"

#include "itkImageRegion.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace rhombic
{

/** \class RawLayout
 * \brief What a file of bare voxels does not tell: x fastest, z slowest, nothing before and nothing behind. */
struct RawLayout
{
  std::array<std::size_t, 3> size{}; ///< along x, y and z
  itk::IOComponentEnum type = itk::IOComponentEnum::UNKNOWNCOMPONENTTYPE;
  bool isBigEndian = false;
};

/** \class ScanReadOptions
 * \brief Choices of a series or volume, irregular input to accept, and limits. */
struct ScanReadOptions
{
  /** How to treat irregular input. */
  enum class Policy
  {
    Refuse,
    Accept
  };

  /** The DICOM series of a folder: its SeriesSummary::id, its SeriesInstanceUID, its position in the list (from 1), or
   * its SeriesNumber. Empty, the default: the only series, or the one that has at least twice as many slices as any
   * other. */
  std::string series;

  /** For stacks of slices that are tilted, and for sheared volumes. When accepted, their direction is sheared. */
  Policy onTilted = Policy::Accept;

  /** For stacks of slices that are unevenly spaced without a gap. When accepted, they have Scan::sliceOrigins. */
  Policy onUneven = Policy::Refuse;

  /** For stacks with missing slices. When accepted, the other slices are at Scan::sliceOrigins. */
  Policy onGap = Policy::Refuse;

  /** The volume of a file that holds several, from 0. */
  std::optional<std::size_t> frame;

  /** For files of several volumes without a \a frame. When accepted, the first volume is read. */
  Policy onSeveralFrames = Policy::Refuse;

  /** The level of the pyramid of an OME-Zarr image, from 0, the finest. Other formats have level 0 only. */
  std::size_t level = 0;

  /** The size of a voxel along x, y and z in mm, for files of bare voxels, pictures (in place of what OME-XML in TIFF
   * files tells), and OME-Zarr images that do not tell it; an error for others. */
  std::optional<std::array<double, 3>> voxelSize;

  /** For a file of bare voxels, whatever its name; needs the \a voxelSize. Nothing, the default, for other files. */
  std::optional<RawLayout> raw;

  /** For DICOM files of one slice. When accepted, they are volumes of one slice, in which padding is left as it is. Its
   * step is SpacingBetweenSlices for MR and 1 mm for others, as by itk::GDCMImageIO. */
  Policy onSingleSlice = Policy::Refuse;

  /** Whether Analyze 7.5 files are read, whose orientation is unknown. */
  bool acceptsAnalyze = false;

  /** Whether symbolic links in folders are followed. */
  bool followsLinks = false;

  /** The largest memory of the volume in bytes; 0, the default: half of the free memory. */
  std::uintmax_t maximumMemory = 0;

  /** The folder of temporary files, for what does not fit; empty, the default: the one that TMPDIR names, else /tmp. */
  std::filesystem::path temporaryFolder;

  /** Called on the calling thread with the progress of reading the voxels, from 0 to 1; may be empty. */
  std::function<void(double)> progress;
};

/** The voxels of a file in the type in which it stores them, or FLOAT where it scales them. */
struct NativeVoxels
{
  itk::IOComponentEnum type = itk::IOComponentEnum::UNKNOWNCOMPONENTTYPE;
  bool areReadInPart = false; ///< whether a region takes only its own share of the file; otherwise it takes all of it

  /** Reads the voxels of a region of the image, x fastest, into \a buffer. Values that are not finite are replaced by
   * the volume's lowest other value. Throws Failure as ReadVoxels() does. */
  std::function<void(const itk::ImageRegion<3> & region, void * buffer)> read;
};

/** A scan of which the headers were read. */
struct UnreadScan
{
  /** Its image has size, position and the pixel type that is tried first, but no voxels. Notes about the values are
   * missing. */
  Scan scan;

  std::function<void(Scan & scan)> readVoxels; ///< completes a copy of \a scan, any number of times

  /** Where \a readVoxels will put the voxels; empty where it is memory, if they fit. Throws Failure(Memory) as that
   * does.
   */
  std::function<VoxelPlace()> findPlace{};

  bool isTypeCertain = true; ///< whether the headers tell that the voxels fit into the pixel type of \a scan

  std::optional<NativeVoxels> native = std::nullopt; ///< of formats other than DICOM, of one volume
};

/** Opens a scan or label map: a folder of DICOM slices, searched with its subfolders; a DICOM file that holds a volume
 * (enhanced multi-frame, or a segmentation); a folder of OME-Zarr 0.4 (OMEZarrImage); a folder of grey pictures of one
 * size (TIFF, PNG, JPEG 2000, BMP), which are slices in the order of the numbers in their names; a TIFF file of several
 * pages of one size, which are slices; a file of bare voxels
 * (ScanReadOptions::raw); or a NIfTI-1 or -2 (.nii, .hdr with .img, either with .gz), NRRD (.nrrd, .nhdr) or MetaImage
 * (.mha, .mhd) file. A folder of such files without any DICOM file holds masks, and label maps if need be, of one grid:
 * they are read as one label map. A label keeps its value, from 1 to 65,535, if no label before it has the same;
 * otherwise it gets the number after the largest one so far. Labels that overlap, there, in a DICOM segmentation or in
 * the layers of a .seg.nrrd, are in layers (Scan::furtherLayers).
 *
 * Values are rescaled by the slope and intercept of the file (to HU for CT). The pixel type is the stored one where
 * ScanImage has it and rescaling keeps it; otherwise int8 becomes int16; uint32, int64 and uint64 become int32 if all
 * values fit and float if not; double becomes float; rescaled DICOM integers become the first of int16, uint16 and
 * int32 that holds all values, or float where slope or intercept is no whole number; rescaled NIfTI becomes float.
 * Padding and values that are not finite are replaced by the lowest other value.
 *
 * The geometry is the file's, in LPS millimetres, never assumed. DICOM slices are placed by ImagePositionPatient,
 * ImageOrientationPatient and PixelSpacing only, each within 0.01 mm of the volume's affine or else in
 * Scan::sliceOrigins. NIfTI volumes are placed by the sform, else the qform, else along the LPS axes and marked as not
 * oriented.
 *
 * Every length in a header is checked against the file's size, and the memory for the voxels against the limit before
 * it is allocated: those of more than half of it are mapped (see IsMapped()). What only a library can unpack is
 * unpacked in child processes with limits (SandboxRun), so that damaged files can't end the process.
 *
 * Throws Failure: NotFound (no such path, or no scan in the folder), Usage (no such series or frame, or more than one
 * to choose from), Unreadable (damaged, or colour, vectors, no image...), Geometry, Memory.
 *
 * Thread safe. */
UnreadScan
OpenScan(const std::filesystem::path & path, const ScanReadOptions & options = {});

/** Reads the voxels, too. Throws Failure as OpenScan() does. The geometry is that of the headers, but where gaps are
 * accepted and files turn out to be damaged, whose slices are then left out. */
Scan
ReadVoxels(const UnreadScan & file);

/** The series that OpenScan() finds at this path, from headers alone. SeriesSummary::problem is the reason for which it
 * would refuse a series, in a sentence that may name files. The chosen series is the one that it would open; none is
 * chosen when it would refuse to choose.
 *
 * Throws Failure: NotFound, Usage (ScanReadOptions::series names none), Unreadable (a file that is no DICOM image). */
SeriesList
ListSeries(const std::filesystem::path & path, const ScanReadOptions & options = {});

/** Whether a path is a folder and not a file. Throws Failure: NotFound; Unreadable (a device
 * or pipe, or in a folder that may not be entered). */
bool
IsFolder(const std::filesystem::path & path);

/** A path's extension in lower case, including the part before ".gz": ".nii", ".nii.gz". */
std::string
VolumeExtension(const std::filesystem::path & path);

/** "NIfTI", "NRRD" or "MetaImage" by the extension, in upper or lower case; empty for others. */
std::string
VolumeFormatOf(const std::filesystem::path & path);

/** \class DicomExamination
 * \brief What a DICOM scan says about its values, the region it shows, and the space it lies in. */
struct DicomExamination
{
  std::string bodyPart; ///< DICOM's term (0018,0015) in upper case: HEAD, ABDOMEN, ...; empty if unknown
  std::string units;    ///< of a PET's values (0054,1001): "Bq/ml", "g/ml", "counts", ...; empty if unknown

  /** The UID (0020,0052) of the space of its positions; empty if unknown. To be compared, and neither shown nor
   * written.
   */
  std::string frameOfReference;
};

/** Reads the first file of a scan; all texts are empty for other formats than DICOM. */
DicomExamination
ReadDicomExamination(const Scan & scan);

} // namespace rhombic

#endif
