#ifndef rhombicVolumeFrame_h
#define rhombicVolumeFrame_h

#include "rhombicScanReader.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace rhombic
{

/** The product of sizes, or nothing where it exceeds 2^60. */
std::optional<std::uintmax_t>
ProductOf(const std::vector<std::uintmax_t> & sizes);

/** Chooses which of the volumes of a file to read: Scan::frame. Throws Failure: Unreadable when there are several and
 * none is asked for, unless the options have the first, Usage when there is no such volume. */
void
ChooseFrame(std::uintmax_t numberOfFrames,
            const ScanReadOptions & options,
            const std::filesystem::path & path,
            Scan & scan);

} // namespace rhombic

#endif
