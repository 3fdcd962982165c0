#include "itkForEachBlock.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace
{

TEST(ForEachBlock, VisitsEachPlaceOnce)
{
  for (const std::size_t size : { 0u, 1u, 7u, 1000u })
  {
    for (const std::size_t blockSize : { 1u, 3u, 1000u, 5000u })
    {
      std::vector<int> visits(size);
      itk::ForEachInBlocks(size, blockSize, [&visits](std::size_t i) { ++visits[i]; });
      EXPECT_EQ(visits, std::vector<int>(size, 1));
      itk::ForEachBlock(size, blockSize, [&](std::size_t begin, std::size_t end) {
        EXPECT_LT(begin, end);
        EXPECT_LE(end - begin, blockSize);
        for (std::size_t i = begin; i < end; ++i)
        {
          ++visits[i];
        }
      });
      EXPECT_EQ(visits, std::vector<int>(size, 2));
    }
  }
}

TEST(ForEachBlock, AnExceptionOfAnyThreadReachesTheCaller)
{
  constexpr std::size_t size = 64;
  for (std::size_t failing = 0; failing < size; ++failing)
  {
    const auto failAt = [failing](std::size_t i) {
      if (i == failing)
      {
        throw std::runtime_error("at " + std::to_string(i));
      }
    };
    EXPECT_THROW(itk::ForEachInBlocks(size, 1, failAt), std::runtime_error) << failing;
  }
}

} // namespace
