#ifndef rhombicScanReader_h
#define rhombicScanReader_h

#include "rhombicScan.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace rhombic
{

class VoxelDecoder;

/** \class ScanReadOptions
 * \brief What to read when there is a choice, and what to accept.
 *
 * Thread safety: a value, whose copies share the decoder. */
struct ScanReadOptions
{
  /** What to do with what is not as it should be. */
  enum class Policy
  {
    Refuse,
    Accept
  };

  /** Which DICOM series of a folder: its SeriesSummary::id, its SeriesInstanceUID, its place in the list (from 1), or
   * its SeriesNumber. Empty, the default: the only one, or that with at least twice as many slices as any other. */
  std::string series;

  /** Stacks of slices that are tilted or unevenly spaced, and sheared volumes: accepted (Scan::sliceOrigins, a sheared
   * direction) or refused. */
  Policy onIrregular = Policy::Accept;

  /** Stacks from which slices are missing: refused, or accepted with the others in their true positions. */
  Policy onGap = Policy::Refuse;

  /** Which volume of a file that holds several, from 0. */
  std::optional<std::size_t> frame;

  /** Files of several volumes when none of them is asked for: refused, or the first is read. */
  Policy onSeveralFrames = Policy::Refuse;

  /** Whether Analyze 7.5 files are read, whose orientation is unknown. */
  bool acceptsAnalyze = false;

  /** Whether symbolic links in folders are followed. */
  bool followsLinks = false;

  /** Bytes that the volume may take; 0, the default: half of the memory that is free. */
  std::uintmax_t maximumMemory = 0;

  /** What unpacks voxels through libraries that damaged files can crash; none: this process. Not owned. */
  VoxelDecoder * decoder = nullptr;

  /** Told, on the calling thread, how much of a DICOM series is read, from 0 to 1; may be empty. */
  std::function<void(double)> progress;
};

/** Reads a scan or label map: a folder of DICOM slices, searched with its subfolders; a DICOM file that holds a volume
 * (enhanced multi-frame, or a segmentation); or a NIfTI-1 or -2 (.nii, .hdr with .img, either with .gz), NRRD (.nrrd,
 * .nhdr) or MetaImage (.mha, .mhd) file.
 *
 * Values are rescaled as the file says (HU for CT). The pixel type is the stored one where ScanImage has it and
 * rescaling keeps it; otherwise int8 becomes int16; uint32, int64 and uint64 become int32 if all values fit and float
 * if not; double becomes float; rescaled DICOM integers become the first of int16, uint16 and int32 that holds
 * all values, or float where slope or intercept is no whole number; rescaled NIfTI becomes float. Padding and values
 * that are not finite get the lowest other value.
 *
 * The geometry is the file's, in LPS millimetres, never assumed: slices come from ImagePositionPatient,
 * ImageOrientationPatient and PixelSpacing only, every one within 0.01 mm of the volume's affine or in
 * Scan::sliceOrigins; NIfTI from its sform, else its qform, else along LPS axes, not oriented.
 *
 * Headers are parsed by code that believes no length they claim, and the memory that voxels need is asked for before it
 * is allocated. Voxels that only a library can unpack go through ScanReadOptions::decoder; without one,
 * damaged files may still end the process inside GDCM or ITK.
 *
 * Throws Failure: NotFound (no such path, or no scan in the folder), Usage (no such series or frame, or more than one
 * to choose from), Unreadable (damaged, or colour, vectors, no image...), Geometry, Memory.
 *
 * Thread safe, also with a common decoder. While it runs, warnings of ITK and GDCM are off for the whole process. */
Scan
ReadScan(const std::filesystem::path & path, const ScanReadOptions & options = {});

/** The series that ReadScan() finds at this path, from headers alone. Their problems are why ReadScan() would refuse
 * them, in sentences that may name files; damage that only unpacking finds is not among them. The chosen one is that
 * which ReadScan() would read; there is none when it would refuse to choose.
 *
 * Throws Failure: NotFound, Usage (ScanReadOptions::series names none), Unreadable (a file that is no DICOM image).
 * Thread safe, as ReadScan(). */
SeriesList
ListSeries(const std::filesystem::path & path, const ScanReadOptions & options = {});

} // namespace rhombic

#endif
