#include "itkFCCGaussianImageFilter.h"
#include "itkFCCLinearField.h"

#include "itkConnectedComponentImageFilter.h"
#include "itkFlipImageFilter.h"
#include "itkLinearInterpolateImageFunction.h"
#include "itkNearestNeighborInterpolateImageFunction.h"
#include "itkPermuteAxesImageFilter.h"
#include "itkRegionOfInterestImageFilter.h"
#include "itkShrinkImageFilter.h"
#include "itkSignedMaurerDistanceMapImageFilter.h"
#include "itkSmoothingRecursiveGaussianImageFilter.h"

#include <gtest/gtest.h>

#include <type_traits>

/** Filters of ITK that take an FCCImage for a Cartesian one: what they make of it is not what they promise. These tests
 * hold the warnings of modules/lattice/FCCLattice/README.md: where one fails, the table there is wrong. */
namespace
{

using LatticeType = itk::FCCImage<float>;
using RegionType = LatticeType::RegionType;
using MaskType = itk::FCCImage<std::uint8_t>;

/** Largest difference to the linear field in the image, but for a margin of samples. */
double
ErrorOf(const LatticeType * image, itk::SizeValueType margin = 0)
{
  RegionType interior = image->GetBufferedRegion();
  interior.ShrinkByRadius(margin);
  double error = 0.0;
  for (itk::ImageRegionConstIteratorWithIndex<LatticeType> it(image, interior); !it.IsAtEnd(); ++it)
  {
    const auto point = image->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    error = std::max(error, std::abs(it.Get() - fcctest::LinearField(point)));
  }
  return error;
}

template <typename TImage, typename = void>
struct HasNeighborhoodAccessor : std::false_type
{};
template <typename TImage>
struct HasNeighborhoodAccessor<TImage, std::void_t<typename TImage::NeighborhoodAccessorFunctorType>> : std::true_type
{};

TEST(FCCMeaningless, FiltersOfCartesianNeighborhoodsDoNotCompile)
{
  static_assert(HasNeighborhoodAccessor<itk::Image<float, 3>>::value, "itk::ConstNeighborhoodIterator needs it");
  static_assert(!HasNeighborhoodAccessor<LatticeType>::value, "or it would compile for FCCImages");
}

TEST(FCCMeaningless, CartesianInterpolators)
{
  const auto image = fcctest::MakeTurnedLinearField();
  const auto nearest = itk::NearestNeighborInterpolateImageFunction<LatticeType>::New();
  const auto linear = itk::LinearInterpolateImageFunction<LatticeType>::New();
  nearest->SetInputImage(image);
  linear->SetInputImage(image);
  const auto even = image->TransformIndexToPhysicalPoint<double>({ { 1, 12, 2 } });
  const auto odd = image->TransformIndexToPhysicalPoint<double>({ { 1, 13, 2 } });
  EXPECT_NEAR(nearest->Evaluate(even), fcctest::LinearField(even), 1e-4);
  EXPECT_NEAR(linear->Evaluate(even), fcctest::LinearField(even), 1e-4);
  EXPECT_GT(std::abs(nearest->Evaluate(odd) - fcctest::LinearField(odd)), 0.3) << "not even at a sample";
  EXPECT_GT(std::abs(linear->Evaluate(odd) - fcctest::LinearField(odd)), 0.1);
}

TEST(FCCMeaningless, RegionOfInterestIsRightOnlyFromRowsOfParityZero)
{
  const auto filter = itk::RegionOfInterestImageFilter<LatticeType, LatticeType>::New();
  filter->SetInput(fcctest::MakeTurnedLinearField());
  filter->SetRegionOfInterest({ { { -1, 8, -2 } }, { { 4, 5, 6 } } });
  filter->Update();
  EXPECT_LT(ErrorOf(filter->GetOutput()), 1e-4);
  filter->SetRegionOfInterest({ { { -1, 7, -2 } }, { { 4, 5, 6 } } });
  filter->Update();
  EXPECT_GT(ErrorOf(filter->GetOutput()), 0.3) << "the new index (0, 0, 0) is taken for a row of parity 0";
}

TEST(FCCMeaningless, ShrinkFlipAndPermuteAxesMisplaceSamples)
{
  const auto image = fcctest::MakeTurnedLinearField();
  const auto shrink = itk::ShrinkImageFilter<LatticeType, LatticeType>::New();
  shrink->SetInput(image);
  shrink->SetShrinkFactors(2);
  shrink->Update();
  EXPECT_GT(ErrorOf(shrink->GetOutput()), 0.3);

  const auto flip = itk::FlipImageFilter<LatticeType>::New();
  flip->SetInput(image);
  itk::FixedArray<bool, 3> axes(false);
  axes[0] = true;
  flip->SetFlipAxes(axes);
  flip->FlipAboutOriginOff(); // so that an itk::Image keeps its samples where they are
  flip->Update();
  EXPECT_GT(ErrorOf(flip->GetOutput()), 0.3);

  const auto permute = itk::PermuteAxesImageFilter<LatticeType>::New();
  permute->SetInput(image);
  itk::FixedArray<unsigned int, 3> order;
  order[0] = 1;
  order[1] = 0;
  order[2] = 2;
  permute->SetOrder(order);
  permute->Update();
  EXPECT_GT(ErrorOf(permute->GetOutput()), 0.3);
}

TEST(FCCMeaningless, RecursiveGaussianMovesLinearFieldsAndOursDoesNot)
{
  auto image = LatticeType::New();
  image->SetRegions(RegionType({ { 0, 0, 0 } }, { { 20, 40, 40 } }));
  image->Allocate();
  fcctest::Sample(image.GetPointer(), fcctest::LinearField);
  const auto theirs = itk::SmoothingRecursiveGaussianImageFilter<LatticeType, LatticeType>::New();
  theirs->SetInput(image);
  theirs->SetSigma(2.0);
  theirs->Update();
  const auto ours = itk::FCCGaussianImageFilter<LatticeType>::New();
  ours->SetInput(image);
  ours->SetSigma(2.0);
  ours->Update();
  EXPECT_LT(ErrorOf(ours->GetOutput(), 9), 1e-3);
  EXPECT_GT(ErrorOf(theirs->GetOutput(), 9), 0.2);
}

/** Sites at (0, 0, 0) and one of its nearest neighbours, in the middle of a mask. */
MaskType::Pointer
MakePair(const itk::FCCLattice::SiteType & neighbor)
{
  auto mask = MaskType::New();
  mask->SetRegions(RegionType({ { -3, -3, -3 } }, { { 7, 7, 7 } }));
  mask->Allocate(true);
  mask->SetPixel({ { 0, 0, 0 } }, 1);
  mask->SetPixel(itk::FCCLattice::IndexOf(neighbor), 1);
  return mask;
}

TEST(FCCMeaningless, ConnectedComponentsAreNotThoseOfTheLattice)
{
  unsigned int connected = 0;
  for (const auto & neighbor : itk::FCCLattice::NearestNeighbors)
  {
    const auto filter = itk::ConnectedComponentImageFilter<MaskType, itk::FCCImage<std::uint16_t>>::New();
    filter->SetInput(MakePair(neighbor));
    filter->Update();
    connected += filter->GetObjectCount() == 1 ? 1u : 0u;
  }
  EXPECT_EQ(connected, 4u) << "of 12 nearest neighbours";
}

TEST(FCCMeaningless, DistanceMapsAreNotThoseOfTheLattice)
{
  const auto mask = MakePair({ { 0, 0, 0 } });
  const auto filter = itk::SignedMaurerDistanceMapImageFilter<MaskType, LatticeType>::New();
  filter->SetInput(mask);
  filter->SquaredDistanceOff();
  filter->UseImageSpacingOn();
  filter->Update();
  unsigned int right = 0;
  for (const auto & neighbor : itk::FCCLattice::NearestNeighbors)
  {
    const float distance = filter->GetOutput()->GetPixel(itk::FCCLattice::IndexOf(neighbor));
    right += std::abs(distance - std::sqrt(2.0f)) < 1e-3f ? 1u : 0u;
  }
  EXPECT_LT(right, 12u) << "all are sqrt(2) away";
}

} // namespace
