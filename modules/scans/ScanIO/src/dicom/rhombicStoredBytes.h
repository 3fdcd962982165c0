#ifndef rhombicStoredBytes_h
#define rhombicStoredBytes_h

#include "rhombicDicomSlice.h"

#include <vector>

namespace rhombic
{

/** \a size bytes of a file's uncompressed pixels from \a offset on, in the byte order of this machine. Throws
 * Failure(Unreadable) when the file ends before. */
std::vector<std::byte>
ReadStoredBytes(const DicomImageFile & file, std::uintmax_t offset, std::size_t size);

} // namespace rhombic

#endif
