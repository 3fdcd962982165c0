#ifndef rhombicDicomStack_h
#define rhombicDicomStack_h

#include "rhombicDicomSlice.h"
#include "rhombicScanReader.h"
#include "rhombicVolumeGeometry.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** Slices that may be one volume: with the same SeriesInstanceUID, kind, orientation, size and pixel spacing. If two
 * would be at the same position, also with the same image type, echo, time, stack or acquisition, whichever separates
 * them. */
struct DicomSeries
{
  std::string id;   ///< SeriesSummary::id
  std::string kind; ///< SeriesSummary::kind
  std::vector<DicomSlice> slices;
};

/** Splits slices into series, sorted by series number, UID, size, kind and axes, not by file names. Files without UID
 * are separated by folder. */
std::vector<DicomSeries>
GroupIntoSeries(const std::vector<DicomSlice> & slices);

/** The series to read, and the reason. */
struct SeriesChoice
{
  std::size_t index = 0;
  std::string reason;
};

/** The series that \a wanted names (see ScanReadOptions::series). If \a wanted is empty: the only series that can be a
 * volume, or the one that has at least twice as many slices as any other; nothing when there is no such series. Throws
 * Failure(Usage), listing the series, when \a wanted names none or more than one. */
std::optional<SeriesChoice>
FindSeries(const std::vector<DicomSeries> & series, const std::string & wanted, const std::filesystem::path & folder);

/** FindSeries(). Throws Failure: Usage, listing the series, when it finds none; Unreadable when the series can't be a
 * volume. */
SeriesChoice
ChooseSeries(const std::vector<DicomSeries> & series, const std::string & wanted, const std::filesystem::path & folder);

std::vector<SeriesSummary>
Summarize(const std::vector<DicomSeries> & series, std::size_t chosen);

/** The geometry of a stack of slices. */
struct DicomStack
{
  VolumeGeometry geometry;                         ///< sheared when the gantry was tilted
  std::vector<itk::Point<double, 3>> sliceOrigins; ///< see Scan::sliceOrigins
  StackReport report;
  std::vector<std::string> notes;
};

/** Sorts slices of one orientation along their normal and finds the geometry of their volume. The steps between slices
 * are computed from their positions alone.
 *
 * The slices of an even stack are within 0.01 mm (or a tenth of a step) of a line with equal steps; the line need not
 * be the normal. A gap is a step of at least 1.9 times the usual step on both its sides (so that a change from one
 * block of slices to the next is no gap), or a whole multiple of the median step with median steps on both its sides.
 * All other stacks are uneven, and their slices keep their own positions.
 *
 * Throws Failure(Geometry), naming files: when a slice has no plane, there is only one slice, two are at the same
 * position, one is shifted sideways against the next by a pixel more than the median shift, or the tilt is more than 60
 * degrees; and, unless the options accept them, for gaps, for tilts of more than 0.001 rad and for uneven steps. */
DicomStack
StackSlices(std::vector<DicomSlice> & slices, const ScanReadOptions & options);

/** The differences of adjacent numbers. */
std::vector<double>
StepsOf(const std::vector<double> & distances);

/** Whether two slices are at the same position along their normal, within a hundredth of the median step or 1e-6 mm. */
bool
HaveDuplicates(const std::vector<DicomSlice> & slices);

/** The rescaled values of a stack of slices. */
struct DicomPixels
{
  ScanImage image; ///< unset when files failed
  std::optional<double> paddingValue;
  std::size_t numberOfPaddingSamples = 0;
  std::map<std::filesystem::path, std::string> failures; ///< a sentence for each unreadable file
};

/** The volume of slices without voxels, in the pixel type that ReadDicomPixels() tries first. Values beyond int16
 * become uint16 or int32. */
ScanImage
NewDicomImage(const std::vector<DicomSlice> & slices, const VolumeGeometry & geometry);

/** Whether the pixel type of NewDicomImage() holds all values that the headers allow. */
bool
HoldsAllValues(const ScanImage & image, const std::vector<DicomSlice> & slices);

/** Reads slices in their order into one volume; their files must have no pixelDamage. Uncompressed pixels are read
 * here, the others by child processes, as many files at once as there are threads. Padding is replaced by the lowest
 * other value. It is kept when there is only one other value or padding is the next value below the others: then it is
 * the background of a mask or label map. A volume that takes more memory than the options allow is put into a temporary
 * file. Throws Failure(Memory) when a file's own pixels do not fit, or there is no room. */
DicomPixels
ReadDicomPixels(const std::vector<DicomSlice> & slices,
                const VolumeGeometry & geometry,
                const ScanReadOptions & options);

/** Where ReadDicomPixels() will put the pixels, if they fit into the type that is tried first. Throws Failure(Memory)
 * as it does. */
VoxelPlace
FindPlaceOfPixels(const std::vector<DicomSlice> & slices,
                  const VolumeGeometry & geometry,
                  const ScanReadOptions & options);

/** Opens the frames of a DICOM segmentation of type BINARY or LABELMAP (PS3.3, A.51 and A.91) as one label map: fills
 * image, labels and notes of \a scan. Voxels of no segment are 0; where segments overlap, the later frame counts.
 * Slices without a frame are empty, as in the standard: the distances of frames must be whole multiples of the smallest
 * one, or of the step that SpacingBetweenSlices and SliceThickness agree on. Throws Failure: Unreadable, Geometry, and
 * Memory when the label map takes more than \a maximumMemory bytes (see ScanReadOptions). */
UnreadScan
OpenDicomSegmentation(const std::vector<DicomSlice> & frames, std::uintmax_t maximumMemory, Scan scan);

} // namespace rhombic

#endif
