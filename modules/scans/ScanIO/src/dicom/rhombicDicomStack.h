#ifndef rhombicDicomStack_h
#define rhombicDicomStack_h

#include "rhombicDicomSlice.h"
#include "rhombicScanReader.h"
#include "rhombicVolumeGeometry.h"
#include "rhombicVoxelDecoder.h"

#include <cstdint>
#include <map>
#include <vector>

namespace rhombic
{

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

/** Reads slices in their order into one volume; their files must have no pixelDamage. Uncompressed pixels are read
 * here, the others by the options' decoder, which must be set, in as many files at once as it has workers. Padding is
 * replaced by the lowest other value. It is kept when there is only one other value or padding is the next value below
 * the others: then it is the background of a mask or label map. Throws Failure(Memory) when the volume takes more
 * memory than the options allow. */
DicomPixels
ReadDicomPixels(const std::vector<DicomSlice> & slices,
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
