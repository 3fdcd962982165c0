#include "rhombicMemoryBudget.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <array>
#include <cmath>
#include <fstream>
#include <limits>

namespace rhombic
{

std::uintmax_t
FreeMemory()
{
  std::ifstream file("/proc/meminfo");
  std::string name;
  std::uintmax_t kibibytes = 0;
  std::string rest;
  while (file >> name >> kibibytes && std::getline(file, rest))
  {
    if (name == "MemAvailable:")
    {
      return kibibytes * 1024;
    }
  }
  return 0;
}

std::uintmax_t
MemoryAllowance(std::uintmax_t limit)
{
  const std::uintmax_t half = limit == 0 ? FreeMemory() / 2 : limit;
  return half == 0 ? std::numeric_limits<std::uintmax_t>::max() : half;
}

void
RequireMemory(std::uintmax_t bytes, std::uintmax_t limit, const std::string & what, const std::string & advice)
{
  const std::uintmax_t allowed = MemoryAllowance(limit);
  if (bytes > allowed)
  {
    const auto gibibytes = static_cast<std::uintmax_t>(std::ceil(std::ldexp(static_cast<double>(bytes), -30)));
    throw Failure(FailureKind::Memory,
                  what + " would need " + DescribeBytes(bytes) + ", more than the " + DescribeBytes(allowed) +
                    " that are allowed; allow more with maximumMemory = " + std::to_string(gibibytes) + "G" +
                    (advice.empty() ? "" : ", or " + advice) + ".");
  }
}

std::string
DescribeBytes(std::uintmax_t bytes)
{
  constexpr std::array<const char *, 5> units{ "bytes", "KiB", "MiB", "GiB", "TiB" };
  auto number = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; number >= 1024 && unit + 1 < units.size(); ++unit)
  {
    number /= 1024;
  }
  return FormatFixed(std::round(number * 10) / 10, unit > 0 ? 1 : 0) + " " + units[unit];
}

} // namespace rhombic
