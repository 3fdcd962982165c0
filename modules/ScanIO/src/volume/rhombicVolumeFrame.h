#ifndef rhombicVolumeFrame_h
#define rhombicVolumeFrame_h

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace rhombic
{

/** The product of sizes, or nothing where it exceeds 2^60. */
std::optional<std::uintmax_t>
ProductOf(const std::vector<std::uintmax_t> & sizes);

/** Which of the volumes of a file to read, from 0. Throws Failure: Unreadable when there are several and none is asked
 * for, Usage when there is no such volume. */
std::uintmax_t
ChooseFrame(std::uintmax_t numberOfFrames,
            const std::optional<std::size_t> & frame,
            const std::filesystem::path & path);

} // namespace rhombic

#endif
