#include "rhombicForEachBlock.h"

#include "itkMultiThreaderBase.h"

#include <gtest/gtest.h>

#include <future>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
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
      rhombic::ForEachInBlocks(size, blockSize, [&visits](std::size_t i) { ++visits[i]; });
      EXPECT_EQ(visits, std::vector<int>(size, 1));
      rhombic::ForEachBlock(size, blockSize, [&](std::size_t begin, std::size_t end) {
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
    EXPECT_THROW(rhombic::ForEachInBlocks(size, 1, failAt), std::runtime_error) << failing;
  }
}

TEST(ForEachBlock, JobsOfTheThreadPoolMayCallIt)
{
  std::vector<std::vector<int>> visits(64, std::vector<int>(100));
  itk::MultiThreaderBase::New()->ParallelizeArray(
    0,
    visits.size(),
    [&visits](itk::SizeValueType job) {
      rhombic::ForEachInBlocks(visits[job].size(), 3, [&](std::size_t i) {
        rhombic::ForEachInBlocks(5, 1, [&](std::size_t n) {
          if (n == 4) // one thread only
          {
            ++visits[job][i];
          }
        });
      });
    },
    nullptr);
  EXPECT_EQ(visits, std::vector<std::vector<int>>(64, std::vector<int>(100, 1)));
}

TEST(ForEachBlock, WorksOnSeveralThreadsAndOnNoMoreThanTheGlobalDefaultNumber)
{
  const auto usual = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  for (const itk::ThreadIdType threads : { 1, 2, 5 })
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    std::mutex mutex;
    std::set<std::thread::id> ids;
    rhombic::ForEachInBlocks(1000, 1, [&](std::size_t) {
      const std::lock_guard<std::mutex> lock(mutex);
      ids.insert(std::this_thread::get_id());
    });
    EXPECT_LE(ids.size(), threads);
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(usual);

  // Each of two pieces waits for the other: one thread alone would wait for ever.
  if (usual > 1)
  {
    std::promise<void> began[2];
    rhombic::ForEachInBlocks(2, 1, [&](std::size_t i) {
      began[i].set_value();
      began[1 - i].get_future().wait();
    });
  }
}

} // namespace
