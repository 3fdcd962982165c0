#include "itkFCCBoxSplineInterpolateImageFunction.h"

#include "detail/itkFCCMirror.h"
#include "itkFCCBoxSplineDecompositionImageFilter.h"
#include "itkImage.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkResampleImageFilter.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

using ImageType = itk::FCCImage<float>;
using Interpolator = itk::FCCBoxSplineInterpolateImageFunction<ImageType>;
using Decomposition = itk::FCCBoxSplineDecompositionImageFilter<ImageType>;
using PointType = ImageType::PointType;
using RegionType = ImageType::RegionType;

/** An anisotropic image in a rotated frame, sampled from a function of the point. */
template <typename TField>
ImageType::Pointer
MakeImage(const RegionType & region, const TField & field)
{
  auto image = ImageType::New();
  image->SetRegions(region);
  const double spacing[3] = { 0.5, 0.75, 1.25 };
  image->SetSpacing(spacing);
  const double origin[3] = { 3.0, -7.0, 11.0 };
  image->SetOrigin(origin);
  ImageType::DirectionType direction;
  direction.SetIdentity();
  direction[0][0] = direction[1][1] = 0.8;
  direction[0][1] = -0.6;
  direction[1][0] = 0.6;
  image->SetDirection(direction);
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, region); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<float>(field(image->TransformIndexToPhysicalPoint<double>(it.GetIndex()))));
  }
  return image;
}

ImageType::Pointer
MakeNoise(const RegionType & region)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  return MakeImage(region, [&](const PointType &) { return value(random); });
}

double
Quadratic(const PointType & p)
{
  return 1.0 + 0.5 * p[0] - 0.3 * p[1] + 0.2 * p[2] + 0.1 * p[0] * p[0] - 0.05 * p[1] * p[2] + 0.07 * p[0] * p[1];
}

const RegionType middling({ { 1, -2, 3 } }, { { 9, 15, 14 } });

/** Points whose 16 coefficients, and their neighbours, are in the region above. */
template <typename TUse>
void
ForEachInnerPoint(const ImageType & image, const TUse & use)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(6.0, 16.0);
  std::uniform_real_distribution<double> y(1.0, 9.0);
  std::uniform_real_distribution<double> z(6.0, 13.0);
  for (int trial = 0; trial < 3000; ++trial)
  {
    use(image.TransformLatticeToPhysicalPoint<double>({ x(random), y(random), z(random) }));
  }
}

TEST(FCCMirror, ReflectsInTheFirstAndLastSites)
{
  EXPECT_EQ(itk::MirrorIntoRange(-1, 0, 3), 1);
  EXPECT_EQ(itk::MirrorIntoRange(4, 0, 3), 2);
  EXPECT_EQ(itk::MirrorIntoRange(-7, 0, 3), 1);
  EXPECT_EQ(itk::MirrorIntoRange(2, 5, 5), 5);
  for (itk::IndexValueType k = -9; k < 9; ++k)
  {
    for (itk::IndexValueType j = -9; j < 9; ++j)
    {
      for (itk::IndexValueType i = -9; i < 9; ++i)
      {
        const RegionType region({ { -1, 1, -2 } }, { { 3, 4, 2 } });
        const auto mirrored = itk::MirrorIntoRegion({ { i, j, k } }, region);
        ASSERT_TRUE(region.IsInside(mirrored));
        const auto from = itk::FCCLattice::SiteOf({ { i, j, k } });
        const auto to = itk::FCCLattice::SiteOf(mirrored);
        // Reflected about -2 and 3 in x, 1 and 4 in y, -2 and -1 in z.
        ASSERT_EQ(to[0], itk::MirrorIntoRange(from[0], -2, 3));
        ASSERT_EQ(to[1], itk::MirrorIntoRange(from[1], 1, 4));
        ASSERT_EQ(to[2], itk::MirrorIntoRange(from[2], -2, -1));
      }
    }
  }
}

TEST(FCCBoxSplineDecompositionImageFilter, PinsItsDefaultsAndKeepsConstants)
{
  const auto filter = Decomposition::New();
  EXPECT_EQ(filter->GetNumberOfIterations(), 0u);
  for (const RegionType & region : { RegionType({ { 0, 0, 0 } }, { { 1, 1, 1 } }),
                                     RegionType({ { 0, 1, 0 } }, { { 1, 2, 3 } }),
                                     RegionType({ { 3, -1, 2 } }, { { 6, 5, 4 } }) })
  {
    filter->SetInput(MakeImage(region, [](const PointType &) { return 2.5; }));
    for (const unsigned int iterations : { 0u, 3u })
    {
      filter->SetNumberOfIterations(iterations);
      filter->Update();
      const ImageType * const output = filter->GetOutput();
      EXPECT_EQ(output->GetBufferedRegion(), region);
      EXPECT_EQ(output->GetSpacing(), filter->GetInput()->GetSpacing());
      EXPECT_EQ(output->GetOrigin(), filter->GetInput()->GetOrigin());
      EXPECT_EQ(output->GetDirection(), filter->GetInput()->GetDirection());
      for (itk::ImageRegionConstIteratorWithIndex<ImageType> it(output, region); !it.IsAtEnd(); ++it)
      {
        ASSERT_NEAR(it.Get(), 2.5f, 1e-6f);
      }
    }
  }
  EXPECT_THROW(Decomposition::New()->Update(), itk::ExceptionObject);
}

TEST(FCCBoxSplineDecompositionImageFilter, QuasiInterpolantIsTheTwelveNeighborsStencil)
{
  const auto image = MakeNoise(middling);
  const auto filter = Decomposition::New();
  filter->SetInput(image);
  filter->Update();
  for (itk::ImageRegionConstIteratorWithIndex<ImageType> it(image, middling); !it.IsAtEnd(); ++it)
  {
    const auto site = itk::FCCLattice::SiteOf(it.GetIndex());
    double sum = 0.0;
    for (const auto & d : itk::FCCLattice::NearestNeighbors)
    {
      const auto neighbor = itk::FCCLattice::IndexOf({ site[0] + d[0], site[1] + d[1], site[2] + d[2] });
      sum += static_cast<double>(image->GetPixel(itk::MirrorIntoRegion(neighbor, middling)));
    }
    ASSERT_NEAR(filter->GetOutput()->GetPixel(it.GetIndex()), 1.5 * static_cast<double>(it.Get()) - sum / 24.0, 1e-6);
  }
}

TEST(FCCBoxSplineDecompositionImageFilter, GivesTheSameBytesForAnyNumberOfThreads)
{
  const auto image = MakeNoise(middling);
  const auto run = [&image](unsigned int units) {
    const auto filter = Decomposition::New();
    filter->SetInput(image);
    filter->SetNumberOfIterations(4);
    filter->SetNumberOfWorkUnits(units);
    filter->Update();
    const float * const values = filter->GetOutput()->GetBufferPointer();
    return std::vector<float>(values, values + middling.GetNumberOfPixels());
  };
  const auto single = run(1);
  EXPECT_EQ(run(2), single);
  EXPECT_EQ(run(5), single);
}

TEST(FCCBoxSplineInterpolateImageFunction, InterpolatesAfterEnoughIterations)
{
  for (const RegionType & region : { middling, RegionType({ { 0, 1, 0 } }, { { 1, 2, 2 } }) })
  {
    const auto image = MakeNoise(region);
    double previous = 1.0;
    for (const unsigned int iterations : { 0u, 4u, 8u, 24u })
    {
      const auto interpolator = Interpolator::New();
      interpolator->SetNumberOfIterations(iterations);
      interpolator->SetInputImage(image);
      double worst = 0.0;
      for (itk::ImageRegionConstIteratorWithIndex<ImageType> it(image, region); !it.IsAtEnd(); ++it)
      {
        const auto point = image->TransformIndexToPhysicalPoint<double>(it.GetIndex());
        ASSERT_TRUE(interpolator->IsInsideBuffer(point));
        worst = std::max(worst, std::abs(interpolator->Evaluate(point) - static_cast<double>(it.Get())));
      }
      if (iterations == 24)
      {
        EXPECT_LT(worst, 1e-6);
      }
      else if (iterations > 0)
      {
        EXPECT_LT(worst, previous / 8.0) << "each iteration halves the difference at least";
      }
      previous = worst;
    }
  }
}

TEST(FCCBoxSplineInterpolateImageFunction, QuasiInterpolantReproducesQuadratics)
{
  const auto image = MakeImage(middling, Quadratic);
  const auto interpolator = Interpolator::New();
  interpolator->SetInputImage(image);
  ForEachInnerPoint(*image, [&](const PointType & p) {
    ASSERT_NEAR(interpolator->Evaluate(p), Quadratic(p), 2e-5);
    const auto gradient = interpolator->EvaluateDerivative(p);
    ASSERT_NEAR(gradient[0], 0.5 + 0.2 * p[0] + 0.07 * p[1], 5e-5);
    ASSERT_NEAR(gradient[1], -0.3 - 0.05 * p[2] + 0.07 * p[0], 5e-5);
    ASSERT_NEAR(gradient[2], 0.2 - 0.05 * p[1], 5e-5);
  });
}

// The order of approximation is three: halving the lattice's unit divides the error of a cubic by eight.
TEST(FCCBoxSplineInterpolateImageFunction, ErrorOfCubicsIsOfThirdOrder)
{
  const auto cubic = [](double scale) {
    return [scale](const PointType & p) {
      const double x = scale * p[0];
      const double y = scale * p[1];
      return x * x * x - 2.0 * x * y * y + x * y;
    };
  };
  const auto worstError = [&](double scale) {
    const auto field = cubic(scale);
    const auto image = MakeImage(middling, field);
    const auto interpolator = Interpolator::New();
    interpolator->SetInputImage(image);
    double worst = 0.0;
    ForEachInnerPoint(
      *image, [&](const PointType & p) { worst = std::max(worst, std::abs(interpolator->Evaluate(p) - field(p))); });
    return worst;
  };
  const double coarse = worstError(1.0);
  EXPECT_LT(coarse, 0.1);
  EXPECT_NEAR(worstError(0.5) / coarse, 1.0 / 8.0, 0.01);
}

TEST(FCCBoxSplineInterpolateImageFunction, GradientIsThatOfTheValueUpToTheExtent)
{
  const auto image = MakeNoise(middling);
  const auto interpolator = Interpolator::New();
  interpolator->SetInputImage(image);
  std::mt19937 random(9);
  for (int trial = 0; trial < 3000; ++trial)
  {
    std::uniform_real_distribution<double> x(1.5, 19.4);
    std::uniform_real_distribution<double> y(-2.5, 12.4);
    std::uniform_real_distribution<double> z(2.5, 16.4);
    const auto point = image->TransformLatticeToPhysicalPoint<double>({ x(random), y(random), z(random) });
    ASSERT_TRUE(interpolator->IsInsideBuffer(point));
    Interpolator::ContinuousIndexType index;
    image->TransformPhysicalPointToContinuousIndex(point, index);
    double value = 0.0;
    Interpolator::CovariantVectorType gradient;
    interpolator->EvaluateValueAndDerivativeAtContinuousIndex(index, value, gradient);
    ASSERT_EQ(value, interpolator->Evaluate(point));
    ASSERT_EQ(gradient, interpolator->EvaluateDerivativeAtContinuousIndex(index));
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      constexpr double step = 1e-5;
      PointType ahead = point;
      PointType behind = point;
      ahead[axis] += step;
      behind[axis] -= step;
      const double difference = interpolator->Evaluate(ahead) - interpolator->Evaluate(behind);
      ASSERT_NEAR(gradient[axis], difference / (2.0 * step), 2e-4);
    }
  }
  EXPECT_FALSE(interpolator->IsInsideBuffer(image->TransformLatticeToPhysicalPoint<double>({ 1.4, 0, 5 })));
}

TEST(FCCBoxSplineInterpolateImageFunction, WorksInsideResampleImageFilter)
{
  const auto image = MakeImage(middling, Quadratic);
  using Cartesian = itk::Image<float, 3>;
  const auto resample = itk::ResampleImageFilter<ImageType, Cartesian>::New();
  const Cartesian::PointType origin = image->TransformLatticeToPhysicalPoint<double>({ 8, 2, 7 });
  resample->SetInput(image);
  resample->SetInterpolator(Interpolator::New());
  resample->SetOutputOrigin(origin);
  resample->SetOutputSpacing(Cartesian::SpacingType(0.4));
  resample->SetSize({ { 5, 6, 7 } });
  resample->Update();
  const auto * const output = resample->GetOutput();
  for (itk::ImageRegionConstIteratorWithIndex<Cartesian> it(output, output->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    ASSERT_NEAR(it.Get(), Quadratic(output->TransformIndexToPhysicalPoint<double>(it.GetIndex())), 1e-4);
  }
}

TEST(FCCBoxSplineInterpolateImageFunction, TakesWholeNumbersAndRegionsThatAreBufferedOnly)
{
  using ShortImage = itk::FCCImage<std::int16_t>;
  const auto image = ShortImage::New();
  image->SetLargestPossibleRegion(RegionType({ { 0, 0, 0 } }, { { 50, 50, 50 } }));
  image->SetBufferedRegion(RegionType({ { 10, 11, 12 } }, { { 8, 8, 8 } }));
  image->Allocate();
  image->FillBuffer(-1024);
  image->SetPixel({ { 14, 15, 15 } }, 1024);
  const auto interpolator = itk::FCCBoxSplineInterpolateImageFunction<ShortImage>::New();
  interpolator->SetNumberOfIterations(25);
  interpolator->SetInputImage(image);
  const auto valueAt = [&](const itk::Index<3> & index) {
    return interpolator->Evaluate(image->TransformIndexToPhysicalPoint<double>(index));
  };
  EXPECT_NEAR(valueAt({ { 14, 15, 15 } }), 1024.0, 1e-2);
  EXPECT_NEAR(valueAt({ { 15, 15, 15 } }), -1024.0, 1e-2);
  EXPECT_NEAR(valueAt({ { 10, 11, 12 } }), -1024.0, 1e-2);
}

} // namespace
