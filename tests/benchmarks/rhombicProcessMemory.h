#ifndef rhombicProcessMemory_h
#define rhombicProcessMemory_h

namespace rhombic
{

/** \class ProcessMemory
 * \brief Resident memory of this process in MiB. */
struct ProcessMemory
{
  double now = 0.0;  ///< in use now
  double peak = 0.0; ///< the largest since ResetPeakMemory()
};

/** Reads /proc/self/status. */
ProcessMemory
GetProcessMemory();

/** Returns free memory to the system and resets the peak to the memory in use now. Returns false where the system does
 * not allow that (/proc/self/clear_refs). */
bool
ResetPeakMemory();

} // namespace rhombic

#endif
