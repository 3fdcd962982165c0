#include "itkRecyclingMemory.h"

#include "rhombicForEachBlock.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <new>
#include <set>
#include <vector>

namespace
{

TEST(RecyclingMemory, GivesABlockThatIsBackToTheNextOfItsSize)
{
  itk::RecyclingMemory memory;
  void * const first = memory.allocate(1000, 8);
  void * const second = memory.allocate(1000, 8);
  EXPECT_NE(first, second);
  memory.deallocate(first, 1000, 8);
  void * const other = memory.allocate(2000, 8);
  EXPECT_NE(other, first);
  EXPECT_EQ(memory.allocate(1000, 8), first);
  memory.deallocate(first, 1000, 8);
  memory.deallocate(second, 1000, 8);
  memory.deallocate(other, 2000, 8);
}

TEST(RecyclingMemory, ServesManyThreadsWithBlocksOfTheirOwn)
{
  itk::RecyclingMemory memory;
  rhombic::ForEachInBlocks(2000, 1, [&memory](std::size_t n) {
    const auto size = 1 + n % 3 * 500;
    std::pmr::vector<std::size_t> numbers(size, &memory);
    EXPECT_EQ(numbers, std::pmr::vector<std::size_t>(size));
    std::fill(numbers.begin(), numbers.end(), n);
    EXPECT_EQ(numbers, std::pmr::vector<std::size_t>(size, n));
  });
}

/** A system that can run out of memory. */
class LimitedMemory : public std::pmr::memory_resource
{
public:
  bool isSpent = false;

private:
  void *
  do_allocate(std::size_t bytes, std::size_t alignment) override
  {
    if (isSpent)
    {
      throw std::bad_alloc();
    }
    return std::pmr::new_delete_resource()->allocate(bytes, alignment);
  }

  void
  do_deallocate(void * block, std::size_t bytes, std::size_t alignment) override
  {
    std::pmr::new_delete_resource()->deallocate(block, bytes, alignment);
  }

  bool
  do_is_equal(const std::pmr::memory_resource & other) const noexcept override
  {
    return this == &other;
  }
};

TEST(RecyclingMemory, TakesBlocksBackWhenThereIsNoMemoryLeft)
{
  LimitedMemory system;
  itk::RecyclingMemory memory(&system);
  const auto work = [&] {
    const std::pmr::vector<char> small(1, &memory); // in a destructor, an exception would end the program
    const std::pmr::vector<float> large(1000, &memory);
    system.isSpent = true;
    const std::pmr::vector<float> tooMuch(2000, &memory);
  };
  EXPECT_THROW(work(), std::bad_alloc);
  EXPECT_NO_THROW(std::pmr::vector<float>(1000, &memory)) << "is there again";
  EXPECT_NO_THROW(std::pmr::vector<char>(1, &memory));
  memory.ReleaseSpare();
  EXPECT_THROW(std::pmr::vector<float>(1000, &memory), std::bad_alloc) << "the system has it";
}

TEST(RecyclingMemory, BlocksHaveTheirSizeAndAlignmentHoweverSmall)
{
  itk::RecyclingMemory memory;
  for (const std::size_t alignment : { 1, 2, 8, 64, 4096 })
  {
    for (std::size_t bytes = 1; bytes < 20; ++bytes)
    {
      void * const blocks[2] = { memory.allocate(bytes, alignment), memory.allocate(bytes, alignment) };
      for (void * const block : blocks)
      {
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % alignment, 0u);
        std::memset(block, 255, bytes);
      }
      memory.deallocate(blocks[0], bytes, alignment);
      memory.deallocate(blocks[1], bytes, alignment);
      EXPECT_EQ(memory.allocate(bytes, alignment), blocks[1]);
      EXPECT_EQ(memory.allocate(bytes, alignment), blocks[0]);
      memory.deallocate(blocks[0], bytes, alignment);
      memory.deallocate(blocks[1], bytes, alignment);
    }
  }
}

} // namespace
