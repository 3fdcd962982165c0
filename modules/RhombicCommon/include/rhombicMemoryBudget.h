#ifndef rhombicMemoryBudget_h
#define rhombicMemoryBudget_h

#include <cstdint>
#include <string>

namespace rhombic
{

/** \file
 * How much memory work may take, in bytes. Thread safety: any number of threads may call these functions at once; each
 * call looks at what is free then. */

/** Bytes that can be used without swapping, as Linux estimates (MemAvailable); 0 when the system does not say. */
std::uintmax_t
FreeMemory();

/** What work may take: \a limit, or, when that is 0, half of what is free now; unlimited when that is not known. */
std::uintmax_t
MemoryAllowance(std::uintmax_t limit);

/** Asks before work, instead of finding out in it: throws Failure(Memory) when \a bytes are more than
 * MemoryAllowance(limit), saying that \a what would need so much and what else to try than more memory. */
void
RequireMemory(std::uintmax_t bytes, std::uintmax_t limit, const std::string & what, const std::string & advice = {});

/** Bytes as a person reads them: "1.5 GiB", the same in every locale. */
std::string
DescribeBytes(std::uintmax_t bytes);

} // namespace rhombic

#endif
