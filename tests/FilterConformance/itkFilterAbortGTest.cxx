#include "itkFilterDescriptions.h"

#include "itkCastImageFilter.h"
#include "itkCommand.h"
#include "itkStreamingImageFilter.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <random>
#include <thread>

namespace
{

using namespace filtertest;

enum class Caller
{
  Observer,
  OtherThread
};

#ifdef __SANITIZE_THREAD__
constexpr double MostAfterAbort = 2000.0; // ms, where each access to memory is looked at
#else
constexpr double MostAfterAbort = 100.0; // ms
#endif

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

/** Aborts an update at some progress, or after some time. */
template <typename TFilter>
Abort
AbortAt(TFilter & filter,
        float progress,
        Caller caller,
        std::chrono::milliseconds longest = std::chrono::milliseconds(500))
{
  std::atomic<double> when{ 0.0 };
  std::atomic<bool> isUpdating{ true };
  const auto abort = [&] {
    when = ComputingTime();
    filter.AbortGenerateDataOn();
  };
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

TEST(FilterAbortWhileStreaming, NothingHalfMadeIsUsedAfterItEither)
{
  Random random(2);
  using InputType = itk::FCCImage<float>;
  const auto input = MakeFrame<InputType>({ { 20, 40, 40 } }, random);
  FillWithGyroid(*input, random);
  const auto copy = itk::CastImageFilter<InputType, InputType>::New();
  copy->SetInput(input);
  copy->InPlaceOff();
  const auto pieces = itk::StreamingImageFilter<InputType, InputType>::New(); // ends without a word when aborted
  pieces->SetInput(copy->GetOutput());
  pieces->SetNumberOfStreamDivisions(10);
  const auto filter = itk::FCCIsosurfaceFilter<InputType>::New();
  filter->SetInput(input);
  const std::string expected = UpdatedOutput(*filter);
  filter->SetInput(pieces->GetOutput());
  filter->SetNumberOfStreamDivisions(2);
  unsigned int aborted = 0;
  for (unsigned int abortAt = 1; abortAt < 60; ++abortAt)
  {
    unsigned int events = 0;
    const auto observer = pieces->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
      if (++events == abortAt)
      {
        filter->AbortGenerateDataOn();
      }
    });
    input->Modified();
    try
    {
      filter->Update();
    }
    catch (const itk::ProcessAborted &)
    {
      ++aborted;
    }
    pieces->RemoveObserver(observer);
    EXPECT_TRUE(UpdatedOutput(*filter) == expected) << "after an abort at event " << abortAt;
  }
  EXPECT_GT(aborted, 10u);
}

TEST(FilterAbortInNoise, IsosurfacesOfNoiseStopToo)
{
  const auto input = itk::FCCImage<float>::New();
  input->SetRegions(SizeType{ { 48, 96, 96 } });
  input->Allocate();
  Random random(3);
  std::normal_distribution<float> noise;
  std::generate_n(
    input->GetBufferPointer(), input->GetLargestPossibleRegion().GetNumberOfPixels(), [&] { return noise(random); });
  const auto filter = itk::FCCIsosurfaceFilter<itk::FCCImage<float>>::New();
  filter->SetInput(input);
  filter->SetNumberOfWorkUnits(2);
  double last = ComputingTime();
  double longest = 0.0;
  const double start = last;
  const auto observer = filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    const double now = ComputingTime();
    longest = std::max(longest, now - last);
    last = now;
  });
  filter->Update();
  EXPECT_LE(longest, 0.3 * (ComputingTime() - start)) << "without progress, of all computing";
  filter->RemoveObserver(observer);

  for (const float progress : { 0.2f, 0.45f, 0.6f, 0.7f })
  {
    filter->Modified();
    const Abort abort = AbortAt(*filter, progress, Caller::Observer, std::chrono::hours(1));
    EXPECT_TRUE(abort.wasThrown) << progress;
    EXPECT_LE(abort.computedAfter, MostAfterAbort) << progress;
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
