#include "rhombicForEachBlock.h"

#include "itkMultiThreaderBase.h"
#include "itkThreadPool.h"

#include <gtest/gtest.h>

#include <algorithm>
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

/** Runs work with a global default number of threads. */
template <typename TWork>
void
WithThreads(itk::ThreadIdType threads, const TWork & work)
{
  const auto usual = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
  work();
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(usual);
}

TEST(ForEachBlock, AfterAnExceptionNoFurtherPartBegins)
{
  std::size_t calls = 0;
  WithThreads(1, [&calls] {
    const auto failAtFifth = [&calls](std::size_t) { ++calls == 5 ? throw std::runtime_error("at 5") : void(); };
    EXPECT_THROW(rhombic::ForEachOnThreads(1'000, failAtFifth), std::runtime_error);
  });
  EXPECT_EQ(calls, 5u);
}

TEST(ForEachBlock, ReportsOnTheCallersThread)
{
  const auto caller = std::this_thread::get_id();
  std::vector<double> shares;
  const auto report = [&](double share) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    shares.push_back(share);
  };
  std::vector<int> visits(40);
  rhombic::ForEachOnThreads(
    visits.size(), [&](std::size_t n) { ++visits[n]; }, report);
  EXPECT_EQ(visits, std::vector<int>(40, 1));
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end())) << testing::PrintToString(shares);
  shares.clear();
  const auto isCaller = [&](std::size_t) { EXPECT_EQ(std::this_thread::get_id(), caller); };
  const itk::ThreadIdType threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
  rhombic::ForEachOnThreads(4, isCaller, report);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
  EXPECT_EQ(shares, (std::vector<double>{ 0.25, 0.5, 0.75, 1.0, 1.0 }));
}

TEST(StagedProgress, RisesThroughItsStagesOnTheCallersThread)
{
  std::vector<double> shares;
  rhombic::StagedProgress progress([&shares](double share) { shares.push_back(share); });
  for (const double end : { 0.25, 0.2, 1.0 }) // none of them falls
  {
    progress.Begin(end, 100);
    rhombic::ForEachOnThreads(50, [&progress](std::size_t) { progress.Completed(2); });
    progress.Completed(0);
  }
  EXPECT_EQ(shares.front(), 0.0);
  EXPECT_EQ(shares.back(), 1.0);
  EXPECT_GT(std::count(shares.begin(), shares.end(), 0.25), 0);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end())) << testing::PrintToString(shares);
}

TEST(StagedProgress, WhatTheReportThrowsEndsTheLoop)
{
  struct Stop
  {};
  rhombic::StagedProgress progress([](double share) { share > 0.5 ? throw Stop() : void(); });
  progress.Begin(1.0, 1'000);
  std::size_t calls = 0;
  const auto work = [&](std::size_t) {
    ++calls;
    progress.Completed(1);
  };
  WithThreads(1, [&work] { EXPECT_THROW(rhombic::ForEachOnThreads(1'000, work), Stop); });
  EXPECT_EQ(calls, 501u);
}

TEST(ForEachBlock, JobsOfTheThreadPoolMayCallIt)
{
  itk::ThreadPool::GetInstance(); // ITK makes it out of sight of the thread sanitizer
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
