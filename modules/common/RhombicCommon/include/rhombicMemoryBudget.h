#ifndef rhombicMemoryBudget_h
#define rhombicMemoryBudget_h

#include <cstdint>
#include <filesystem>
#include <string>

namespace rhombic
{

/** \file
 * Limits of memory, in bytes. Each call asks the system for the free memory anew. */

/** Bytes that the process can still use: the least of what is free without swapping, as Linux estimates (MemAvailable),
 * of what the control groups of the process leave (cgroups, version 1 or 2; clusters limit jobs by them), without pages
 * of files that the system can drop, and of what its limit of address space leaves (ulimit -v). 0 when nothing of that
 * is known.
 * \param root of /proc and /sys; another one for tests */
std::uintmax_t
FreeMemory(const std::filesystem::path & root = "/");

/** The memory that work may take: \a limit, or half of FreeMemory() when that is 0. Unlimited when the free memory is
 * not known. */
std::uintmax_t
MemoryAllowance(std::uintmax_t limit);

/** Throws Failure(Memory) when \a bytes exceed MemoryAllowance(limit): for a check before long work. \a what names the
 * work in the message ("Reading scan.nii"), \a advice an alternative to allowing more memory. */
void
RequireMemory(std::uintmax_t bytes, std::uintmax_t limit, const std::string & what, const std::string & advice = {});

/** Gives memory that was freed back to the system, where the C library can: after work whose memory is free in pieces
 * too small for the work that comes next. Takes milliseconds. */
void
GiveBackFreedMemory();

/** Bytes as a person reads them: "1.5 GiB", the same in every locale. */
std::string
DescribeBytes(std::uintmax_t bytes);

} // namespace rhombic

#endif
