#include "rhombicMemoryBudget.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace rhombic
{

namespace
{

namespace fs = std::filesystem;

constexpr std::uintmax_t Unlimited = std::numeric_limits<std::uintmax_t>::max();

/** \a limit - \a used, not below 0. */
std::uintmax_t
Left(std::uintmax_t limit, std::uintmax_t used)
{
  return limit > used ? limit - used : 0;
}

/** The number in a file of one line; nothing for "max" and where there is no such file. */
std::optional<std::uintmax_t>
ReadNumber(const fs::path & path)
{
  std::ifstream file(path);
  std::uintmax_t number = 0;
  return file >> number ? std::optional<std::uintmax_t>(number) : std::nullopt;
}

/** The number behind a name in a file of a name and a number on each line; nothing where it is not there. */
std::optional<std::uintmax_t>
FindNumber(const fs::path & path, const std::string & wanted)
{
  std::ifstream file(path);
  std::string name;
  std::uintmax_t number = 0;
  std::string rest;
  while (file >> name >> number && std::getline(file, rest))
  {
    if (name == wanted)
    {
      return number;
    }
  }
  return std::nullopt;
}

/** The names of the files of a version of control groups that limit memory. */
struct GroupFiles
{
  const char * limit;
  const char * used;
  const char * pageCache; ///< in memory.stat: pages that the system drops when memory is short; they count as used
};
constexpr GroupFiles Version1{ "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file" };
constexpr GroupFiles Version2{ "memory.max", "memory.current", "inactive_file" };

/** What a control group and the groups around it leave, up to the folder where their file system is mounted. */
std::uintmax_t
LeftInGroups(const GroupFiles & files, const fs::path & mount, const fs::path & group)
{
  std::uintmax_t left = Unlimited;
  fs::path folder = mount;
  const auto check = [&] {
    const auto limit = ReadNumber(folder / files.limit);
    const auto used = ReadNumber(folder / files.used);
    if (limit && used)
    {
      left = std::min(left, Left(*limit, Left(*used, FindNumber(folder / "memory.stat", files.pageCache).value_or(0))));
    }
  };
  check();
  for (const fs::path & name : group.relative_path())
  {
    folder /= name;
    check();
  }
  return left;
}

/** The process's path in a hierarchy of control groups, as a line "4:memory:/job" or "0::/job" of /proc/self/cgroup
 * tells; nothing if it is in none. */
std::optional<fs::path>
FindGroup(const fs::path & root, const std::string & controller)
{
  std::ifstream file(root / "proc/self/cgroup");
  for (std::string line; std::getline(file, line);)
  {
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos)
    {
      continue;
    }
    const std::vector<std::string> controllers = Split(line.substr(first + 1, second - first - 1), ",");
    if (std::find(controllers.begin(), controllers.end(), controller) != controllers.end())
    {
      return line.substr(second + 1);
    }
  }
  return std::nullopt;
}

/** What the control groups of the process leave, of both versions. /proc/self/mountinfo, see proc(5), names where
 * their file systems are mounted, and which group is the root there. */
std::uintmax_t
LeftInControlGroups(const fs::path & root)
{
  std::uintmax_t left = Unlimited;
  std::ifstream file(root / "proc/self/mountinfo");
  for (std::string line; std::getline(file, line);)
  {
    const std::vector<std::string> words = Split(line, " ");
    const auto dash = std::find(words.begin(), words.end(), "-");
    if (words.size() < 5 || words.end() - dash < 4)
    {
      continue;
    }
    const std::vector<std::string> options = Split(dash[3], ",");
    const bool isVersion1 = dash[1] == "cgroup" && std::find(options.begin(), options.end(), "memory") != options.end();
    if (!isVersion1 && dash[1] != "cgroup2")
    {
      continue;
    }
    if (const auto group = FindGroup(root, isVersion1 ? "memory" : ""))
    {
      const fs::path inMount = group->lexically_relative(words[3]);
      const bool isBelow = !inMount.empty() && *inMount.begin() != "..";
      left = std::min(left,
                      LeftInGroups(isVersion1 ? Version1 : Version2,
                                   root / fs::path(words[4]).relative_path(),
                                   isBelow && inMount != "." ? inMount : fs::path()));
    }
  }
  return left;
}

/** What the limit of the process's address space leaves (ulimit -v). */
std::uintmax_t
LeftOfAddressSpace()
{
  rlimit limit{};
  std::ifstream file("/proc/self/statm");
  std::uintmax_t pages = 0;
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || !(file >> pages))
  {
    return Unlimited;
  }
  return Left(limit.rlim_cur, pages * static_cast<std::uintmax_t>(sysconf(_SC_PAGESIZE)));
}

} // namespace

std::uintmax_t
FreeMemory(const std::filesystem::path & root)
{
  const auto available = FindNumber(root / "proc/meminfo", "MemAvailable:");
  const std::uintmax_t free =
    std::min({ available ? *available * 1024 : Unlimited, LeftInControlGroups(root), LeftOfAddressSpace() });
  return free == Unlimited ? 0 : std::max<std::uintmax_t>(free, 1);
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

void
GiveBackFreedMemory()
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
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
