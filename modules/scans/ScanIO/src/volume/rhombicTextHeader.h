#ifndef rhombicTextHeader_h
#define rhombicTextHeader_h

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** The numbers of a text, separated by blanks, commas and parentheses; nothing when the text has anything else. Numbers
 * may be "nan" or "inf". */
std::optional<std::vector<double>>
NumbersOf(const std::string & text);

/** The same for whole numbers from 0 to 2^31 - 1. */
std::optional<std::vector<std::uintmax_t>>
CountsOf(const std::string & text);

/** The number of bytes before the voxels that a header tells: a whole number; 0 for an empty text; -1, for bytes that
 * are not compressed, when the voxels are at the end. Nothing for others. */
std::optional<double>
SkipOf(const std::string & text, bool isDeflated);

/** The sizes of three or four axes (the fourth: several volumes in one file) from a header's texts of their number and
 * the sizes. Throws Failure(Unreadable), naming \a path, when these contradict each other or make no volume. */
std::vector<std::uintmax_t>
AxisSizes(const std::string & dimensionText, const std::string & sizesText, const std::filesystem::path & path);

/** The file of voxels that the header file \a header names. It must be a regular file in the header's folder or below
 * it, so that a header from elsewhere can't name any file of this machine. Throws Failure(Unreadable), also for
 * patterns and lists of files. */
std::filesystem::path
DetachedFile(const std::filesystem::path & header, const std::string & name);

} // namespace rhombic

#endif
