#include "itkFilterDescription.h"

#include "itkFCCBoxSplineInterpolateImageFunction.h"
#include "itkFCCLinearInterpolateImageFunction.h"

#include <gtest/gtest.h>

#include <sstream>

namespace
{

using namespace filtertest;
using ImageType = itk::FCCImage<std::int16_t>;

template <typename TInterpolator>
class InterpolatorConformance : public testing::Test
{};
using Interpolators = testing::Types<itk::FCCLinearInterpolateImageFunction<ImageType>,
                                     itk::FCCBoxSplineInterpolateImageFunction<ImageType>>;
TYPED_TEST_SUITE(InterpolatorConformance, Interpolators);

TYPED_TEST(InterpolatorConformance, IsCreatedThroughItsBaseClass)
{
  const itk::LightObject::Pointer interpolator = TypeParam::New().GetPointer();
  const itk::LightObject::Pointer another = interpolator->CreateAnother();
  EXPECT_NE(dynamic_cast<TypeParam *>(another.GetPointer()), nullptr);
  EXPECT_NE(another, interpolator);
}

TYPED_TEST(InterpolatorConformance, LeavesItsImageAsItIsAndEvaluatesItsSamples)
{
  for (unsigned int seed = 0; seed < 10; ++seed)
  {
    Random random(seed);
    const auto image = MakeFrame<ImageType>(MakeSize(random), random);
    FillWithGyroid(*image, random);
    const std::string before = Snapshot(*image);
    const auto changed = image->GetMTime();
    const auto interpolator = TypeParam::New();
    interpolator->SetInputImage(image);
    const auto index = MakePart(image->GetBufferedRegion(), random).GetIndex();
    const auto point = image->TransformIndexToPhysicalPoint<double>(index);
    EXPECT_TRUE(interpolator->IsInsideBuffer(point));
    EXPECT_NEAR(interpolator->Evaluate(point), image->GetPixel(index), 40.0);
    EXPECT_EQ(interpolator->EvaluateAtIndex(index), image->GetPixel(index));
    EXPECT_TRUE(Snapshot(*image) == before);
    EXPECT_EQ(image->GetMTime(), changed);
  }
}

TEST(BoxSplineInterpolatorConformance, HasOneParameter)
{
  using Interpolator = itk::FCCBoxSplineInterpolateImageFunction<ImageType>;
  const auto interpolator = Interpolator::New();
  EXPECT_EQ(interpolator->GetNumberOfIterations(), 0u);
  const auto before = interpolator->GetMTime();
  interpolator->SetNumberOfIterations(0);
  EXPECT_EQ(interpolator->GetMTime(), before);
  interpolator->SetNumberOfIterations(7);
  EXPECT_GT(interpolator->GetMTime(), before);
  std::ostringstream text;
  interpolator->Print(text);
  EXPECT_NE(text.str().find("NumberOfIterations: 7\n"), std::string::npos) << text.str();
}

} // namespace
