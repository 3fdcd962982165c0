#ifndef rhombicFolderFiles_h
#define rhombicFolderFiles_h

#include <cstddef>
#include <filesystem>
#include <vector>

namespace rhombic
{

/** \class FolderFiles
 * \brief The files in a folder and its subfolders. */
struct FolderFiles
{
  std::vector<std::filesystem::path> paths; ///< regular files, sorted
  std::size_t symbolicLinks = 0;            ///< links that were not followed
  std::size_t others = 0;                   ///< devices, pipes and sockets
  std::size_t unreadableFolders = 0;
};

/** Lists a folder and its subfolders. Symbolic links are counted, or followed if \a followsLinks; then each folder and
 * file is listed once, even if several links lead to it. Throws Failure(Usage) for more than 16 levels of folders or
 * 200,000 files. */
FolderFiles
ListFiles(const std::filesystem::path & folder, bool followsLinks = false);

/** Whether the user may read the file. */
bool
IsReadable(const std::filesystem::path & path);

} // namespace rhombic

#endif
