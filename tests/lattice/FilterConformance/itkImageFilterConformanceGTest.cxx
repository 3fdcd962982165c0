#include "itkFilterDescriptions.h"
#include "itkRecordingImageSource.h"

#include "itkStreamingImageFilter.h"

namespace
{

using namespace filtertest;

template <typename TDescription>
class ImageFilterConformance : public testing::Test
{
protected:
  using Filter = typename TDescription::Filter;
  using Source = RecordingImageSource<typename TDescription::InputImage>;

  /** What a filter in a pipeline asks its input for, to make a part of its output. */
  static RegionType
  RequestFor(Filter & filter, const RegionType & part)
  {
    filter.GetOutput()->SetRequestedRegion(part);
    filter.GetOutput()->PropagateRequestedRegion();
    return filter.GetInput()->GetRequestedRegion();
  }
};
TYPED_TEST_SUITE(ImageFilterConformance, ImageFilters, FilterNames);

/** The smallest region that holds both. */
RegionType
Join(const RegionType & a, const RegionType & b)
{
  RegionType joined;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto begin = std::min(a.GetIndex(axis), b.GetIndex(axis));
    const auto last = std::max(a.GetUpperIndex()[axis], b.GetUpperIndex()[axis]);
    joined.SetIndex(axis, begin);
    joined.SetSize(axis, static_cast<itk::SizeValueType>(last - begin) + 1);
  }
  return joined;
}

TYPED_TEST(ImageFilterConformance, MakesAnyPartAsItIsInTheWhole)
{
  for (unsigned int seed = 0; seed < 200; ++seed)
  {
    const auto example = MakeExample<TypeParam>(seed);
    const auto whole = example.makeFilter();
    whole->SetInput(example.input);
    whole->UpdateLargestPossibleRegion();

    Random random(seed);
    const auto source = TestFixture::Source::New(example.input);
    const auto filter = example.makeFilter();
    filter->SetInput(source->GetOutput());
    filter->SetNumberOfWorkUnits(1 + seed % 5);
    for (unsigned int n = 0; n < 3; ++n)
    {
      filter->UpdateOutputInformation();
      const RegionType part = MakePart(filter->GetOutput()->GetLargestPossibleRegion(), random);
      filter->GetOutput()->SetRequestedRegion(part);
      filter->Update();
      ASSERT_TRUE(filter->GetOutput()->GetBufferedRegion().IsInside(part));
      EXPECT_TRUE(BytesOf(*filter->GetOutput(), part) == BytesOf(*whole->GetOutput(), part))
        << "seed " << seed << ", " << part;
      EXPECT_EQ(filter->GetOutput()->GetOrigin(), whole->GetOutput()->GetOrigin());
    }
  }
}

TYPED_TEST(ImageFilterConformance, AsksForTheInputItNeeds)
{
  for (unsigned int seed = 0; seed < 60; ++seed)
  {
    const auto example = MakeExample<TypeParam>(seed);
    const auto filter = example.makeFilter();
    const auto source = TestFixture::Source::New(example.input);
    filter->SetInput(source->GetOutput());
    filter->UpdateOutputInformation();
    Random random(seed);
    RegionType part = MakePart(filter->GetOutput()->GetLargestPossibleRegion(), random);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      part.SetSize(axis, std::min<itk::SizeValueType>(part.GetSize(axis), 4));
    }
    const RegionType request = TestFixture::RequestFor(*filter, part);
    if (!TypeParam::IsRegional)
    {
      EXPECT_EQ(request, example.input->GetLargestPossibleRegion());
      continue;
    }
    RegionType joined;
    for (itk::SizeValueType n = 0; n < part.GetNumberOfPixels(); ++n)
    {
      const RegionType sample({ { part.GetIndex(0) + static_cast<long>(n % part.GetSize(0)),
                                  part.GetIndex(1) + static_cast<long>(n / part.GetSize(0) % part.GetSize(1)),
                                  part.GetIndex(2) + static_cast<long>(n / part.GetSize(0) / part.GetSize(1)) } },
                              { { 1, 1, 1 } });
      const RegionType own = TestFixture::RequestFor(*filter, sample);
      joined = n == 0 ? own : Join(joined, own);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        EXPECT_LE(own.GetSize(axis), TypeParam::MostSamples) << "seed " << seed << ", " << sample;
      }
    }
    EXPECT_TRUE(joined.IsInside(request))
      << "seed " << seed << ": " << part << " asks for " << request << "instead of " << joined;
  }
}

TYPED_TEST(ImageFilterConformance, IsTheSameInPieces)
{
  using OutputImage = typename TypeParam::Filter::OutputImageType;
  for (unsigned int seed = 0; seed < 60; ++seed)
  {
    const auto example = MakeExample<TypeParam>(seed);
    const auto filter = example.makeFilter();
    filter->SetInput(example.input);
    const auto streaming = itk::StreamingImageFilter<OutputImage, OutputImage>::New();
    streaming->SetInput(filter->GetOutput());
    streaming->SetNumberOfStreamDivisions(2 + seed % 5);
    EXPECT_TRUE(UpdatedOutput(*streaming) == MakeOutput(example)) << "seed " << seed;
  }
}

TYPED_TEST(ImageFilterConformance, StreamsItsInput)
{
  using OutputImage = typename TypeParam::Filter::OutputImageType;
  constexpr unsigned int pieces = 4;
  const auto example = MakeExample<TypeParam>(9, { { 8, 9, 80 } });
  const auto source = TestFixture::Source::New(example.input);
  const auto filter = TypeParam::Filter::New();
  TypeParam::AskForParts(*filter);
  filter->SetInput(source->GetOutput());
  const auto streaming = itk::StreamingImageFilter<OutputImage, OutputImage>::New();
  streaming->SetInput(filter->GetOutput());
  streaming->SetNumberOfStreamDivisions(pieces);
  streaming->Update();
  const auto & requests = source->GetRequests();
  const auto whole = example.input->GetLargestPossibleRegion().GetNumberOfPixels();
  ASSERT_EQ(requests.size(), TypeParam::IsRegional ? pieces : 1u);
  for (const RegionType & request : requests)
  {
    EXPECT_LE(request.GetNumberOfPixels(), TypeParam::IsRegional ? whole / 2 : whole);
  }
}

} // namespace
