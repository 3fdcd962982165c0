#ifndef rhombicDicomDecoding_h
#define rhombicDicomDecoding_h

#include <cstddef>
#include <filesystem>

namespace rhombic
{

/** Unpacks all frames of a DICOM file with compressed pixels through GDCM, which damaged files can crash: see
 * VoxelDecoder. \a size is what must come out. Throws Failure(Unreadable), naming the file. */
void
DecodeDicomFile(const std::filesystem::path & path, std::byte * voxels, std::size_t size);

} // namespace rhombic

#endif
