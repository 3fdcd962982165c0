#ifndef rhombicMappedPages_h
#define rhombicMappedPages_h

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rhombic
{

/** \class MappedPages
 * \brief Pages of a file in the address space, which the system reads when they are used and drops when memory is
 * short.
 */
class MappedPages
{
public:
  /** Takes over the open \a file. \a flags of mmap(). The address is null when the system does not map them, as beyond
   * a limit of the address space. */
  MappedPages(int file, std::uintmax_t begin, std::size_t size, int flags);
  ~MappedPages();
  MappedPages(const MappedPages &) = delete;
  MappedPages &
  operator=(const MappedPages &) = delete;

  std::byte *
  GetAddress() const
  {
    return m_Address;
  }

  /** Whether changes go to the file. */
  bool
  IsShared() const
  {
    return m_IsShared;
  }

  /** Tells the system that pages are used in their order: those that were used are the first to be dropped. */
  void
  ExpectInOrder() const;

  /** Takes them out of the process; those that were changed and are not shared stay. Pages of a file that is larger
   * than the free memory are dropped by the system, too, as they could not stay until they are read again. */
  void
  Drop() const;

  /** Closes the file, whose pages stay: for many at once. Drop() is for open files. */
  void
  CloseFile();

private:
  std::vector<std::pair<std::size_t, std::size_t>>
  FindUnchanged() const;

  int m_File; ///< below 0: closed
  const std::size_t m_Size;
  const bool m_IsShared;
  std::byte * m_Address = nullptr;
};

/** What temporary files hold, and where they are. */
struct TemporaryStore
{
  std::filesystem::path folder; ///< empty: the one that TMPDIR names, else /tmp
  std::string what;             ///< begins the sentence of a failure: "Cannot read a.nii: its voxels"

  /** The folder, which may not be there. */
  std::filesystem::path
  FindFolder() const;
};

/** Why \a size bytes can't be put into the folder: it has no room for them, takes no files, or is in memory itself, or
 * the address space has no room. Empty where they can. */
std::string
FindObstacle(const TemporaryStore & store, std::uintmax_t size);

/** Throws Failure(Memory) where there is an obstacle. */
void
RequireRoom(const TemporaryStore & store, std::uintmax_t size);

/** Maps a new file without a name, whose pages are 0. It goes away with its pages, or with the process. Throws
 * Failure(Memory) as RequireRoom(). */
std::unique_ptr<MappedPages>
MapTemporaryFile(const TemporaryStore & store, std::size_t size);

} // namespace rhombic

#endif
