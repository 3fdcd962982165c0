#ifndef rhombicStoredBytes_h
#define rhombicStoredBytes_h

#include "rhombicDicomSlice.h"

#include <vector>

namespace rhombic
{

/** Bytes of the pixels of a file, which are not compressed, in the order of this machine: \a size of them from \a
 * offset on. Throws Failure(Unreadable) when they are not there. */
std::vector<std::byte>
ReadStoredBytes(const DicomImageFile & file, std::uintmax_t offset, std::size_t size);

} // namespace rhombic

#endif
