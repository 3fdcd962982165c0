#include "itkFCCIsosurfaceFilter.h"

#include "itkCommand.h"
#include "itkFCCTestImages.h"
#include "itkImageAlgorithm.h"
#include "itkImageSource.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace
{

using fcctest::ImageType;
using Filter = itk::FCCIsosurfaceFilter<ImageType>;
using Mode = itk::FCCIsosurfaceMode;
using Surface = itk::TriangleSurface;
using Region = ImageType::RegionType;

/** Gives no more of an image than it is asked for, and remembers what that was. */
class SlabSource : public itk::ImageSource<ImageType>
{
public:
  using Self = SlabSource;
  using Superclass = itk::ImageSource<ImageType>;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);
  itkTypeMacro(SlabSource, ImageSource);

  itkSetConstObjectMacro(Image, ImageType);
  itkSetMacro(CanStream, bool);

  std::vector<Region> m_Requests;
  std::size_t m_FailingRequest{ 0 };           ///< counted from 1; 0: none
  itk::SizeValueType m_MostSamplesBefore{ 0 }; ///< in the buffer when it was asked for others

protected:
  void
  GenerateOutputInformation() override
  {
    ImageType * const output = this->GetOutput();
    output->CopyInformation(m_Image);
    output->SetLargestPossibleRegion(m_Image->GetLargestPossibleRegion());
  }

  void
  EnlargeOutputRequestedRegion(itk::DataObject * output) override
  {
    if (!m_CanStream)
    {
      output->SetRequestedRegionToLargestPossibleRegion();
    }
  }

  void
  GenerateData() override
  {
    ImageType * const output = this->GetOutput();
    const Region requested = output->GetRequestedRegion();
    m_MostSamplesBefore = std::max(m_MostSamplesBefore, output->GetBufferedRegion().GetNumberOfPixels());
    this->AllocateOutputs();
    m_Requests.push_back(requested);
    if (m_Requests.size() == m_FailingRequest)
    {
      itkExceptionMacro("the file can't be read");
    }
    itk::ImageAlgorithm::Copy(m_Image.GetPointer(), output, requested, requested);
  }

private:
  ImageType::ConstPointer m_Image;
  bool m_CanStream{ true };
};

SlabSource::Pointer
MakeSource(const ImageType * image)
{
  const auto source = SlabSource::New();
  source->SetImage(image);
  return source;
}

/** Noise about a wavy field, so that there are smooth parts and split sites, with an odd start, and mirrored. */
ImageType::Pointer
MakeRoughImage(unsigned int seed, const Region & region, float noise)
{
  const auto image = fcctest::MakeNoise(region, seed, 100);
  ImageType::DirectionType mirror;
  mirror.SetIdentity();
  mirror[1][1] = -1.0;
  image->SetDirection(mirror);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, region); !it.IsAtEnd(); ++it)
  {
    const auto site = itk::FCCLattice::SiteOf(it.GetIndex());
    const double wave = std::sin(0.5 * static_cast<double>(site[0])) + std::sin(0.4 * static_cast<double>(site[1])) +
                        std::sin(0.6 * static_cast<double>(site[2]));
    it.Set(static_cast<float>(wave) + noise * (it.Get() / 50.0f - 1.0f));
  }
  return image;
}

const Region OddRegion{ { { -3, 2, -5 } }, { { 13, 22, 31 } } };

void
ExpectSameBytes(const Surface & surface, const Surface & expected)
{
  EXPECT_TRUE(surface.GetPoints() == expected.GetPoints());
  EXPECT_TRUE(surface.GetNormals() == expected.GetNormals());
  EXPECT_TRUE(surface.GetTriangles() == expected.GetTriangles());
}

Filter::Pointer
MakeFilter(const ImageType * image, Mode mode, unsigned int divisions)
{
  const auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetMode(mode);
  filter->SetIsovalues({ 0.1, -0.6 });
  filter->SetNumberOfStreamDivisions(divisions);
  filter->SetNumberOfWorkUnits(2);
  return filter;
}

class FCCIsosurfaceStreaming : public testing::TestWithParam<Mode>
{};

TEST_P(FCCIsosurfaceStreaming, GivesTheSameBytesFromSlabs)
{
  for (const float noise : { 0.0f, 0.3f, 3.0f })
  {
    const auto image = MakeRoughImage(7, OddRegion, noise);
    for (unsigned int variant = 0; variant < 8; ++variant)
    {
      const auto set = [variant](Filter & filter) {
        filter.SetClosed((variant & 1) == 0);
        filter.SetInsideIsBelow((variant & 2) != 0);
        filter.SetComputeNormals((variant & 4) == 0);
      };
      const auto whole = MakeFilter(image, GetParam(), 1);
      set(*whole);
      whole->Update();
      ASSERT_GT(whole->GetOutput(1)->GetNumberOfTriangles(), 500u);
      for (const unsigned int divisions : { 2u, 5u, 1000u })
      {
        const auto source = MakeSource(image);
        const auto filter = MakeFilter(source->GetOutput(), GetParam(), divisions);
        set(*filter);
        filter->SetNumberOfWorkUnits(1 + divisions % 2);
        filter->Update();
        for (unsigned int n = 0; n < 2; ++n)
        {
          SCOPED_TRACE(testing::Message() << "noise " << noise << " variant " << variant << " divisions " << divisions);
          ExpectSameBytes(*filter->GetOutput(n), *whole->GetOutput(n));
        }
        const auto slabs = std::min<itk::SizeValueType>(divisions, OddRegion.GetSize(2));
        const auto planesOfSlab = (OddRegion.GetSize(2) + 2 + slabs - 1) / slabs; // with those around the image
        ASSERT_GE(source->m_Requests.size(), slabs);
        for (const Region & request : source->m_Requests)
        {
          ASSERT_LE(request.GetSize(2), planesOfSlab + 2 * 3) << request;
        }
      }
    }
  }
}

/** Puts the parts of surfaces together. */
class JoinedParts : public itk::FCCSurfaceParts
{
public:
  bool
  Begin(std::size_t surface, const std::vector<itk::SizeValueType> & firstPoints, const Bounds & bounds) override
  {
    m_FirstPoints[surface] = firstPoints;
    m_Bounds[surface] = bounds;
    return surface == 0;
  }

  void
  Take(std::size_t surface, Surface & part, itk::SizeValueType end) override
  {
    const auto join = [](const auto & from, auto & to) { to.insert(to.end(), from.begin(), from.end()); };
    Surface & joined = *m_Joined[surface];
    join(part.GetPoints(), joined.GetPoints());
    join(part.GetNormals(), joined.GetNormals());
    join(part.GetTriangles(), joined.GetTriangles());
    EXPECT_EQ(joined.GetNumberOfPoints(), m_FirstPoints[surface][end]);
    ++m_Parts;
  }

  std::array<std::vector<itk::SizeValueType>, 2> m_FirstPoints;
  std::array<Bounds, 2> m_Bounds;
  std::array<Surface::Pointer, 2> m_Joined{ Surface::New(), Surface::New() };
  unsigned int m_Parts = 0;
};

TEST_P(FCCIsosurfaceStreaming, PartsAreThoseOfTheWholeSurface)
{
  for (const float noise : { 0.0f, 3.0f })
  {
    const auto image = MakeRoughImage(7, OddRegion, noise);
    const auto whole = MakeFilter(image, GetParam(), 1);
    whole->Update();
    for (const unsigned int divisions : { 1u, 5u, 1000u })
    {
      const auto source = MakeSource(image);
      const auto filter = MakeFilter(source->GetOutput(), GetParam(), divisions);
      JoinedParts parts;
      filter->SetParts(&parts);
      filter->Update();
      EXPECT_EQ(parts.m_Parts, std::min<itk::SizeValueType>(divisions, OddRegion.GetSize(2)));
      ExpectSameBytes(*parts.m_Joined[0], *whole->GetOutput(0));
      ExpectSameBytes(*filter->GetOutput(1), *whole->GetOutput(1));
      EXPECT_EQ(filter->GetOutput(0)->GetNumberOfPoints(), 0u);
      const auto bounds = whole->GetOutput(0)->GetBounds();
      for (std::size_t n = 0; n < bounds.size(); ++n)
      {
        const double outwards = (n % 2 == 0 ? bounds[n] - parts.m_Bounds[0][n] : parts.m_Bounds[0][n] - bounds[n]);
        EXPECT_GE(outwards, 0.0) << n;
        EXPECT_LE(outwards, 3.0) << n;
      }
    }
  }
}

TEST_P(FCCIsosurfaceStreaming, VolumesOfAnySizeGiveTheSameBytes)
{
  std::mt19937 random(11);
  for (unsigned int trial = 0; trial < 150; ++trial)
  {
    Region region;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      region.SetIndex(axis, static_cast<itk::IndexValueType>(random() % 7) - 3);
      region.SetSize(axis, 1 + random() % (axis == 2 ? 12 : 7));
    }
    const auto image = fcctest::MakeNoise(region, trial, 4);
    for (itk::ImageRegionIterator<ImageType> it(image, region); trial % 3 == 0 && !it.IsAtEnd(); ++it)
    {
      it.Set(random() % 6 == 0 ? std::numeric_limits<float>::quiet_NaN() : it.Get());
    }
    const auto extract = [&](const ImageType * input, unsigned int divisions) {
      const auto filter = MakeFilter(input, GetParam(), divisions);
      filter->SetIsovalues({ 2.0 });
      filter->SetClosed(trial % 2 == 0);
      filter->Update();
      return filter;
    };
    SCOPED_TRACE(testing::Message() << region);
    const auto whole = extract(image, 1);
    const auto streamed = extract(MakeSource(image)->GetOutput(), 1 + static_cast<unsigned int>(random() % 12));
    ExpectSameBytes(*streamed->GetOutput(), *whole->GetOutput());
    ASSERT_EQ(streamed->GetNumberOfUndefinedSamples(), whole->GetNumberOfUndefinedSamples());
  }
}

TEST_P(FCCIsosurfaceStreaming, InputsThatComeWholeAreAskedForOnce)
{
  const auto image = MakeRoughImage(3, OddRegion, 0.3f);
  const auto whole = MakeFilter(image, GetParam(), 1);
  whole->Update();
  const auto inMemory = MakeFilter(image, GetParam(), 4);
  inMemory->Update();
  ExpectSameBytes(*inMemory->GetOutput(), *whole->GetOutput());

  const auto source = MakeSource(image);
  source->SetCanStream(false);
  const auto filter = MakeFilter(source->GetOutput(), GetParam(), 4);
  filter->Update();
  ExpectSameBytes(*filter->GetOutput(), *whole->GetOutput());
  EXPECT_EQ(source->m_Requests.size(), 1u);
}

TEST_P(FCCIsosurfaceStreaming, ReportsProgressStopsOnAbortAndGoesOnAfterwards)
{
  const auto image = MakeRoughImage(5, OddRegion, 0.3f);
  const auto source = MakeSource(image);
  const auto filter = MakeFilter(source->GetOutput(), GetParam(), 5);
  filter->SetNumberOfWorkUnits(1); // of several threads, only that of the caller reports
  float last = 0.0f;
  bool isMonotonic = true;
  int reports = 0;
  int stopAt = -1;
  filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    isMonotonic = isMonotonic && filter->GetProgress() >= last;
    last = filter->GetProgress();
    if (++reports == stopAt)
    {
      filter->AbortGenerateDataOn();
    }
  });
  filter->Update();
  EXPECT_TRUE(isMonotonic);
  EXPECT_EQ(last, 1.0f);
  Surface::Pointer expected = filter->GetOutput();
  expected->DisconnectPipeline();
  const int allReports = reports;
  EXPECT_GT(allReports, 15);

  for (stopAt = 1; stopAt < allReports; stopAt += 3) // at the last one it is too late
  {
    last = 0.0f;
    reports = 0;
    filter->Modified();
    EXPECT_THROW(filter->Update(), itk::ProcessAborted) << "report " << stopAt;
  }
  stopAt = -1;
  filter->Update();
  ExpectSameBytes(*filter->GetOutput(), *expected);
}

INSTANTIATE_TEST_SUITE_P(
  Modes,
  FCCIsosurfaceStreaming,
  testing::Values(Mode::Tetrahedra, Mode::Octahedra, Mode::Parallelepipeds, Mode::Fine, Mode::Lean));

TEST(FCCIsosurfaceStreamingPipeline, UpdatesWhenAndOnlyWhenSomethingChanged)
{
  const auto source = MakeSource(MakeRoughImage(1, OddRegion, 0.3f));
  const auto filter = MakeFilter(source->GetOutput(), Mode::Lean, 3);
  filter->Update();
  const std::size_t requests = source->m_Requests.size();
  filter->Update();
  EXPECT_EQ(source->m_Requests.size(), requests);

  filter->SetMode(Mode::Fine);
  filter->Update();
  const auto other = MakeRoughImage(2, OddRegion, 0.3f);
  const auto expectFine = [&filter](const ImageType * image) {
    const auto whole = MakeFilter(image, Mode::Fine, 1);
    whole->Update();
    ExpectSameBytes(*filter->GetOutput(), *whole->GetOutput());
  };
  expectFine(MakeRoughImage(1, OddRegion, 0.3f));
  source->SetImage(other);
  filter->Update();
  expectFine(other);

  // Another consumer of the same output finds it whole, and streaming goes on from there.
  source->UpdateLargestPossibleRegion();
  EXPECT_EQ(source->GetOutput()->GetBufferedRegion(), OddRegion);
  source->m_Requests.clear();
  filter->Modified();
  filter->Update();
  expectFine(other);
  EXPECT_TRUE(source->m_Requests.empty());
}

TEST(FCCIsosurfaceStreamingPipeline, PassesOverItsInputAsOftenForManyIsovaluesAsForOne)
{
  const std::size_t divisions = 4;
  for (const Mode mode : { Mode::Tetrahedra, Mode::Octahedra, Mode::Parallelepipeds, Mode::Fine, Mode::Lean })
  {
    for (const std::size_t isovalues : { 1u, 2u, 5u })
    {
      const auto source = MakeSource(MakeRoughImage(1, OddRegion, 0.3f));
      const auto filter = MakeFilter(source->GetOutput(), mode, divisions);
      std::vector<double> values(isovalues);
      std::generate(values.begin(), values.end(), [value = -0.5]() mutable { return value += 0.2; });
      filter->SetIsovalues(values);
      filter->Update();
      EXPECT_EQ(source->m_Requests.size(), divisions * (mode == Mode::Lean ? 3 : 2));
    }
  }
}

TEST(FCCIsosurfaceStreamingPipeline, ReleasesSlabsThatSaySo)
{
  for (const bool releases : { false, true })
  {
    const auto source = MakeSource(MakeRoughImage(1, OddRegion, 0.3f));
    source->GetOutput()->SetReleaseDataFlag(releases);
    const auto filter = MakeFilter(source->GetOutput(), Mode::Lean, 3);
    filter->Update();
    EXPECT_EQ(source->m_MostSamplesBefore == 0, releases);
    EXPECT_EQ(source->GetOutput()->GetBufferedRegion().GetNumberOfPixels() == 0, releases);
    EXPECT_EQ(source->GetOutput()->GetReleaseDataFlag(), releases);
  }
}

/** The first slab of a later pass is the one that the next update begins with. Its first request is ITK's own. */
TEST(FCCIsosurfaceStreamingPipeline, NothingHalfMadeIsUsedAfterAFailureUpstream)
{
  const auto image = MakeRoughImage(1, OddRegion, 0.3f);
  const auto whole = MakeFilter(image, Mode::Lean, 1);
  whole->Update();
  constexpr std::size_t requests = 9;
  for (std::size_t failing = 2; failing <= requests; ++failing)
  {
    const auto source = MakeSource(image);
    source->m_FailingRequest = failing;
    const auto filter = MakeFilter(source->GetOutput(), Mode::Lean, 3);
    SCOPED_TRACE(failing);
    EXPECT_THROW(filter->Update(), itk::ExceptionObject);
    filter->Update();
    ExpectSameBytes(*filter->GetOutput(), *whole->GetOutput());
  }
}

TEST(FCCIsosurfaceStreamingPipeline, PinsItsDefault)
{
  const auto filter = Filter::New();
  EXPECT_EQ(filter->GetNumberOfStreamDivisions(), 1u);
  filter->SetNumberOfStreamDivisions(0);
  EXPECT_EQ(filter->GetNumberOfStreamDivisions(), 1u);
}

} // namespace
