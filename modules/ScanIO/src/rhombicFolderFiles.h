#ifndef rhombicFolderFiles_h
#define rhombicFolderFiles_h

#include <cstddef>
#include <filesystem>
#include <vector>

namespace rhombic
{

/** \class FolderFiles
 * \brief What a folder and its subfolders hold. */
struct FolderFiles
{
  std::vector<std::filesystem::path> paths; ///< regular files, sorted
  std::size_t symbolicLinks = 0;
};

/** Lists a folder and its subfolders. Symbolic links are counted, not followed; devices and pipes are left out, and so
 * are folders that may not be read. Throws Failure(Usage) for more than 16 levels of folders or 200,000 files. */
FolderFiles
ListFiles(const std::filesystem::path & folder);

} // namespace rhombic

#endif
