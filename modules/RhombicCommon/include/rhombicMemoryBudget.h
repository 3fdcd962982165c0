#ifndef rhombicMemoryBudget_h
#define rhombicMemoryBudget_h

#include <cstdint>
#include <string>

namespace rhombic
{

/** Bytes that this machine can give to programs without swapping; 0 when it does not say. */
std::uintmax_t
FreeMemory();

/** Throws Failure(Memory) when \a bytes is more than \a limit, for asking before allocating. A limit of 0 stands for
 * half of FreeMemory(), and for none where that is not known. \a what begins the sentence: "Cannot read scan.nii". */
void
RequireMemory(std::uintmax_t bytes, std::uintmax_t limit, const std::string & what);

} // namespace rhombic

#endif
