#ifndef rhombicFiles_h
#define rhombicFiles_h

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rhombic
{

/** Opens a file that is read in parts. The stream is not open where there is no such file. Throws Failure where
 * it can't be opened: Memory when too many files are open, else Unreadable. */
std::ifstream
OpenIfThere(const std::filesystem::path & path);

/** Reads a text file in UTF-8, without its byte order mark, up to \a most bytes; one byte more of longer files.
 * \a kind names it in messages, as "preset file". Throws Failure: NotFound when there is no such file, Unreadable when
 * it is a folder or device, is not the user's to read, can't be read to its end, or is text in UTF-16. */
std::string
ReadTextFile(const std::filesystem::path & path,
             const std::string & kind,
             std::size_t most = std::numeric_limits<std::size_t>::max());

/** A text without the byte order mark of UTF-8 at its beginning. Throws Failure(Unreadable), naming \a source, for the
 * byte order mark of UTF-16. */
std::string_view
WithoutByteOrderMark(std::string_view text, const std::string & source);

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

/** A number at an offset in the bytes of a file; \a isSwapped: in the other byte order than this machine's. */
template <typename TNumber>
TNumber
NumberAt(std::string_view bytes, std::size_t offset, bool isSwapped)
{
  char copy[sizeof(TNumber)];
  std::memcpy(copy, bytes.data() + offset, sizeof(TNumber));
  if (isSwapped)
  {
    std::reverse(copy, copy + sizeof(TNumber));
  }
  TNumber number;
  std::memcpy(&number, copy, sizeof(TNumber));
  return number;
}

/** \class Digest
 * \brief The MD5 of bytes: tells contents apart, but does not prove who made them.
 *
 * Thread safety: one thread per object. */
class Digest
{
public:
  Digest();
  ~Digest();

  /** Adds bytes behind those before. */
  void
  Add(const void * bytes, std::size_t size);

  /** Adds the bytes of a text. */
  void
  Add(std::string_view text)
  {
    this->Add(text.data(), text.size());
  }

  /** 32 hexadecimal digits. Nothing can be added after it. */
  std::string
  GetDigits();

private:
  struct State;
  std::unique_ptr<State> m_State;
};

/** The digest of the contents of files, one after the other. Throws Failure(Unreadable) where one
 * of them can't be read to its end. */
std::string
HashFiles(const std::vector<std::filesystem::path> & files);

/** A hash of the paths, sizes and times of change of files: when it is the same, so are their contents. */
std::string
HashFileStates(const std::vector<std::filesystem::path> & files);

} // namespace rhombic

#endif
