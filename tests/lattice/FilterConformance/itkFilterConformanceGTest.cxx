#include "itkFilterDescriptions.h"
#include "itkRecordingImageSource.h"
#include "itkRecordingMultiThreader.h"
#include "itkRefusal.h"

#include "itkCommand.h"

#include <iostream>
#include <sstream>
#include <thread>
#include <typeinfo>

namespace
{

using namespace filtertest;

/** Filters are silent: what they write to the standard streams in all of the tests of this program is kept. */
class Silence : public testing::Environment
{
public:
  void
  SetUp() override
  {
    for (Stream & stream : m_Streams)
    {
      stream.buffer = stream.stream.rdbuf(m_Text.rdbuf());
    }
  }

  void
  TearDown() override
  {
    for (Stream & stream : m_Streams)
    {
      stream.stream.rdbuf(stream.buffer);
    }
    EXPECT_EQ(m_Text.str(), "");
  }

private:
  struct Stream
  {
    std::ostream & stream;
    std::streambuf * buffer;
  };

  std::ostringstream m_Text;
  Stream m_Streams[3] = { { std::cout, nullptr }, { std::cerr, nullptr }, { std::clog, nullptr } };
};

[[maybe_unused]] testing::Environment * const silence = testing::AddGlobalTestEnvironment(new Silence);

template <typename TDescription>
class FilterConformance : public testing::Test
{};
TYPED_TEST_SUITE(FilterConformance, Filters, FilterNames);

/** For filters of images and of surfaces. */
template <typename TDescription>
class AnyFilterConformance : public testing::Test
{};
TYPED_TEST_SUITE(AnyFilterConformance, AllFilters, FilterNames);

template <typename TFilter>
std::string
Printed(const TFilter & filter)
{
  std::ostringstream text;
  filter.Print(text);
  return text.str();
}

TYPED_TEST(AnyFilterConformance, IsCreatedThroughItsBaseClass)
{
  const itk::LightObject::Pointer filter = TypeParam::Filter::New().GetPointer();
  const itk::LightObject::Pointer another = filter->CreateAnother();
  ASSERT_NE(another, nullptr);
  EXPECT_NE(another, filter);
  EXPECT_NE(dynamic_cast<typename TypeParam::Filter *>(another.GetPointer()), nullptr);
  EXPECT_STREQ(another->GetNameOfClass(), filter->GetNameOfClass());
  const std::string name = filter->GetNameOfClass();
  const std::string typeName = typeid(typename TypeParam::Filter).name();
  EXPECT_NE(typeName.find(std::to_string(name.size()) + name), std::string::npos) << name << " is called " << typeName;
}

TYPED_TEST(AnyFilterConformance, HasItsDocumentedDefaults)
{
  const auto filter = TypeParam::Filter::New();
  for (const auto & parameter : TypeParam::GetParameters())
  {
    EXPECT_TRUE(parameter.isDefault(*filter)) << parameter.name;
  }
}

TYPED_TEST(AnyFilterConformance, KeepsWhatIsSetAndIsModifiedByChangesOnly)
{
  const auto filter = TypeParam::Filter::New();
  for (const auto & parameter : TypeParam::GetParameters())
  {
    const auto before = filter->GetMTime();
    parameter.setDefault(*filter);
    EXPECT_EQ(filter->GetMTime(), before) << parameter.name;
    parameter.setOther(*filter);
    const auto changed = filter->GetMTime();
    EXPECT_GT(changed, before) << parameter.name;
    EXPECT_TRUE(parameter.isOther(*filter)) << parameter.name;
    parameter.setOther(*filter);
    EXPECT_EQ(filter->GetMTime(), changed) << parameter.name;
    parameter.setDefault(*filter);
    EXPECT_GT(filter->GetMTime(), changed) << parameter.name;
    EXPECT_TRUE(parameter.isDefault(*filter)) << parameter.name;
  }
}

TYPED_TEST(AnyFilterConformance, PrintsEveryParameterAndItsValue)
{
  const auto filter = TypeParam::Filter::New();
  for (const auto & parameter : TypeParam::GetParameters())
  {
    const std::string line = "  " + parameter.name + ":";
    const auto valueOf = [&line](const std::string & text) {
      const auto begin = text.find(line);
      return begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
    };
    const std::string before = valueOf(Printed(*filter));
    parameter.setOther(*filter);
    const std::string after = valueOf(Printed(*filter));
    EXPECT_NE(before, "") << parameter.name;
    EXPECT_NE(before, after) << parameter.name;
  }
  for (const std::string & name : TypeParam::GetResultNames())
  {
    EXPECT_NE(Printed(*filter).find("  " + name + ": 0\n"), std::string::npos) << name;
  }
}

TYPED_TEST(AnyFilterConformance, RefusesBadParametersNamingTheRemedy)
{
  Random random(1);
  const auto input = TypeParam::MakeInput({ { 6, 7, 8 } }, random);
  for (const auto & parameter : TypeParam::GetParameters())
  {
    for (const auto & refusal : parameter.refusals)
    {
      const auto filter = TypeParam::Filter::New();
      TypeParam::SetWhatHasNoDefault(*filter);
      filter->SetInput(input);
      for (unsigned int time = 0; time < 2; ++time)
      {
        const std::string text = Refusal([&] {
          refusal.set(*filter);
          filter->Update();
        });
        EXPECT_NE(text.find(refusal.remedy), std::string::npos) << parameter.name << ": " << text;
      }
      parameter.setDefault(*filter);
      EXPECT_EQ(Refusal([&] { filter->Update(); }), "") << parameter.name << " is good again";
    }
  }
}

TYPED_TEST(AnyFilterConformance, RefusesToWorkWithoutAnInput)
{
  const auto filter = TypeParam::Filter::New();
  EXPECT_NE(Refusal([&] { filter->UpdateOutputInformation(); }), "");
  EXPECT_NE(Refusal([&] { filter->Update(); }), "");
  EXPECT_NE(Refusal([&] { filter->UpdateLargestPossibleRegion(); }), "");

  const auto example = MakeExample<TypeParam>(2);
  const auto another = example.makeFilter();
  another->SetInput(example.input);
  another->Update();
  another->SetInput(nullptr);
  EXPECT_NE(Refusal([&] { another->Update(); }), "");
}

TYPED_TEST(FilterConformance, TakesAnInputWithoutSamplesOrRefusesIt)
{
  const auto input = TypeParam::InputImage::New();
  input->SetRegions(SizeType{ { 4, 0, 4 } });
  input->Allocate();
  const auto filter = TypeParam::Filter::New();
  filter->SetInput(input);
  std::string output;
  const std::string refusal = Refusal([&] { output = UpdatedOutput(*filter); });
  if (refusal.empty())
  {
    const auto empty = std::decay_t<decltype(*filter->GetOutput())>::New();
    EXPECT_EQ(output.size(), Snapshot(*empty).size()) << "no pixels, or no triangles";
  }
  else
  {
    EXPECT_NE(refusal.find("has no samples"), std::string::npos) << refusal;
  }
}

TYPED_TEST(FilterConformance, RefusesAnInputThatWasNeverAllocated)
{
  const auto input = TypeParam::InputImage::New();
  input->SetRegions(SizeType{ { 6, 7, 8 } });
  const auto filter = TypeParam::Filter::New();
  filter->SetInput(input);
  const std::string refusal = Refusal([&] { filter->UpdateLargestPossibleRegion(); });
  EXPECT_NE(refusal.find("call its Allocate()"), std::string::npos) << refusal;
}

TYPED_TEST(FilterConformance, RefusesAnInputThatWasReleased)
{
  const auto example = MakeExample<TypeParam>(3);
  const std::string expected = MakeOutput(example);
  const itk::SmartPointer pixels = example.input->GetPixelContainer();
  const auto region = example.input->GetBufferedRegion();
  const auto filter = example.makeFilter();
  filter->SetInput(example.input);
  example.input->ReleaseDataFlagOn();
  EXPECT_TRUE(UpdatedOutput(*filter) == expected);
  for (unsigned int time = 0; time < 2; ++time)
  {
    filter->Modified();
    const std::string refusal = Refusal([&] { UpdatedOutput(*filter); });
    EXPECT_NE(refusal.find("turn its ReleaseDataFlag off"), std::string::npos) << refusal;
  }
  example.input->SetBufferedRegion(region);
  example.input->SetPixelContainer(pixels);
  EXPECT_TRUE(UpdatedOutput(*filter) == expected);
}

TYPED_TEST(FilterConformance, HasTheSameOutputForAnyNumberOfWorkUnits)
{
  for (unsigned int seed = 0; seed < 10; ++seed)
  {
    const auto example = MakeExample<TypeParam>(seed);
    const std::string expected = MakeOutput(example);
    for (const unsigned int units : { 1u, 2u, 3u, 7u, 100u })
    {
      const auto filter = example.makeFilter();
      filter->SetInput(example.input);
      filter->SetNumberOfWorkUnits(units);
      EXPECT_TRUE(UpdatedOutput(*filter) == expected) << "seed " << seed << ", " << units << " work units";
    }
  }
}

TYPED_TEST(FilterConformance, WorksOnTheThreadsOfItsMultiThreader)
{
  const auto example = MakeExample<TypeParam>(3, { { 24, 40, 40 } });
  for (const unsigned int units : { 1u, 2u, 4u })
  {
    const auto filter = example.makeFilter();
    const auto threader = RecordingMultiThreader::New();
    filter->SetMultiThreader(threader);
    filter->SetNumberOfWorkUnits(units);
    filter->SetInput(example.input);
    filter->UpdateLargestPossibleRegion();
    EXPECT_EQ(threader->GetMostWorkUnits(), units);
    EXPECT_GE(threader->GetMostAtOnce(), 1u);
    EXPECT_LE(threader->GetMostAtOnce(), units);
    if (units == 1)
    {
      EXPECT_EQ(threader->GetThreads(), std::set<std::thread::id>{ std::this_thread::get_id() });
    }
  }
}

TYPED_TEST(FilterConformance, TakesTheGlobalDefaultNumberOfThreads)
{
  const auto example = MakeExample<TypeParam>(3, { { 32, 64, 64 } });
  const auto usual = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  for (const itk::ThreadIdType threads : { 1, 2, 3 })
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    const ThreaderRecords records;
    const auto filter = example.makeFilter();
    filter->SetInput(example.input);
    filter->UpdateLargestPossibleRegion();
    EXPECT_EQ(records.GetMostWorkUnits(), SeenMultiThreader::New()->GetNumberOfWorkUnits()) << threads;
    if (threads == 1)
    {
      EXPECT_EQ(records.GetThreads(), std::set<std::thread::id>{ std::this_thread::get_id() });
    }
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(usual);
}

TYPED_TEST(AnyFilterConformance, LeavesItsInputAsItIs)
{
  for (unsigned int seed = 0; seed < 10; ++seed)
  {
    const auto example = MakeExample<TypeParam>(seed);
    const std::string before = Snapshot(*example.input);
    const auto changed = example.input->GetMTime();
    MakeOutput(example);
    EXPECT_TRUE(Snapshot(*example.input) == before);
    EXPECT_EQ(example.input->GetMTime(), changed);
  }
}

TYPED_TEST(AnyFilterConformance, RunsOnlyWhenSomethingChanged)
{
  const auto example = MakeExample<TypeParam>(4);
  const auto filter = example.makeFilter();
  unsigned int runs = 0;
  filter->AddObserver(itk::StartEvent(), [&runs](const itk::EventObject &) { ++runs; });
  filter->SetInput(example.input);
  const std::string expected = UpdatedOutput(*filter);
  filter->Update();
  EXPECT_EQ(runs, 1u);
  filter->Modified();
  EXPECT_TRUE(UpdatedOutput(*filter) == expected);
  EXPECT_EQ(runs, 2u);
  example.input->Modified();
  EXPECT_TRUE(UpdatedOutput(*filter) == expected);
  EXPECT_EQ(runs, 3u);
}

TYPED_TEST(FilterConformance, FollowsItsInput)
{
  const auto example = MakeExample<TypeParam>(5);
  const auto filter = example.makeFilter();
  filter->SetInput(example.input);
  UpdatedOutput(*filter);
  auto & first = *example.input->GetBufferPointer();
  first = static_cast<typename TypeParam::InputImage::PixelType>(first == 0 ? 1 : 0);
  example.input->Modified();
  EXPECT_TRUE(UpdatedOutput(*filter) == MakeOutput(example));
}

TYPED_TEST(FilterConformance, FreesAnInputThatIsToBeReleased)
{
  const auto example = MakeExample<TypeParam>(6);
  const std::string expected = MakeOutput(example);
  const auto source = RecordingImageSource<typename TypeParam::InputImage>::New(example.input);
  source->ReleaseDataFlagOn();
  const auto filter = example.makeFilter();
  filter->SetInput(source->GetOutput());
  std::size_t requestsOfARun = 0;
  for (std::size_t run = 1; run < 3; ++run)
  {
    EXPECT_TRUE(UpdatedOutput(*filter) == expected);
    EXPECT_TRUE(source->GetOutput()->GetDataReleased());
    EXPECT_EQ(source->GetOutput()->GetBufferedRegion().GetNumberOfPixels(), 0u);
    requestsOfARun = run == 1 ? source->GetRequests().size() : requestsOfARun;
    EXPECT_EQ(source->GetRequests().size(), run * requestsOfARun);
    filter->Modified();
  }
}

TYPED_TEST(AnyFilterConformance, ProgressesFromZeroToOne)
{
  const auto check = [caller = std::this_thread::get_id()](
                       const Example<TypeParam> & example, unsigned int units, std::size_t fewestReports) {
    const auto filter = example.makeFilter();
    filter->SetInput(example.input);
    filter->SetNumberOfWorkUnits(units);
    std::vector<float> reports;
    filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
      reports.push_back(filter->GetProgress());
      EXPECT_EQ(std::this_thread::get_id(), caller);
    });
    for (unsigned int run = 0; run < 2; ++run)
    {
      reports.clear();
      filter->UpdateLargestPossibleRegion();
      ASSERT_GE(reports.size(), 2u);
      EXPECT_EQ(reports.front(), 0.0f);
      EXPECT_EQ(reports.back(), 1.0f);
      EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end())) << testing::PrintToString(reports);
      EXPECT_GE(std::set<float>(reports.begin(), reports.end()).size(), fewestReports);
      filter->Modified();
    }
  };
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    check(MakeExample<TypeParam>(seed), 1 + seed % 8, 2);
  }
  check(MakeExample<TypeParam>(7, { { 24, 40, 40 } }), 1, 8);
}

} // namespace
