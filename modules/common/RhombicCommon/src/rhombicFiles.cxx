#include "rhombicFiles.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <itksys/MD5.h>

#include <cerrno>
#include <cstring>
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
    if (!m_FollowsLinks && entry.is_symlink(error))
    {
      ++m_Files.symbolicLinks;
      return;
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

std::ifstream
OpenIfThere(const fs::path & path)
{
  std::ifstream stream(path, std::ios::binary);
  if (!stream.is_open() && errno != ENOENT)
  {
    throw Failure(errno == EMFILE || errno == ENFILE ? FailureKind::Memory : FailureKind::Unreadable,
                  "Cannot read " + path.string() + ": " + std::strerror(errno) + ".");
  }
  return stream;
}

std::string
ReadTextFile(const std::filesystem::path & path, const std::string & kind, std::size_t most)
{
  std::error_code error;
  if (fs::status(path, error).type() == fs::file_type::not_found)
  {
    throw Failure(FailureKind::NotFound, "There is no " + kind + " " + path.string() + "; check the path.");
  }
  std::ifstream file;
  if (std::filesystem::is_regular_file(path, error)) // opening a pipe would wait for its other end
  {
    file.open(path, std::ios::binary);
  }
  if (!file.is_open())
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() + ": it is no file, or not yours to read; name a " + kind + ".");
  }
  std::string text;
  std::string block(std::size_t{ 1 } << 16, '\0');
  while (text.size() <= most && file.read(block.data(), static_cast<std::streamsize>(block.size())).gcount() > 0)
  {
    text.append(block, 0, static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad())
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() + " to its end; is the disk damaged, or the network?");
  }
  text.erase(0, text.size() - WithoutByteOrderMark(text, path.string()).size());
  text.resize(std::min(text.size(), most) + (text.size() > most ? 1 : 0));
  return text;
}

std::string_view
WithoutByteOrderMark(std::string_view text, const std::string & source)
{
  const std::string_view begin = text.substr(0, 2);
  if (begin == "\xFF\xFE" || begin == "\xFE\xFF")
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + source +
                    ": it is text in UTF-16; save it as UTF-8, as spreadsheets do with "
                    "'CSV UTF-8'.");
  }
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.substr(0, mark.size()) == mark ? text.substr(mark.size()) : text;
}

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

struct Digest::State
{
  std::unique_ptr<itksysMD5, decltype(&itksysMD5_Delete)> md5{ itksysMD5_New(), itksysMD5_Delete };
};

Digest::Digest()
  : m_State(std::make_unique<State>())
{
  itksysMD5_Initialize(m_State->md5.get());
}

Digest::~Digest() = default;

void
Digest::Add(const void * bytes, std::size_t size)
{
  constexpr std::size_t most = 1u << 30; // the library counts in int
  for (const auto * next = static_cast<const unsigned char *>(bytes); size > 0;)
  {
    const std::size_t count = std::min(size, most);
    itksysMD5_Append(m_State->md5.get(), next, static_cast<int>(count));
    next += count;
    size -= count;
  }
}

std::string
Digest::GetDigits()
{
  std::string digits(32, '0');
  itksysMD5_FinalizeHex(m_State->md5.get(), digits.data());
  return digits;
}

std::string
HashFiles(const std::vector<std::filesystem::path> & files)
{
  Digest digest;
  std::vector<char> block(1u << 20);
  for (const std::filesystem::path & file : files)
  {
    std::ifstream stream(file, std::ios::binary);
    while (stream)
    {
      stream.read(block.data(), static_cast<std::streamsize>(block.size()));
      digest.Add(block.data(), static_cast<std::size_t>(stream.gcount()));
    }
    if (!stream.is_open() || stream.bad())
    {
      throw Failure(
        FailureKind::Unreadable,
        "Cannot read " + file.string() +
          " again for its hash: it is gone, not yours to read, on a disk that fails, or too many files are open.");
    }
  }
  return digest.GetDigits();
}

std::string
HashFileStates(const std::vector<std::filesystem::path> & files)
{
  std::string states;
  for (const std::filesystem::path & file : files)
  {
    std::error_code error;
    states += file.string() + '\n' + std::to_string(std::filesystem::file_size(file, error)) + ' ' +
              std::to_string(std::filesystem::last_write_time(file, error).time_since_epoch().count()) + '\n';
  }
  return HashText(states);
}

} // namespace rhombic
