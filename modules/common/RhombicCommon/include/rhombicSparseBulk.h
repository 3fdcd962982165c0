#ifndef rhombicSparseBulk_h
#define rhombicSparseBulk_h

#include "rhombicBulkMemory.h"

#include <cstddef>

namespace rhombic
{

/** A block for an array of which only parts may be used: the other parts take no memory. Where there is a
 * BulkInTemporaryFiles, SmallestBulk and more are pages of a temporary file, which has room for all of them. Throws as
 * AllocateBulk(); FreeBulk() gives it back. \param isZero whether all bytes are 0 */
void *
AllocateSparseBulk(std::size_t bytes, bool isZero);

} // namespace rhombic

#endif
