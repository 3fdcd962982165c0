#include "itkFilterDescriptions.h"

#include "itkCastImageFilter.h"
#include "itkCommand.h"
#include "itkStreamingImageFilter.h"

#include <algorithm>
#include <atomic>
#include <random>
#include <thread>

namespace
{

using namespace filtertest;

/** Share of a filter's work that may be done between an abort and its end: the portions that its threads work on. */
constexpr float MostAfterAbort = 0.05f;

/** A filter that counts how often it checks for an abort, and that another thread aborts during one of these checks. */
template <typename TFilter>
class AbortedFilter : public TFilter
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(AbortedFilter);

  using Self = AbortedFilter;
  using Superclass = TFilter;
  using Pointer = itk::SmartPointer<Self>;

  itkFactorylessNewMacro(Self);

  /** What the next update is to be aborted at: the number of a check, beginning with 1; 0 for none. */
  void
  AbortAtCheck(itk::SizeValueType check)
  {
    m_Checks = 0;
    m_AbortAt = check;
  }

  void
  Abort()
  {
    this->AbortGenerateDataOn();
    m_ProgressAtAbort = this->GetProgress();
  }

  /** Every check comes here, from any thread. */
  const bool &
  GetAbortGenerateData() const override
  {
    if (++m_Checks == m_AbortAt)
    {
      std::thread([this] { const_cast<Self *>(this)->Abort(); }).join();
    }
    return Superclass::GetAbortGenerateData();
  }

  itk::SizeValueType
  GetChecks() const
  {
    return m_Checks;
  }

  /** Share of the work that has been done since the abort. */
  float
  GetProgressAfterAbort() const
  {
    return this->GetProgress() - m_ProgressAtAbort;
  }

protected:
  AbortedFilter() = default;
  ~AbortedFilter() override = default;

private:
  mutable std::atomic<itk::SizeValueType> m_Checks{ 0 };
  itk::SizeValueType m_AbortAt{ 0 };
  std::atomic<float> m_ProgressAtAbort{ 0.0f };
};

/** Updates a filter that is to be aborted: whether it says so. */
template <typename TFilter>
bool
IsAborted(TFilter & filter)
{
  try
  {
    filter.Modified();
    filter.UpdateLargestPossibleRegion();
  }
  catch (const itk::ProcessAborted &)
  {
    return true;
  }
  return false;
}

template <typename TFilter>
itk::SizeValueType
CountChecks(TFilter & filter)
{
  filter.AbortAtCheck(0);
  EXPECT_FALSE(IsAborted(filter));
  return filter.GetChecks();
}

template <typename TImage>
itk::SizeValueType
CountRows(const TImage & image)
{
  const auto & region = image.GetLargestPossibleRegion();
  return region.GetSize(1) * region.GetSize(2);
}

template <typename TDescription>
class AnyFilterAbort : public testing::Test
{
protected:
  using Filter = AbortedFilter<typename TDescription::Filter>;

  void
  SetUp() override
  {
    Random random(1);
    m_Input = TDescription::MakeInput({ { 40, 48, 56 } }, random);
    TDescription::MakeSlow(*m_Filter);
    m_Filter->SetInput(m_Input);
    if (TDescription::ChecksOnOneThread)
    {
      itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1); // for the same number of checks in each update
    }
  }

  void
  TearDown() override
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(m_UsualThreads);
  }

  const itk::ThreadIdType m_UsualThreads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  typename TDescription::InputImage::Pointer m_Input;
  typename Filter::Pointer m_Filter = Filter::New();
};
TYPED_TEST_SUITE(AnyFilterAbort, AllFilters, FilterNames);

template <typename TDescription>
class FilterAbort : public AnyFilterAbort<TDescription>
{};
TYPED_TEST_SUITE(FilterAbort, Filters, FilterNames);

TYPED_TEST(FilterAbort, IsLookedForInEachRow)
{
  const auto & filter = this->m_Filter;
  filter->SetNumberOfWorkUnits(1);
  const itk::SizeValueType checks = CountChecks(*filter);
  if constexpr (std::is_base_of_v<itk::TriangleSurface, std::decay_t<decltype(*filter->GetOutput())>>)
  {
    EXPECT_GE(checks, TypeParam::PassesOverRows * CountRows(*this->m_Input));
  }
  else
  {
    EXPECT_GE(checks, TypeParam::PassesOverRows * CountRows(*filter->GetOutput()));
  }
}

TYPED_TEST(AnyFilterAbort, EndsTheWork)
{
  const auto & filter = this->m_Filter;
  for (const unsigned int units : { 1u, 4u })
  {
    filter->SetNumberOfWorkUnits(units);
    const itk::SizeValueType checks = CountChecks(*filter);
    for (const double share : { 0.0, 0.02, 0.1, 0.3, 0.5, 0.8 })
    {
      filter->AbortAtCheck(1 + static_cast<itk::SizeValueType>(share * static_cast<double>(checks)));
      EXPECT_TRUE(IsAborted(*filter)) << "at " << share << " of all checks with " << units << " work units";
      EXPECT_LE(filter->GetProgressAfterAbort(), MostAfterAbort)
        << "at " << share << " of all checks with " << units << " work units";
    }
  }
}

TYPED_TEST(AnyFilterAbort, ByAnObserverEndsTheWork)
{
  const auto & filter = this->m_Filter;
  float abortAt = 0.0f;
  filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    if (filter->GetProgress() >= abortAt)
    {
      abortAt = 2.0f;
      filter->Abort();
    }
  });
  for (const unsigned int units : { 1u, 4u })
  {
    filter->SetNumberOfWorkUnits(units);
    for (const float progress : { 0.0f, 0.1f, 0.6f })
    {
      abortAt = progress;
      // Where other threads do the rest before the caller's thread reports, nothing is left to be aborted.
      EXPECT_TRUE(IsAborted(*filter) || (units > 1 && filter->GetProgress() == 1.0f)) << progress;
      EXPECT_LE(filter->GetProgressAfterAbort(), MostAfterAbort) << progress;
    }
  }
}

template <typename TDescription>
class SurfaceFilterAbort : public AnyFilterAbort<TDescription>
{};
TYPED_TEST_SUITE(SurfaceFilterAbort, SurfaceFilters, FilterNames);

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
  input->SetRegions(SizeType{ { 32, 64, 64 } });
  input->Allocate();
  Random random(3);
  std::normal_distribution<float> noise;
  std::generate_n(
    input->GetBufferPointer(), input->GetLargestPossibleRegion().GetNumberOfPixels(), [&] { return noise(random); });
  const auto filter = AbortedFilter<itk::FCCIsosurfaceFilter<itk::FCCImage<float>>>::New();
  filter->SetInput(input);
  filter->SetNumberOfWorkUnits(1); // of several threads, only that of the caller reports
  itk::SizeValueType last = 0;
  itk::SizeValueType most = 0;
  const auto observer = filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    most = std::max(most, filter->GetChecks() - last);
    last = filter->GetChecks();
  });
  const itk::SizeValueType checks = CountChecks(*filter);
  EXPECT_LE(most, 3 * checks / 10) << "between two reports, of " << checks;
  filter->RemoveObserver(observer);

  filter->SetNumberOfWorkUnits(2);
  for (const itk::SizeValueType tenths : { 2, 4, 5, 6, 7, 9 })
  {
    filter->AbortAtCheck(tenths * checks / 10);
    EXPECT_TRUE(IsAborted(*filter)) << tenths;
    EXPECT_LE(filter->GetProgressAfterAbort(), MostAfterAbort) << tenths;
  }
}

TEST(FilterAbortWhileStreaming, StopsWhatIsUpstreamToo)
{
  Random random(1);
  const auto input = CartesianToFCC::MakeInput({ { 80, 80, 80 } }, random);
  const auto resample = CartesianToFCC::Filter::New();
  resample->SetInput(input);
  const auto smooth = FCCGaussian<std::int16_t>::Filter::New();
  smooth->SetInput(resample->GetOutput());
  const auto filter = itk::FCCIsosurfaceFilter<itk::FCCImage<std::int16_t>>::New();
  filter->SetInput(smooth->GetOutput());
  const auto check = [&](auto & upstream) {
    upstream.SetNumberOfWorkUnits(1); // of several threads, only that of the caller reports
    resample->SetDensity(2.0);
    smooth->SetSigma(1.0);
    filter->SetNumberOfStreamDivisions(4);
    bool isUpdating = false; // not before: its own update asks for the first slab
    const auto start =
      filter->AddObserver(itk::StartEvent(), [&isUpdating](const itk::EventObject &) { isUpdating = true; });
    float progressAtAbort = 0.0f;
    const auto observer = upstream.AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
      if (isUpdating && progressAtAbort == 0.0f && upstream.GetProgress() > 0.3f)
      {
        progressAtAbort = upstream.GetProgress();
        filter->AbortGenerateDataOn();
      }
    });
    EXPECT_THROW(filter->Update(), itk::ProcessAborted);
    EXPECT_GT(progressAtAbort, 0.3f);
    EXPECT_LE(upstream.GetProgress() - progressAtAbort, MostAfterAbort) << upstream.GetNameOfClass();
    upstream.RemoveObserver(observer);
    filter->RemoveObserver(start);

    resample->SetDensity(0.2);
    const std::string streamed = UpdatedOutput(*filter);
    filter->SetNumberOfStreamDivisions(1);
    EXPECT_TRUE(UpdatedOutput(*filter) == streamed);
  };
  check(*resample);
  check(*smooth);
}

TYPED_TEST(AnyFilterAbort, LeavesAPipelineThatWorks)
{
  for (unsigned int seed = 0; seed < 12; ++seed)
  {
    const auto example = MakeExample<TypeParam>(seed, { { 20, 20, 20 } });
    const auto filter = TestFixture::Filter::New();
    example.vary(*filter);
    filter->SetInput(example.input);
    filter->SetNumberOfWorkUnits(1 + seed % 4);
    filter->AbortAtCheck(1 + seed * CountChecks(*filter) / 20);
    EXPECT_TRUE(IsAborted(*filter)) << "seed " << seed;
    filter->AbortAtCheck(0);
    EXPECT_TRUE(UpdatedOutput(*filter) == MakeOutput(example)) << "seed " << seed;
  }
}

/** Surfaces of any size are checked for an abort after each part of the work. */
TYPED_TEST(SurfaceFilterAbort, IsLookedForOften)
{
  constexpr itk::SizeValueType trianglesOfPart = 10'000;
  const itk::SizeValueType checks = CountChecks(*this->m_Filter);
  EXPECT_GE(checks, this->m_Input->GetNumberOfTriangles() / trianglesOfPart + 20);
}

TYPED_TEST(SurfaceFilterAbort, OnSeveralThreadsEndsTheWorkAndLeavesNoOutput)
{
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(4);
  const auto & filter = this->m_Filter;
  filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    if (filter->GetProgress() >= 0.3f)
    {
      filter->Abort();
    }
  });
  EXPECT_TRUE(IsAborted(*filter));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfTriangles(), 0u);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0u);
}

} // namespace
