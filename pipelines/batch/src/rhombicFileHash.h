#ifndef rhombicFileHash_h
#define rhombicFileHash_h

#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** The MD5 hash of the contents of files, one after the other, in hexadecimal digits. A file that can't be read counts
 * as empty. */
std::string
HashFiles(const std::vector<std::filesystem::path> & files);

/** A hash of the paths, sizes and times of change of files: when it is the same, so are their contents. */
std::string
HashFileStates(const std::vector<std::filesystem::path> & files);

} // namespace rhombic

#endif
