#include "itkExampleLabelWalls.h"

#include "itkMultiThreaderBase.h"
#include "itkTriangleSurfaceAudit.h"

namespace
{

using namespace itk::example;
using Point = LabelImage::PointType;

TEST(FCCLabelSurfaceFilter, NoiseGivesSoundWalls)
{
  for (const int labels : { 2, 3, 4, 8, 50 })
  {
    for (unsigned int seed = 0; seed < 6; ++seed)
    {
      const auto image = MakeNoise(Region(static_cast<int>(seed) - 3, 5 + seed, 7, 6), seed, labels);
      ExpectSoundWalls(*MakeWalls(image), *image);
    }
  }
}

TEST(FCCLabelSurfaceFilter, BlobsGiveSoundWalls)
{
  for (unsigned int seed = 0; seed < 12; ++seed)
  {
    const auto image =
      MakeBlobs(Region(-static_cast<int>(seed), 11, 19 + seed, 20), seed, 2 + 4 * static_cast<int>(seed));
    ExpectSoundWalls(*MakeWalls(image), *image);
  }
}

/** Takes a minute: the label long. */
TEST(FCCLabelSurfaceFilter, AThousandVolumesGiveSoundWalls)
{
  for (unsigned int seed = 0; seed < 500; ++seed)
  {
    const int labels = 2 + static_cast<int>(seed % 49);
    const auto noise = MakeNoise(Region(static_cast<int>(seed % 5) - 2, 4 + seed % 6, 7, 5 + seed % 4), seed, labels);
    ExpectSoundWalls(*MakeWalls(noise), *noise);
    const auto blobs = MakeBlobs(Region(static_cast<int>(seed % 7) - 3, 9, 14 + seed % 6, 15), seed, labels);
    ExpectSoundWalls(*MakeWalls(blobs), *blobs);
    if (HasFatalFailure())
    {
      FAIL() << "seed " << seed;
    }
  }
}

TEST(FCCLabelSurfaceFilter, LabelsReachTo65535)
{
  const auto image = MakeLabels(Region(0, 3, 4, 4), [](const itk::Index<3> & index) {
    return static_cast<std::uint16_t>(65535 - index[0] - 3 * (index[1] - 1));
  });
  const auto walls = MakeWalls(image);
  ExpectSoundWalls(*walls, *image);
  EXPECT_EQ(walls->FindLabels().back(), 65535);
}

TEST(FCCLabelSurfaceFilter, SurfacesOfNoiseDoNotCrossWhereverWeightsTie)
{
  for (unsigned int seed = 0; seed < 4; ++seed)
  {
    const auto image = MakeNoise(Region(0, 6, 8, 8), seed, 5);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> weight(-2.0f, 2.0f);
    const auto weights = itk::FCCLabelWeights::New();
    weights->SetNumberOfRows(64);
    for (itk::SizeValueType row = 0; row < 64; ++row)
    {
      for (std::uint16_t i = 0; i < 6; ++i)
      {
        for (std::uint16_t label = 0; label < 5; ++label)
        {
          weights->Add(row, { i, label, weight(random) });
        }
      }
      weights->SortRow(row);
    }
    const auto walls = MakeWalls(image, weights);
    ExpectSoundWalls(*walls, *image);
    EXPECT_EQ(itk::AuditTriangleSurface(*walls).intersections.crossingPairs, 0u);
  }
}

/** All labels' weights are linear, so each point lies where those of its labels are equal and no other is larger. */
TEST(FCCLabelSurfaceFilter, TiesOfLinearWeightsAreExact)
{
  const std::array<std::array<double, 4>, 4> planes{
    { { 0.31, 0.22, -0.4, -2.1 }, { -0.5, 0.1, 0.13, 3.4 }, { 0.2, -0.61, 0.25, 1.1 }, { 0.05, 0.3, 0.21, -3.3 } }
  };
  const auto weightAt = [&planes](const Point & p, std::uint16_t label) {
    const auto & plane = planes[label - 1];
    return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3];
  };
  const auto region = Region(-4, 12, 22, 24);
  const auto image = LabelImage::New();
  image->SetRegions(region);
  image->SetSpacing(LabelImage::SpacingType(0.8));
  image->Allocate();
  const auto weights = itk::FCCLabelWeights::New();
  weights->SetNumberOfRows(region.GetSize(1) * region.GetSize(2));
  for (itk::ImageRegionIteratorWithIndex<LabelImage> it(image, region); !it.IsAtEnd(); ++it)
  {
    const auto point = image->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    const auto offset = it.GetIndex() - region.GetIndex();
    const auto row =
      static_cast<itk::SizeValueType>(offset[2]) * region.GetSize(1) + static_cast<itk::SizeValueType>(offset[1]);
    it.Set(1);
    for (std::uint16_t label = 1; label <= 4; ++label)
    {
      it.Set(weightAt(point, label) > weightAt(point, it.Get()) ? label : it.Get());
      weights->Add(row, { static_cast<std::uint16_t>(offset[0]), label, static_cast<float>(weightAt(point, label)) });
    }
  }
  for (itk::SizeValueType row = 0; row < weights->GetNumberOfRows(); ++row)
  {
    weights->SortRow(row);
  }
  const auto walls = MakeWalls(image, weights);
  ExpectSoundWalls(*walls, *image);
  double sum = 0.0;
  std::size_t inner = 0;
  for (std::size_t n = 0; n < walls->GetNumberOfTriangles(); ++n)
  {
    const auto & pair = walls->GetTriangleLabels()[n];
    for (const std::uint32_t corner : walls->GetTriangles()[n])
    {
      if (pair[0] != 0)
      {
        const auto & p = walls->GetPoints()[corner];
        const Point point(p.data());
        sum += std::abs(weightAt(point, pair[0]) - weightAt(point, pair[1]));
        ++inner;
      }
    }
  }
  ASSERT_GT(inner, 1000u);
  EXPECT_LT(sum / static_cast<double>(inner), 0.02); // points at junctions may have been moved into their simplices
}

TEST(FCCLabelSurfaceFilter, BytesDoNotDependOnThreads)
{
  const auto image = MakeBlobs(Region(-2, 30, 41, 37), 5, 20);
  const auto one = MakeWalls(image, nullptr, 1);
  for (const unsigned int threads : { 2, 3, 8 })
  {
    const auto several = MakeWalls(image, nullptr, threads);
    EXPECT_EQ(one->GetPoints(), several->GetPoints());
    EXPECT_EQ(one->GetTriangles(), several->GetTriangles());
    EXPECT_EQ(one->GetTriangleLabels(), several->GetTriangleLabels());
  }
}

TEST(FCCLabelSurfaceFilter, LeftHandedImagesFaceOutwards)
{
  const auto image = MakeBlobs(Region(0, 12, 14, 16), 3, 7);
  LabelImage::DirectionType direction;
  direction.SetIdentity();
  direction(0, 0) = -1.0;
  image->SetDirection(direction);
  ExpectSoundWalls(*MakeWalls(image), *image);
}

TEST(FCCLabelSurfaceFilter, ImagesWithoutWallsGiveNone)
{
  const auto image = MakeLabels(Region(0, 4, 4, 4), [](const auto &) { return std::uint16_t{ 0 }; });
  EXPECT_EQ(MakeWalls(image)->GetNumberOfPoints(), 0u);
  const auto one = MakeLabels(Region(0, 1, 1, 1), [](const auto &) { return std::uint16_t{ 9 }; });
  ExpectSoundWalls(*MakeWalls(one), *one);
}

TEST(FCCLabelSurfaceFilter, WeightsOfAnotherImageAreRefused)
{
  const auto image = MakeNoise(Region(0, 4, 4, 4), 1, 3);
  const auto weights = itk::FCCLabelWeights::New();
  weights->SetNumberOfRows(3);
  EXPECT_THROW(MakeWalls(image, weights), itk::ExceptionObject);
}

TEST(FCCLabelSurfaceFilter, MergedLabelsAreClosedManifolds)
{
  for (unsigned int seed = 0; seed < 12; ++seed)
  {
    const auto labels = MakeNoise(Region(0, 8, 9, 10), seed, 7);
    const auto merged = MakeNoise(Region(0, 8, 9, 10), seed, 7);
    const std::vector<std::uint16_t> numbers{ 0, 3, 1, 1, 2, 3, 0 };
    for (itk::ImageRegionIteratorWithIndex<LabelImage> it(merged, merged->GetBufferedRegion()); !it.IsAtEnd(); ++it)
    {
      it.Set(numbers[it.Get()]);
    }
    const auto walls = MakeWalls(labels);
    walls->MergeLabels(numbers);
    ExpectSoundWalls(*walls, *merged);
  }
}

} // namespace
