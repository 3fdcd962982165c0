#include "rhombicFolderFiles.h"

#include "rhombicFailure.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace rhombic
{

FolderFiles
ListFiles(const fs::path & folder)
{
  constexpr int deepest = 16;
  constexpr std::size_t most = 200000;

  FolderFiles files;
  for (fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied), end; entry != end;
       ++entry)
  {
    if (entry->is_symlink())
    {
      ++files.symbolicLinks;
    }
    else if (entry->is_regular_file())
    {
      files.paths.push_back(entry->path());
    }
    if (entry.depth() > deepest || files.paths.size() > most)
    {
      throw Failure(FailureKind::Usage,
                    "Gave up searching " + folder.string() + ": it holds more than " + std::to_string(deepest) +
                      " levels of folders or " + std::to_string(most) + " files; give the folder of one scan.");
    }
  }
  std::sort(files.paths.begin(), files.paths.end());
  return files;
}

} // namespace rhombic
