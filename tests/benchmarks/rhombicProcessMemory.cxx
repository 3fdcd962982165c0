#include "rhombicProcessMemory.h"

#include <fstream>
#include <sstream>
#include <string>

#include <malloc.h>

namespace rhombic
{

ProcessMemory
GetProcessMemory()
{
  ProcessMemory memory;
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
  {
    std::istringstream words(line);
    std::string name;
    double kibibytes = 0.0;
    words >> name >> kibibytes;
    if (name == "VmRSS:")
    {
      memory.now = kibibytes / 1024.0;
    }
    else if (name == "VmHWM:")
    {
      memory.peak = kibibytes / 1024.0;
    }
  }
  return memory;
}

bool
ResetPeakMemory()
{
  malloc_trim(0);
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush; // man 5 proc: resets the peak resident set size
  return file.good();
}

} // namespace rhombic
