#ifndef rhombicCompressedFile_h
#define rhombicCompressedFile_h

#include <cstdint>
#include <filesystem>
#include <string>

namespace rhombic
{

/** The first \a size bytes of a file, unpacked if it is named .gz; fewer when there are fewer. Throws
 * Failure(Unreadable) when it can't be opened or read, or is compressed without being named so. */
std::string
ReadBeginning(const std::filesystem::path & path, std::size_t size);

/** How many bytes a file holds, unpacked if it is named .gz: then counting ends a little after \a enough, and a stream
 * that is damaged or cut off counts as empty. */
std::uintmax_t
CountBytes(const std::filesystem::path & path, std::uintmax_t enough);

/** How many bytes a zlib or gzip stream that begins at \a offset of a file unpacks to: counting ends at \a enough, and
 * a stream that is damaged or cut off counts up to there. */
std::uintmax_t
CountInflated(const std::filesystem::path & path, std::uintmax_t offset, std::uintmax_t enough);

} // namespace rhombic

#endif
