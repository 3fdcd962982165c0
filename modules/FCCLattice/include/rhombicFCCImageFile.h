#ifndef rhombicFCCImageFile_h
#define rhombicFCCImageFile_h

#include "itkFCCImage.h"

#include <cstdint>
#include <filesystem>
#include <variant>

namespace rhombic
{

class StagedFiles;

/** An FCC image of any of the pixel types that scans have. */
using FCCVolume = std::variant<itk::FCCImage<std::uint8_t>::Pointer,
                               itk::FCCImage<std::int16_t>::Pointer,
                               itk::FCCImage<std::uint16_t>::Pointer,
                               itk::FCCImage<std::int32_t>::Pointer,
                               itk::FCCImage<float>::Pointer>;

/** Writes an FCC image as a NRRD file (raw, little-endian) with its lattice in key/value pairs; the format is described
 * in modules/FCCLattice/README.md. The file appears whole or not at all. Throws Failure(Output), also for what could
 * not be read back: a null pointer, an image without samples or with some that are not in its buffer, and geometry that
 * is not finite. Thread safe for different paths. */
void
WriteFCCImage(const FCCVolume & volume, const std::filesystem::path & path);

/** As WriteFCCImage(), but the file appears with all others of \a staged. */
void
StageFCCImage(const FCCVolume & volume, const std::filesystem::path & path, StagedFiles & staged);

/** Reads what WriteFCCImage() wrote, bit for bit, and such files from other programs (see there). Throws
 * Failure(NotFound) when there is no such file, and Failure(Unreadable) when it is damaged, too short, or not a volume
 * on this lattice. Thread safe. */
FCCVolume
ReadFCCImage(const std::filesystem::path & path);

/** Whether a file says of itself that it is such a volume. False for files that can't be read. Thread safe. */
bool
IsFCCImageFile(const std::filesystem::path & path);

} // namespace rhombic

#endif
