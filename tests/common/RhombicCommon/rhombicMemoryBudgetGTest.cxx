#include "rhombicMemoryBudget.h"

#include "rhombicFailure.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <cstdlib>
#include <fstream>

namespace
{

using rhombic::RequireMemory;

TEST(MemoryBudget, MoreThanAllowedIsRefusedInWords)
{
  constexpr std::uintmax_t gibibyte = 1 << 30;
  EXPECT_NO_THROW(RequireMemory(gibibyte, gibibyte, "Reading a.nii"));
  try
  {
    RequireMemory(5 * gibibyte / 2, 2 * gibibyte, "Reading a.nii", "crop the scan");
    FAIL() << "it was allowed";
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Memory);
    EXPECT_STREQ(failure.GetDescription(),
                 "Reading a.nii would need 2.5 GiB, more than the 2.0 GiB that are allowed; allow more with "
                 "maximumMemory = 3G, or crop the scan.");
  }
}

TEST(MemoryBudget, HalfOfTheFreeMemoryIsAllowedByDefault)
{
  EXPECT_NO_THROW(RequireMemory(1, 0, "Reading a.nii"));
  if (const auto free = rhombic::FreeMemory(); free > 0)
  {
    EXPECT_THROW(RequireMemory(2 * free, 0, "Reading a.nii"), rhombic::Failure);
  }
}

/** A folder with files as those of /proc and /sys. */
class SystemFiles : public testing::Test
{
protected:
  void
  Write(const std::string & path, const std::string & text)
  {
    const auto file = m_Folder.Path() / path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }

  std::uintmax_t
  FreeMebibytes() const
  {
    return rhombic::FreeMemory(m_Folder.Path()) >> 20;
  }

  static std::string
  Mebibytes(std::uintmax_t count)
  {
    return std::to_string(count << 20) + "\n";
  }

private:
  rhombictest::TemporaryFolder m_Folder;
};

TEST_F(SystemFiles, WithoutControlGroupsTheFreeMemoryCounts)
{
  this->Write("proc/meminfo", "MemTotal: 4096000 kB\nMemFree: 1000 kB\nMemAvailable: 2048000 kB\nBuffers: 1 kB\n");
  EXPECT_EQ(this->FreeMebibytes(), 2000);
  this->Write("proc/self/cgroup", "0::/\n");
  this->Write("proc/self/mountinfo", "41 31 0:38 / /sys/fs/cgroup rw,relatime shared:4 - cgroup2 cgroup2 rw\n");
  EXPECT_EQ(this->FreeMebibytes(), 2000) << "the root group has no limit";
}

TEST_F(SystemFiles, AGroupOfVersion2AndThoseAroundItLimit)
{
  this->Write("proc/meminfo", "MemAvailable: 20480000 kB\n");
  this->Write("proc/self/cgroup", "0::/slurm/job_7/step_0\n");
  this->Write("proc/self/mountinfo", "41 31 0:38 / /sys/fs/cgroup rw,relatime - cgroup2 cgroup2 rw\n");
  const std::string job = "sys/fs/cgroup/slurm/job_7/";
  this->Write(job + "memory.max", Mebibytes(4096));
  this->Write(job + "memory.current", Mebibytes(3000));
  this->Write(job + "memory.stat", "anon 5\ninactive_file " + Mebibytes(2000) + "active_file 8\n");
  this->Write(job + "step_0/memory.max", "max\n");
  this->Write(job + "step_0/memory.current", Mebibytes(3000));
  EXPECT_EQ(this->FreeMebibytes(), 3096) << "pages of files are dropped when memory is short";
  this->Write(job + "step_0/memory.max", Mebibytes(3500));
  EXPECT_EQ(this->FreeMebibytes(), 500);
  this->Write(job + "step_0/memory.current", Mebibytes(3600));
  EXPECT_EQ(this->FreeMebibytes(), 0) << "not unlimited";
}

TEST_F(SystemFiles, AGroupOfVersion1InAContainerLimits)
{
  this->Write("proc/meminfo", "MemAvailable: 20480000 kB\n");
  this->Write("proc/self/cgroup", "5:cpu,cpuacct:/docker/ab\n4:memory:/docker/ab\n0::/docker/ab\n");
  this->Write("proc/self/mountinfo",
              "35 31 0:32 /docker/ab /sys/fs/cgroup/memory ro,nosuid - cgroup cgroup rw,memory\n"
              "36 31 0:33 /docker/ab /sys/fs/cgroup/cpu ro,nosuid - cgroup cgroup rw,cpu,cpuacct\n");
  this->Write("sys/fs/cgroup/memory/memory.limit_in_bytes", Mebibytes(2048));
  this->Write("sys/fs/cgroup/memory/memory.usage_in_bytes", Mebibytes(1000));
  this->Write("sys/fs/cgroup/memory/memory.stat", "inactive_file 1\ntotal_inactive_file " + Mebibytes(100));
  EXPECT_EQ(this->FreeMebibytes(), 1148);
  this->Write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(this->FreeMebibytes(), 20000) << "no limit";
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // which keep all addresses for themselves
TEST(MemoryBudget, TheLimitOfAddressSpaceCounts)
{
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  const rlimit limit{ rlim_t{ 1 } << 36, before.rlim_max };
  ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
  const std::uintmax_t limited = rhombic::FreeMemory();
  const rlimit tight{ rlim_t{ 1 } << 20, before.rlim_max };
  ASSERT_EQ(setrlimit(RLIMIT_AS, &tight), 0);
  const std::uintmax_t none = rhombic::FreeMemory();
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_LT(limited, std::uintmax_t{ 1 } << 36);
  EXPECT_LE(none, 1U) << "the process has more already";
}
#endif

} // namespace
