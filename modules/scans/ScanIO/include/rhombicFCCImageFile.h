#ifndef rhombicFCCImageFile_h
#define rhombicFCCImageFile_h

#include "rhombicPixelTypes.h"

#include "itkFCCImage.h"

#include <filesystem>

namespace rhombic
{

class StagedFiles;

/** A lattice volume of any of the pixel types that scans have. */
using FCCVolume = PixelTypes::AnyImage<itk::FCCImage>;

/** Writes a lattice volume as a NRRD file (raw, little-endian) with its lattice in key/value pairs; the format is
 * described in modules/scans/ScanIO/README.md. The file appears whole or not at all. Throws Failure(Output), also for volumes
 * that could not be read back: a null pointer, an image without samples or with samples outside its buffer, geometry
 * that is not finite. */
void
WriteFCCImage(const FCCVolume & volume, const std::filesystem::path & path);

/** As WriteFCCImage(), but the file appears with all others of \a staged. */
void
StageFCCImage(const FCCVolume & volume, const std::filesystem::path & path, StagedFiles & staged);

/** Reads a file of WriteFCCImage(), bit for bit, or one of this format from another program. Throws Failure(NotFound)
 * when there is no such file, and Failure(Unreadable) when it is damaged, too short, or not a volume on this lattice.
 */
FCCVolume
ReadFCCImage(const std::filesystem::path & path);

/** Whether a file's header says that it is a lattice volume. False for files that can't be read. */
bool
IsFCCImageFile(const std::filesystem::path & path);

} // namespace rhombic

#endif
