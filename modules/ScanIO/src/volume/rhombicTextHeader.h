#ifndef rhombicTextHeader_h
#define rhombicTextHeader_h

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** The text without the blanks around it. */
std::string
Trimmed(const std::string & text);

std::string
LowerCase(std::string text);

std::vector<std::string>
WordsOf(const std::string & text);

/** The numbers of a text that blanks, commas and parentheses part, whatever the locale; nothing when another character
 * is in it. Numbers may be "nan" or "inf". */
std::optional<std::vector<double>>
NumbersOf(const std::string & text);

/** Likewise for whole numbers from 0 to 2^31 - 1. */
std::optional<std::vector<std::uintmax_t>>
CountsOf(const std::string & text);

/** The sizes of the axes of a volume, or of several in one file, from the texts of a header: their number, and them.
 * Throws Failure(Unreadable), naming \a path, when they contradict each other or make no volume. */
std::vector<std::uintmax_t>
AxisSizes(const std::string & dimensionText, const std::string & sizesText, const std::filesystem::path & path);

/** The file of voxels that the header file \a header names, which has to be a regular file in the header's folder or
 * below it: headers from elsewhere must not lead to any file of this machine. Throws Failure(Unreadable). */
std::filesystem::path
DetachedFile(const std::filesystem::path & header, const std::string & name);

} // namespace rhombic

#endif
