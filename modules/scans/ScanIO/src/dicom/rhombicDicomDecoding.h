#ifndef rhombicDicomDecoding_h
#define rhombicDicomDecoding_h

#include <cstddef>
#include <filesystem>

namespace rhombic
{

/** Unpacks all frames of a DICOM file with compressed pixels by GDCM, which damaged files can crash (see VoxelDecoder),
 * to \a size bytes, and returns \a size. Throws Failure(Unreadable), naming the file, also for another size. */
std::size_t
DecodeDicomFile(const std::filesystem::path & path, std::byte * voxels, std::size_t size);

} // namespace rhombic

#endif
