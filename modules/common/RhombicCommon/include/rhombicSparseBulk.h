#ifndef rhombicSparseBulk_h
#define rhombicSparseBulk_h

#include "rhombicBulkMemory.h"

#include <cstddef>
#include <memory>
#include <memory_resource>

namespace rhombic
{

/** A block for an array of which only parts may be used: the other parts take no memory. Where there is a
 * BulkInTemporaryFiles, 4 MiB and more are pages of a temporary file. Throws as AllocateBulk(); FreeBulk() gives it
 * back. \param isZero whether all bytes are 0 */
void *
AllocateSparseBulk(std::size_t bytes, bool isZero);

/** Memory for many small arrays that are large together, for any thread: operator new, or pages of temporary files
 * where there is a BulkInTemporaryFiles, which are given back all at once, with the last pointer. */
std::shared_ptr<std::pmr::memory_resource>
ResourceForSmallArrays();

} // namespace rhombic

#endif
