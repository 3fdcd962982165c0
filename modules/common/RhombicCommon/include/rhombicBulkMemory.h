#ifndef rhombicBulkMemory_h
#define rhombicBulkMemory_h

#include "rhombicMappedPages.h"

#include <cstddef>
#include <list>

namespace rhombic
{

/** Arrays from so many bytes on are blocks of AllocateBulk(). */
constexpr std::size_t SmallestBulk = std::size_t{ 1 } << 18;

/** A block for arrays of many elements, from 4 MiB on on huge pages where the system has them: a mesh of 300 MB costs
 * 150 page faults instead of 75,000. Throws std::bad_alloc, or Failure(Memory) where there is a
 * BulkInTemporaryFiles. For any thread, as FreeBulk(). */
void *
AllocateBulk(std::size_t bytes);

/** Gives back a block of AllocateBulk(), or null. */
void
FreeBulk(void * block) noexcept;

/** \class BulkInTemporaryFiles
 * \brief While there is one, each block of AllocateBulk(), on any thread, is pages of a temporary file without a name:
 * the system writes them to the disk when memory is short. Blocks may outlive it. */
class BulkInTemporaryFiles
{
public:
  explicit BulkInTemporaryFiles(const TemporaryStore & store);
  ~BulkInTemporaryFiles();
  BulkInTemporaryFiles(const BulkInTemporaryFiles &) = delete;
  BulkInTemporaryFiles &
  operator=(const BulkInTemporaryFiles &) = delete;

private:
  std::list<TemporaryStore>::const_iterator m_Store;
};

} // namespace rhombic

#endif
