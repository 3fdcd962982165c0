#include "itkRecyclingMemory.h"

#include "itkForEachBlock.h"

#include <gtest/gtest.h>

#include <cstdint>
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
  itk::ForEachInBlocks(2000, 1, [&memory](std::size_t n) {
    const auto size = 1 + n % 3 * 500;
    std::pmr::vector<std::size_t> numbers(size, &memory);
    EXPECT_EQ(numbers, std::pmr::vector<std::size_t>(size));
    std::fill(numbers.begin(), numbers.end(), n);
    EXPECT_EQ(numbers, std::pmr::vector<std::size_t>(size, n));
  });
}

} // namespace
