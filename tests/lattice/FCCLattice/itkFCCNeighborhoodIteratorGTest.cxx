#include "itkFCCNeighborhoodIterator.h"

#include "itkFCCTestImages.h"

#include "itkImageRegionConstIteratorWithIndex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace
{

using ImageType = itk::FCCImage<float>;
using IndexType = ImageType::IndexType;
using RegionType = ImageType::RegionType;
using IteratorType = itk::FCCConstNeighborhoodIterator<ImageType>;

/** Every sample a different value. */
ImageType::Pointer
MakeCounted(const RegionType & region)
{
  auto image = ImageType::New();
  image->SetRegions(region);
  image->Allocate();
  std::iota(image->GetBufferPointer(), image->GetBufferPointer() + region.GetNumberOfPixels(), 1.0f);
  return image;
}

/** The samples at distance sqrt(2) lattice units of one, found by looking at all of them. */
std::vector<float>
FindNearest(const ImageType & image, const IndexType & center)
{
  const auto from = image.TransformIndexToPhysicalPoint<double>(center);
  std::vector<float> values;
  for (itk::ImageRegionConstIteratorWithIndex<ImageType> it(&image, image.GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const double distance = from.EuclideanDistanceTo(image.TransformIndexToPhysicalPoint<double>(it.GetIndex()));
    if (std::abs(distance - std::sqrt(2.0)) < 1e-9)
    {
      values.push_back(it.Get());
    }
  }
  return values;
}

/** Compares all that the iterator says in a region with what distances between the samples' points say. */
void
ExpectNearestNeighbors(const ImageType & image, const RegionType & region)
{
  itk::ImageRegionConstIteratorWithIndex<ImageType> sample(&image, region);
  for (IteratorType it(&image, region); !it.IsAtEnd(); ++it, ++sample)
  {
    ASSERT_EQ(it.GetIndex(), sample.GetIndex());
    EXPECT_EQ(it.GetCenterPixel(), sample.Get());
    std::vector<float> values;
    const auto from = image.TransformIndexToPhysicalPoint<double>(it.GetIndex());
    for (unsigned int n = 0; n < it.Size(); ++n)
    {
      const auto to = image.TransformIndexToPhysicalPoint<double>(it.GetNeighborIndex(n));
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        EXPECT_NEAR(to[axis] - from[axis], itk::FCCLattice::NearestNeighbors[n][axis], 1e-9);
      }
      if (it.IsNeighborInside(n))
      {
        ASSERT_TRUE(image.GetBufferedRegion().IsInside(it.GetNeighborIndex(n)));
        EXPECT_EQ(it.GetNeighbor(n), image.GetPixel(it.GetNeighborIndex(n)));
        values.push_back(it.GetNeighbor(n));
      }
      else
      {
        EXPECT_EQ(it.GetNeighbor(n), it.GetCenterPixel());
      }
    }
    EXPECT_EQ(it.InBounds(), values.size() == 12);
    std::sort(values.begin(), values.end());
    EXPECT_EQ(values, FindNearest(image, it.GetIndex())) << it.GetIndex();
  }
  EXPECT_TRUE(sample.IsAtEnd());
}

TEST(FCCNeighborhoodIterator, GivesTheNearestSamplesOfEverySample)
{
  const auto image = MakeCounted({ { { -2, 3, 5 } }, { { 4, 5, 4 } } });
  ExpectNearestNeighbors(*image, image->GetBufferedRegion());
}

TEST(FCCNeighborhoodIterator, IsRightInThinImagesOfEitherParity)
{
  for (const itk::IndexValueType start : { -1, 0 })
  {
    for (const itk::Size<3> size :
         { itk::Size<3>{ { 1, 4, 4 } }, { { 4, 1, 4 } }, { { 4, 4, 1 } }, { { 2, 1, 1 } }, { { 1, 1, 1 } } })
    {
      const auto image = MakeCounted({ { { 3, start, 0 } }, size });
      ExpectNearestNeighbors(*image, image->GetBufferedRegion());
    }
  }
}

TEST(FCCNeighborhoodIterator, SeesNeighborsOutsideItsRegion)
{
  const auto image = MakeCounted({ { { -2, 3, 5 } }, { { 6, 6, 5 } } });
  ExpectNearestNeighbors(*image, { { { 0, 4, 6 } }, { { 3, 3, 2 } } });
  ExpectNearestNeighbors(*image, { { { -2, 4, 6 } }, { { 2, 2, 2 } } });
  ExpectNearestNeighbors(*image, { { { 2, 4, 6 } }, { { 2, 5, 4 } } });
}

TEST(FCCNeighborhoodIterator, OutsideTheSampleItselfIsANearestSite)
{
  const auto image = MakeCounted({ { { 0, 0, 0 } }, { { 3, 4, 4 } } });
  for (IteratorType it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    for (unsigned int n = 0; n < it.Size(); ++n)
    {
      if (it.IsNeighborInside(n))
      {
        continue;
      }
      const auto outside = image->TransformIndexToPhysicalPoint<double>(it.GetNeighborIndex(n));
      double nearest = 1e9;
      for (itk::ImageRegionConstIteratorWithIndex<ImageType> at(image, image->GetBufferedRegion()); !at.IsAtEnd(); ++at)
      {
        nearest =
          std::min(nearest, outside.EuclideanDistanceTo(image->TransformIndexToPhysicalPoint<double>(at.GetIndex())));
      }
      const auto itself = image->TransformIndexToPhysicalPoint<double>(it.GetIndex());
      EXPECT_NEAR(outside.EuclideanDistanceTo(itself), nearest, 1e-9);
    }
  }
}

TEST(FCCNeighborhoodIterator, SumOfDifferencesIsTheLaplacianOfAQuadratic)
{
  const auto image = fcctest::MakeImage(
    0.5, 3.0, [](const auto & p) { return 2 * p[0] * p[0] - p[1] * p[1] + 3 * p[2] * p[2] + p[0] * p[1] - p[2]; });
  for (IteratorType it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    if (it.InBounds())
    {
      float sum = 0.0f;
      for (unsigned int n = 0; n < it.Size(); ++n)
      {
        sum += it.GetNeighbor(n) - it.GetCenterPixel();
      }
      EXPECT_NEAR(sum / (4.0f * 0.5f * 0.5f), 8.0f, 2e-4f) << "the sum of d d^T is 8 times the identity";
    }
  }
}

TEST(FCCNeighborhoodIterator, ChangesTheSampleItIsAt)
{
  const auto image = MakeCounted({ { { 0, 1, 0 } }, { { 5, 4, 3 } } });
  const auto dilated = ImageType::New();
  dilated->SetRegions(image->GetBufferedRegion());
  dilated->Allocate(true);
  const IndexType seed{ { 2, 2, 1 } };
  dilated->SetPixel(seed, 1.0f);
  const auto before = ImageType::New();
  before->SetRegions(image->GetBufferedRegion());
  before->Allocate(true);
  before->SetPixel(seed, 1.0f);

  IteratorType from(before, before->GetBufferedRegion());
  for (itk::FCCNeighborhoodIterator<ImageType> it(dilated, dilated->GetBufferedRegion()); !it.IsAtEnd(); ++it, ++from)
  {
    float most = from.GetCenterPixel();
    for (unsigned int n = 0; n < from.Size(); ++n)
    {
      most = std::max(most, from.GetNeighbor(n));
    }
    it.SetCenterPixel(most);
  }
  const float * const pixels = dilated->GetBufferPointer();
  EXPECT_EQ(std::accumulate(pixels, pixels + 60, 0.0f), 13.0f) << "a sample dilated: itself and its 12 neighbours";
}

TEST(FCCNeighborhoodIterator, GoesBackToTheBegin)
{
  const auto image = MakeCounted({ { { 0, 0, 0 } }, { { 3, 2, 2 } } });
  IteratorType it(image, image->GetBufferedRegion());
  unsigned int visited = 0;
  for (unsigned int pass = 0; pass < 2; ++pass)
  {
    for (it.GoToBegin(); !it.IsAtEnd(); ++it)
    {
      ++visited;
    }
  }
  EXPECT_EQ(visited, 24u);
}

/** What the constructor throws. */
std::string
RefusalOf(const ImageType * image, const RegionType & region)
{
  try
  {
    IteratorType(image, region);
  }
  catch (const itk::ExceptionObject & error)
  {
    return error.GetDescription();
  }
  return {};
}

TEST(FCCNeighborhoodIterator, EmptyRegionsEndAtOnceAndOthersMustBeBuffered)
{
  const auto image = MakeCounted({ { { 0, 0, 0 } }, { { 3, 3, 3 } } });
  EXPECT_TRUE(IteratorType(image, { { { 7, 7, 7 } }, { { 0, 2, 2 } } }).IsAtEnd());
  EXPECT_TRUE(IteratorType(ImageType::New(), {}).IsAtEnd());
  const std::string outside = RefusalOf(image, { { { 0, 0, 1 } }, { { 3, 3, 3 } } });
  EXPECT_NE(outside.find("of size [3, 3, 3] at [0, 0, 1], is not inside"), std::string::npos) << outside;
  EXPECT_NE(outside.find("; crop it"), std::string::npos) << outside;
  EXPECT_NE(RefusalOf(nullptr, {}).find("; give one"), std::string::npos);
}

TEST(FCCNeighborhoodIterator, AnImageThatWasNeverAllocatedOrIsReleasedIsRefused)
{
  const RegionType region({ { 0, 0, 0 } }, { { 3, 3, 3 } });
  const auto image = ImageType::New();
  image->SetRegions(region);
  EXPECT_NE(RefusalOf(image, region).find("were never allocated; call its Allocate()"), std::string::npos);
  EXPECT_EQ(RefusalOf(image, {}), "") << "no sample is read";

  const auto released = MakeCounted(region);
  released->ReleaseData();
  EXPECT_NE(RefusalOf(released, region).find("update the image for it first"), std::string::npos);
  released->SetBufferedRegion(region);
  EXPECT_NE(RefusalOf(released, region).find("; call its Allocate()"), std::string::npos);
}

} // namespace
