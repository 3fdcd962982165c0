#include "itkFilterDescriptions.h"

#include "itkCommand.h"

#include <atomic>
#include <chrono>
#include <ctime>
#include <thread>

namespace
{

using namespace filtertest;

enum class Caller
{
  Observer,
  OtherThread
};

constexpr double MostAfterAbort = 100.0; // ms

/** Time that all threads of the process have spent computing, in ms: what other programs do on a busy machine does not
 * count. */
double
ComputingTime()
{
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

struct Abort
{
  bool wasThrown = false;
  double computedAfter = 0.0; ///< ms, by all threads together
};

/** Aborts an update at some progress, or after half a second. */
template <typename TFilter>
Abort
AbortAt(TFilter & filter, float progress, Caller caller)
{
  std::atomic<double> when{ 0.0 };
  std::atomic<bool> isUpdating{ true };
  const auto abort = [&] {
    when = ComputingTime();
    filter.AbortGenerateDataOn();
  };
  constexpr std::chrono::milliseconds longest(500);
  const auto start = std::chrono::steady_clock::now();
  const auto isTime = [&filter, progress, start, longest] {
    return filter.GetProgress() >= progress || std::chrono::steady_clock::now() - start > longest;
  };
  std::thread other;
  const auto observer = filter.AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    if (caller == Caller::Observer && when == 0.0 && isTime())
    {
      abort();
    }
    if (caller == Caller::OtherThread && !other.joinable())
    {
      other = std::thread([&] {
        while (!isTime() && isUpdating)
        {
          std::this_thread::sleep_for(std::chrono::microseconds(500));
        }
        abort();
      });
    }
  });
  Abort result;
  try
  {
    filter.UpdateLargestPossibleRegion();
  }
  catch (const itk::ProcessAborted &)
  {
    result.computedAfter = ComputingTime() - when;
    result.wasThrown = true;
  }
  isUpdating = false;
  if (other.joinable())
  {
    other.join();
  }
  filter.RemoveObserver(observer);
  return result;
}

template <typename TDescription>
class FilterAbort : public testing::Test
{};
TYPED_TEST_SUITE(FilterAbort, Filters, FilterNames);

TYPED_TEST(FilterAbort, StopsWithinATenthOfASecond)
{
  struct Case
  {
    Caller caller;
    unsigned int units;
    float progress;
  };
  Random random(1);
  const auto input = TypeParam::MakeInput(TypeParam::LargeSize, random);
  for (const Case & each : { Case{ Caller::Observer, 1, 0.0f },
                             Case{ Caller::Observer, 4, 0.1f },
                             Case{ Caller::OtherThread, 1, 0.02f },
                             Case{ Caller::OtherThread, 4, 0.3f },
                             Case{ Caller::OtherThread, 1, 0.4f } })
  {
    const auto filter = TypeParam::Filter::New();
    TypeParam::MakeSlow(*filter);
    filter->SetInput(input);
    filter->SetNumberOfWorkUnits(each.units);
    const Abort abort = AbortAt(*filter, each.progress, each.caller);
    EXPECT_TRUE(abort.wasThrown) << "at " << each.progress << " with " << each.units << " work units";
    EXPECT_LE(abort.computedAfter, MostAfterAbort) << "at " << each.progress << " with " << each.units << " work units";
  }
}

TEST(FilterAbortWhileStreaming, StopsWhatIsUpstreamToo)
{
  Random random(1);
  const auto input = CartesianToFCC::MakeInput({ { 160, 160, 160 } }, random);
  const auto resample = CartesianToFCC::Filter::New();
  resample->SetInput(input);
  const auto smooth = FCCGaussian<std::int16_t>::Filter::New();
  smooth->SetInput(resample->GetOutput());
  const auto filter = itk::FCCIsosurfaceFilter<itk::FCCImage<std::int16_t>>::New();
  filter->SetInput(smooth->GetOutput());
  for (const itk::ProcessObject::Pointer & upstream :
       std::initializer_list<itk::ProcessObject::Pointer>{ resample, smooth })
  {
    resample->SetDensity(20.0);
    smooth->SetSigma(1.0);
    filter->SetNumberOfStreamDivisions(4);
    bool isUpdating = false; // not before: its own update asks for the first slab
    const auto start =
      filter->AddObserver(itk::StartEvent(), [&isUpdating](const itk::EventObject &) { isUpdating = true; });
    double when = 0.0;
    const auto observer = upstream->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
      if (isUpdating && when == 0.0 && upstream->GetProgress() > 0.3f)
      {
        when = ComputingTime();
        filter->AbortGenerateDataOn();
      }
    });
    EXPECT_THROW(filter->Update(), itk::ProcessAborted);
    EXPECT_GT(when, 0.0);
    EXPECT_LE(ComputingTime() - when, MostAfterAbort) << upstream->GetNameOfClass();
    upstream->RemoveObserver(observer);
    filter->RemoveObserver(start);

    resample->SetDensity(0.2);
    const std::string streamed = UpdatedOutput(*filter);
    filter->SetNumberOfStreamDivisions(1);
    EXPECT_TRUE(UpdatedOutput(*filter) == streamed);
  }
}

TYPED_TEST(FilterAbort, LeavesAPipelineThatWorks)
{
  for (unsigned int seed = 0; seed < 12; ++seed)
  {
    const auto example = MakeExample<TypeParam>(seed, { { 20, 20, 20 } });
    const auto filter = example.makeFilter();
    filter->SetInput(example.input);
    filter->SetNumberOfWorkUnits(1 + seed % 4);
    const auto caller = seed % 2 == 0 ? Caller::Observer : Caller::OtherThread;
    const Abort abort = AbortAt(*filter, static_cast<float>(seed) / 20.0f, caller);
    EXPECT_TRUE(abort.wasThrown || caller == Caller::OtherThread || filter->GetProgress() == 1.0f);
    EXPECT_TRUE(UpdatedOutput(*filter) == MakeOutput(example)) << "seed " << seed;
  }
}

} // namespace
