#ifndef rhombicTextFile_h
#define rhombicTextFile_h

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

namespace rhombic
{

/** Reads a text file in UTF-8, without its byte order mark, up to \a most bytes; one byte more of longer files.
 * \a kind names it in messages, as "preset file". Throws Failure: NotFound when there is no such file, Unreadable when
 * it is a folder or device, is not the user's to read, or is text in UTF-16. */
std::string
ReadTextFile(const std::filesystem::path & path,
             const std::string & kind,
             std::size_t most = std::numeric_limits<std::size_t>::max());

/** A text without the byte order mark of UTF-8 at its beginning. Throws Failure(Unreadable), naming \a source, for the
 * byte order mark of UTF-16. */
std::string_view
WithoutByteOrderMark(std::string_view text, const std::string & source);

} // namespace rhombic

#endif
