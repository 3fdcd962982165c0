#include "rhombicMemoryBudget.h"

#include "rhombicFailure.h"

#include <cstdio>
#include <fstream>

namespace rhombic
{
namespace
{

std::string
InGiB(std::uintmax_t bytes)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g GiB", static_cast<double>(bytes) / (1 << 30));
  return text;
}

} // namespace

std::uintmax_t
FreeMemory()
{
  std::ifstream file("/proc/meminfo");
  std::string line;
  while (std::getline(file, line))
  {
    unsigned long long kibibytes = 0;
    if (std::sscanf(line.c_str(), "MemAvailable: %llu kB", &kibibytes) == 1)
    {
      return kibibytes * 1024;
    }
  }
  return 0;
}

void
RequireMemory(std::uintmax_t bytes, std::uintmax_t limit, const std::string & what)
{
  const std::uintmax_t allowed = limit > 0 ? limit : FreeMemory() / 2;
  if (allowed > 0 && bytes > allowed)
  {
    throw Failure(FailureKind::Memory,
                  what + ": it would need " + InGiB(bytes) + ", more than the " + InGiB(allowed) +
                    " allowed; raise --max-memory or crop the scan.");
  }
}

} // namespace rhombic
