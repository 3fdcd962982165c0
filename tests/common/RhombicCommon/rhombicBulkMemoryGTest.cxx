#include "rhombicBulkMemory.h"
#include "rhombicBulkResource.h"

#include "rhombicMemoryRefusal.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory_resource>
#include <optional>
#include <random>
#include <thread>
#include <vector>

namespace
{

constexpr std::size_t Size = std::size_t{ 5 } << 20;

/** How many pages of files of a folder the process has mapped. */
int
CountMapped(const std::filesystem::path & folder)
{
  std::ifstream maps("/proc/self/maps");
  int count = 0;
  for (std::string line; std::getline(maps, line);)
  {
    count += line.find(folder.string()) != std::string::npos ? 1 : 0;
  }
  return count;
}

TEST(BulkMemory, BlocksArePagesOfFilesWithoutANameWhileAskedFor)
{
  const rhombictest::TemporaryFolder folder;
  const rhombic::TemporaryStore store{ folder.Path(), "Cannot do this: the blocks" };
  if (!FindObstacle(store, 3 * Size).empty())
  {
    GTEST_SKIP() << FindObstacle(store, 3 * Size);
  }
  void * const before = rhombic::AllocateBulk(Size);
  void * within = nullptr;
  {
    const rhombic::BulkInTemporaryFiles files(store);
    within = rhombic::AllocateBulk(Size);
    rhombic::FreeBulk(before);
    EXPECT_EQ(CountMapped(folder.Path()), 1);
    rhombic::FreeBulk(rhombic::AllocateBulk(Size));
    EXPECT_EQ(CountMapped(folder.Path()), 1);
    EXPECT_TRUE(std::filesystem::is_empty(folder.Path()));
  }
  std::memset(within, 255, Size);
  void * const after = rhombic::AllocateBulk(Size);
  EXPECT_EQ(CountMapped(folder.Path()), 1) << "which outlives the object";
  rhombic::FreeBulk(within);
  EXPECT_EQ(CountMapped(folder.Path()), 0);
  rhombic::FreeBulk(after);
}

TEST(BulkMemory, SmallArraysOfManyThreadsShareBlocks)
{
  const rhombictest::TemporaryFolder folder;
  const rhombic::TemporaryStore store{ folder.Path(), "Cannot do this: the blocks" };
  if (!FindObstacle(store, 20 * Size).empty())
  {
    GTEST_SKIP() << FindObstacle(store, 20 * Size);
  }
  std::optional<rhombic::BulkInTemporaryFiles> files(std::in_place, store);
  const auto resource = rhombic::ResourceForSmallArrays();
  std::vector<std::pmr::vector<std::uint32_t>> arrays;
  while (arrays.size() < 400)
  {
    arrays.emplace_back(resource.get());
  }
  std::vector<std::thread> threads;
  for (std::size_t thread = 0; thread < 4; ++thread)
  {
    threads.emplace_back([&, thread] {
      std::mt19937 random(static_cast<unsigned int>(thread));
      for (int turn = 0; turn < 2000; ++turn) // of arrays that grow, shrink and are given back
      {
        const std::size_t n = random() % 100 * 4 + thread;
        arrays[n].assign(random() % 4000, static_cast<std::uint32_t>(n));
        turn % 3 == 0 ? arrays[n].shrink_to_fit() : void();
      }
    });
  }
  std::for_each(threads.begin(), threads.end(), [](std::thread & thread) { thread.join(); });
  files.reset(); // which the arrays outlive
  EXPECT_GT(CountMapped(folder.Path()), 0);
  EXPECT_LT(CountMapped(folder.Path()), 20);
  for (std::size_t n = 0; n < arrays.size(); ++n)
  {
    ASSERT_EQ(std::count(arrays[n].begin(), arrays[n].end(), n), static_cast<std::ptrdiff_t>(arrays[n].size()));
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // which keep all memory for themselves
TEST(BulkMemory, BlocksThatComeAndGoLeaveNoHoles)
{
  const auto resident = [] {
    std::ifstream statm("/proc/self/statm");
    std::size_t all = 0, pages = 0;
    statm >> all >> pages;
    return pages * 4096;
  };
  const auto touched = [](std::size_t bytes) {
    void * const block = rhombic::AllocateBulk(bytes);
    std::memset(block, 1, bytes);
    return block;
  };
  std::vector<void *> kept;
  std::size_t first = 0;
  for (std::size_t round = 0; round < 20; ++round)
  {
    std::vector<void *> blocks;
    for (const std::size_t mebibytes : { 12, 5, 9, 20 })
    {
      blocks.push_back(touched((mebibytes << 20U) - 100 * round));
    }
    std::for_each(blocks.begin(), blocks.end(), rhombic::FreeBulk);
    kept.push_back(touched(rhombic::SmallestBulk)); // somewhere in a hole
    first = round < 4 ? resident() : first;
  }
  EXPECT_LT(resident(), first + (std::size_t{ 24 } << 20));
  std::for_each(kept.begin(), kept.end(), rhombic::FreeBulk);
}
#endif

TEST(BulkMemory, FoldersWithoutRoomAreRefusedInWords)
{
  const rhombictest::TemporaryFolder folder;
  const auto sentenceOf = [](const std::filesystem::path & path, std::uintmax_t size) {
    return rhombictest::MemoryRefusal([&] { rhombic::RequireRoom({ path, "Cannot do this: the blocks" }, size); });
  };
  const std::string begin = "Cannot do this: the blocks are too large for the memory that is allowed, and can't be put "
                            "into temporary files in ";
  EXPECT_EQ(sentenceOf(folder.Path() / "none", Size),
            begin + (folder.Path() / "none").string() +
              " (which is not there); name a folder on a disk with more room by temporaryFolder = FOLDER.");
  const char * const named = std::getenv("TMPDIR");
  const std::string before = named != nullptr ? named : "";
  setenv("TMPDIR", "/none", 1);
  EXPECT_NE(sentenceOf({}, Size).find("files in /none (which is not there)"), std::string::npos);
  named != nullptr ? setenv("TMPDIR", before.c_str(), 1) : unsetenv("TMPDIR");
  EXPECT_NE(sentenceOf("/dev/shm", Size).find("(it is in memory itself)"), std::string::npos);
  if (rhombic::FindObstacle({ folder.Path(), {} }, Size).empty())
  {
    EXPECT_NE(sentenceOf(folder.Path(), std::uintmax_t{ 1 } << 60).find("are free, and 1048576.0 TiB are needed"),
              std::string::npos);
  }
}

} // namespace
