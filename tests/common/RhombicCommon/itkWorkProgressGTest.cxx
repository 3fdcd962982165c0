#include "itkWorkProgress.h"

#include "itkCommand.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace
{

class Worker : public itk::ProcessObject
{
public:
  using Self = Worker;
  using Pointer = itk::SmartPointer<Self>;
  itkFactorylessNewMacro(Self);
  itkTypeMacro(Worker, itk::ProcessObject);
};

TEST(WorkProgress, NeverFallsAndNeverPassesOneWithManyThreads)
{
  for (const itk::SizeValueType work : { 1u, 7u, 127u, 128u, 1000u, 100003u })
  {
    constexpr unsigned int threads = 7;
    const auto worker = Worker::New();
    itk::WorkProgress progress(*worker, work * threads);
    EXPECT_EQ(worker->GetProgress(), 0.0f);
    std::vector<std::thread> pool;
    for (unsigned int n = 0; n < threads; ++n)
    {
      pool.emplace_back([&] {
        itk::WorkProgress::Share share(progress);
        float last = 0.0f;
        for (itk::SizeValueType done = 0; done < work; ++done)
        {
          share.Completed(1);
          const float now = worker->GetProgress();
          EXPECT_GE(now, last);
          last = now;
        }
      });
    }
    for (std::thread & thread : pool)
    {
      thread.join();
    }
    EXPECT_GE(worker->GetProgress(), 0.98f) << "but for what threads kept back";
    progress.Completed(10 * work);
    EXPECT_LE(worker->GetProgress(), 1.0f) << "more than was announced";
    progress.Finish();
    EXPECT_EQ(worker->GetProgress(), 1.0f);
  }
}

TEST(WorkProgress, NoticesAnAbort)
{
  const auto worker = Worker::New();
  itk::WorkProgress progress(*worker, 1000);
  itk::WorkProgress::Share share(progress);
  EXPECT_NO_THROW(share.Completed(1));
  worker->AbortGenerateDataOn();
  EXPECT_THROW(progress.CheckAbort(), itk::ProcessAborted);
  EXPECT_THROW(progress.Completed(1), itk::ProcessAborted);
  EXPECT_THROW(share.CheckAbort(), itk::ProcessAborted);
  try
  {
    share.Completed(1);
    FAIL() << "nothing was thrown";
  }
  catch (const itk::ProcessAborted & aborted)
  {
    EXPECT_NE(std::string(aborted.GetLocation()), "");
    EXPECT_NE(std::string(aborted.GetFile()).find("itkWorkProgress.h"), std::string::npos);
  }
}

TEST(WorkProgress, LoopsOnTheFiltersThreads)
{
  const auto worker = Worker::New();
  itk::WorkProgress progress(*worker, 100);
  std::vector<int> visits(100);
  progress.ForEach(100, [&](itk::SizeValueType n) {
    ++visits[n];
    progress.Completed(1);
  });
  EXPECT_EQ(visits, std::vector<int>(100, 1));
  EXPECT_EQ(progress.GetCompleted(), 100u);
  const auto failAtSeventh = [](itk::SizeValueType n) { n == 7 ? throw std::runtime_error("at 7") : void(); };
  EXPECT_THROW(progress.ForEach(100, failAtSeventh), std::runtime_error);
  worker->AbortGenerateDataOn();
  EXPECT_THROW(progress.ForEach(100, [](itk::SizeValueType) { FAIL() << "work began"; }), itk::ProcessAborted);
}

TEST(WorkProgress, LoopsGoOnBesideACallThatTakesLong)
{
  const auto worker = Worker::New();
  worker->SetNumberOfWorkUnits(2);
  constexpr unsigned int count = 8;
  std::atomic<unsigned int> others{ 0 };
  itk::WorkProgress::ForEach(*worker, count, [&](itk::SizeValueType n) {
    n == 0 ? void() : void(++others);
    while (n == 0 && others < count - 1) // ends only if the other thread makes all other calls
    {
      std::this_thread::yield();
    }
  });
  EXPECT_EQ(others, count - 1);
}

/** Its only loop is made by the threads that did not call it, while the calling thread waits. */
class Waiter : public itk::ProcessObject
{
public:
  using Self = Waiter;
  using Pointer = itk::SmartPointer<Self>;
  itkFactorylessNewMacro(Self);
  itkTypeMacro(Waiter, itk::ProcessObject);

protected:
  Waiter()
  {
    this->SetNumberOfWorkUnits(2);
    this->SetNthOutput(0, itk::DataObject::New());
  }

  void
  GenerateData() override
  {
    constexpr unsigned int count = 8;
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<unsigned int> others{ 0 };
    itk::WorkProgress progress(*this, count);
    progress.ForEach(count, [&](itk::SizeValueType) {
      if (std::this_thread::get_id() != caller)
      {
        progress.Completed(1);
        ++others;
        return;
      }
      while (others < count - 1) // the caller counts no work
      {
        std::this_thread::yield();
      }
    });
  }
};

TEST(WorkProgress, ObserversHearOfLoopsThatOtherThreadsMade)
{
  const auto waiter = Waiter::New();
  waiter->AddObserver(itk::ProgressEvent(), [&waiter](const itk::EventObject &) {
    waiter->GetProgress() > 0.0f ? waiter->AbortGenerateDataOn() : void();
  });
  EXPECT_THROW(waiter->Update(), itk::ProcessAborted);
}

} // namespace
