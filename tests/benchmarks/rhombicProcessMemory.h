#ifndef rhombicProcessMemory_h
#define rhombicProcessMemory_h

namespace rhombic
{

/** \class ProcessMemory
 * \brief Resident memory of this process in MiB. */
struct ProcessMemory
{
  double now = 0.0;  ///< at the moment
  double peak = 0.0; ///< the most since ResetPeakMemory()
};

/** From /proc/self/status. */
ProcessMemory
GetProcessMemory();

/** Returns free memory to the system and starts the peak again at what is in use now; false where the system does not
 * allow that (/proc/self/clear_refs). */
bool
ResetPeakMemory();

} // namespace rhombic

#endif
