#ifndef rhombicVolumeFrame_h
#define rhombicVolumeFrame_h

#include "rhombicScanReader.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace rhombic
{

/** The product of sizes; nothing when it exceeds 2^60. */
std::optional<std::uintmax_t>
ProductOf(const std::vector<std::uintmax_t> & sizes);

/** Sets Scan::frame, the volume of a file to read, and Scan::numberOfFrames. Throws Failure: Unreadable when there are
 * several volumes without a choice, unless the options accept the first; Usage when there is no such volume. */
void
ChooseFrame(std::uintmax_t numberOfFrames,
            const ScanReadOptions & options,
            const std::filesystem::path & path,
            Scan & scan);

} // namespace rhombic

#endif
