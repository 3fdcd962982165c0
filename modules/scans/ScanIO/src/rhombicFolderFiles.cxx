#include "rhombicFolderFiles.h"

#include "rhombicFailure.h"

#include <algorithm>
#include <set>

#include <unistd.h>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** Walks a folder, depth first. */
class Walk
{
public:
  Walk(const fs::path & root, bool followsLinks)
    : m_Root(root)
    , m_FollowsLinks(followsLinks)
  {}

  FolderFiles
  Run()
  {
    this->Enter(m_Root, 0);
    std::sort(m_Files.paths.begin(), m_Files.paths.end());
    return m_Files;
  }

private:
  void
  Enter(const fs::path & folder, int depth)
  {
    constexpr int deepest = 16;
    constexpr std::size_t most = 200000;
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    if (error)
    {
      ++m_Files.unreadableFolders;
      return;
    }
    for (const fs::directory_iterator end; entry != end; entry.increment(error))
    {
      this->Visit(*entry, depth);
      if (depth > deepest || m_Files.paths.size() > most)
      {
        throw Failure(FailureKind::Usage,
                      "Gave up searching " + m_Root.string() + ": it holds more than " + std::to_string(deepest) +
                        " levels of folders or " + std::to_string(most) + " files; give the folder of one scan.");
      }
    }
  }

  void
  Visit(const fs::directory_entry & entry, int depth)
  {
    std::error_code error;
    if (entry.is_symlink(error))
    {
      if (!m_FollowsLinks)
      {
        ++m_Files.symbolicLinks;
        return;
      }
    }
    if (m_FollowsLinks && !m_Seen.insert(fs::canonical(entry.path(), error)).second)
    {
      return;
    }
    if (entry.is_directory(error))
    {
      this->Enter(entry.path(), depth + 1);
    }
    else if (entry.is_regular_file(error))
    {
      m_Files.paths.push_back(entry.path());
    }
    else
    {
      ++m_Files.others;
    }
  }

  fs::path m_Root;
  bool m_FollowsLinks;
  std::set<fs::path> m_Seen; ///< when links are followed
  FolderFiles m_Files;
};

} // namespace

FolderFiles
ListFiles(const fs::path & folder, bool followsLinks)
{
  return Walk(folder, followsLinks).Run();
}

bool
IsReadable(const fs::path & path)
{
  return access(path.c_str(), R_OK) == 0;
}

} // namespace rhombic
