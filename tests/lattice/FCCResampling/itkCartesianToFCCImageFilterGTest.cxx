#include "itkCartesianToFCCImageFilter.h"

#include "itkBSplineInterpolateImageFunction.h"
#include "itkCastImageFilter.h"
#include "itkCommand.h"
#include "itkFCCResamplingChecks.h"
#include "itkFCCToCartesianImageFilter.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkLinearInterpolateImageFunction.h"
#include "itkResampleImageFilter.h"
#include "itkStreamingImageFilter.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <set>

namespace
{

template <typename TPixel>
using Cartesian = itk::Image<TPixel, 3>;
template <typename TPixel>
using Filter = itk::CartesianToFCCImageFilter<Cartesian<TPixel>>;

using FloatImage = Cartesian<float>;
using FCCFloatImage = itk::FCCImage<float>;
using PointType = itk::Point<double, 3>;

FloatImage::DirectionType
ObliqueLeftHandedDirection()
{
  FloatImage::DirectionType direction;
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  const double rows[3][3] = { { c, 0, s }, { 0, -1, 0 }, { -s, 0, c } };
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      direction[row][axis] = rows[row][axis];
    }
  }
  return direction;
}

template <typename TPixel = float>
typename Cartesian<TPixel>::Pointer
MakeImage(const itk::Size<3> & size, const itk::Index<3> & start = { { 0, 0, 0 } })
{
  auto image = Cartesian<TPixel>::New();
  image->SetRegions(typename Cartesian<TPixel>::RegionType(start, size));
  image->Allocate(true);
  const double spacing[3] = { 0.7, 0.9, 2.0 };
  const double origin[3] = { -30.0, 12.0, 100.0 };
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(ObliqueLeftHandedDirection());
  return image;
}

template <typename TPixel>
void
FillWithNoise(Cartesian<TPixel> & image, double low, double high)
{
  std::mt19937 random(17);
  std::uniform_real_distribution<double> value(low, high);
  for (itk::ImageRegionIteratorWithIndex<Cartesian<TPixel>> it(&image, image.GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<TPixel>(value(random)));
  }
}

template <typename TImage>
std::size_t
Bytes(const TImage & image)
{
  return image.GetBufferedRegion().GetNumberOfPixels() * sizeof(typename TImage::PixelType);
}

TEST(CartesianToFCCImageFilter, PinsItsDefaults)
{
  const auto filter = Filter<float>::New();
  EXPECT_EQ(filter->GetDensity(), itk::FCCLattice::NyquistDensity);
  EXPECT_EQ(filter->GetOutputSpacing(), itk::Vector<double>(0.0));
  EXPECT_EQ(filter->GetKernel(), itk::SeparableKernel::CubicBSpline);
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("Kernel: CubicBSpline"), std::string::npos);
  filter->SetKernel(itk::SeparableKernel::Lanczos4);
  filter->Print(text);
  EXPECT_NE(text.str().find("Kernel: Lanczos4"), std::string::npos);
}

TEST(CartesianToFCCImageFilter, DefaultLatticeHasTheNyquistDensityAndTheInputsAspect)
{
  const auto image = MakeImage({ { 120, 110, 90 } });
  const auto filter = Filter<float>::New();
  filter->SetInput(image);
  filter->UpdateOutputInformation();
  const auto spacing = filter->GetOutput()->GetSpacing();
  EXPECT_NEAR(spacing[0] / 0.7, std::sqrt(3.0) / 2.0, 1e-12);
  EXPECT_NEAR(spacing[1] / spacing[0], 0.9 / 0.7, 1e-12);
  EXPECT_NEAR(spacing[2] / spacing[0], 2.0 / 0.7, 1e-12);
  const double ratio = static_cast<double>(filter->GetOutput()->GetLargestPossibleRegion().GetNumberOfPixels()) /
                       static_cast<double>(image->GetLargestPossibleRegion().GetNumberOfPixels());
  EXPECT_NEAR(ratio, itk::FCCLattice::NyquistDensity, 0.04) << "a little more at the borders";
}

TEST(CartesianToFCCImageFilter, ExtentCoversTheInputAndIsCentredOnIt)
{
  for (const itk::Size<3> size :
       { itk::Size<3>{ { 1, 1, 1 } }, itk::Size<3>{ { 7, 12, 3 } }, itk::Size<3>{ { 40, 1, 26 } } })
  {
    const auto image = MakeImage(size, { { 3, -2, 9 } });
    const auto filter = Filter<float>::New();
    filter->SetInput(image);
    filter->UpdateOutputInformation();
    const auto * const output = filter->GetOutput();
    const auto fccRegion = output->GetLargestPossibleRegion();
    std::array<double, 3> lowest{ 1e9, 1e9, 1e9 };
    std::array<double, 3> highest{ -1e9, -1e9, -1e9 };
    for (unsigned int corner = 0; corner < 8; ++corner)
    {
      itk::ContinuousIndex<double, 3> index;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const bool upper = (corner >> axis & 1) != 0;
        index[axis] = static_cast<double>(image->GetLargestPossibleRegion().GetIndex(axis)) +
                      (upper ? static_cast<double>(size[axis]) - 0.5 : -0.5);
      }
      const auto lattice =
        output->TransformPhysicalPointToLattice(image->TransformContinuousIndexToPhysicalPoint<double>(index));
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        lowest[axis] = std::min(lowest[axis], lattice[axis]);
        highest[axis] = std::max(highest[axis], lattice[axis]);
      }
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double length = (axis == 0 ? 2.0 : 1.0) * static_cast<double>(fccRegion.GetSize(axis));
      EXPECT_GE(lowest[axis], -0.5 - 1e-9);
      EXPECT_LE(highest[axis], length - 0.5 + 1e-9);
      EXPECT_NEAR(lowest[axis] + 0.5, length - 0.5 - highest[axis], 1e-9) << "centred";
    }
  }
}

TEST(CartesianToFCCImageFilter, ReproducesLinearFieldsOfTheWorldWithBothKernels)
{
  const auto image = MakeImage({ { 60, 58, 56 } }, { { -4, 5, 2 } });
  const auto field = [](const PointType & p) { return 10.0 + 0.5 * p[0] - 0.25 * p[1] + 0.125 * p[2]; };
  for (itk::ImageRegionIteratorWithIndex<FloatImage> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<float>(field(image->TransformIndexToPhysicalPoint<double>(it.GetIndex()))));
  }
  for (const auto kernel : { itk::SeparableKernel::Linear, itk::SeparableKernel::CubicBSpline })
  {
    const auto filter = Filter<float>::New();
    filter->SetInput(image);
    filter->SetKernel(kernel);
    filter->Update();
    const auto * const output = filter->GetOutput();
    // The spline's mirror images bend a slope at the ends; that dies out within a dozen samples.
    const double margin = kernel == itk::SeparableKernel::Linear ? 0.0 : 12.0;
    int checked = 0;
    for (itk::ImageRegionConstIteratorWithIndex<FCCFloatImage> it(output, output->GetBufferedRegion()); !it.IsAtEnd();
         ++it)
    {
      const auto point = output->TransformIndexToPhysicalPoint<double>(it.GetIndex());
      const auto index = image->TransformPhysicalPointToContinuousIndex<double>(point);
      bool inside = true;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const double first = static_cast<double>(image->GetBufferedRegion().GetIndex(axis)) + margin;
        const double last = static_cast<double>(image->GetBufferedRegion().GetUpperIndex()[axis]) - margin;
        inside = inside && index[axis] >= first && index[axis] <= last;
      }
      if (inside)
      {
        ++checked;
        ASSERT_NEAR(it.Get(), field(point), 2e-4) << it.GetIndex();
      }
    }
    EXPECT_GT(checked, 10000);
  }
}

TEST(CartesianToFCCImageFilter, AgreesWithITKsResamplerOnTheSameLattice)
{
  const auto image = MakeImage({ { 37, 29, 31 } });
  FillWithNoise(*image, -1000.0, 3000.0);
  for (const auto kernel : { itk::SeparableKernel::Linear, itk::SeparableKernel::CubicBSpline })
  {
    const auto filter = Filter<float>::New();
    filter->SetInput(image);
    filter->SetKernel(kernel);
    filter->Update();
    const auto * const output = filter->GetOutput();

    const auto reference = itk::ResampleImageFilter<FloatImage, FCCFloatImage>::New();
    reference->SetInput(image);
    reference->SetOutputParametersFromImage(output);
    if (kernel == itk::SeparableKernel::Linear)
    {
      reference->SetInterpolator(itk::LinearInterpolateImageFunction<FloatImage>::New());
    }
    else
    {
      reference->SetInterpolator(itk::BSplineInterpolateImageFunction<FloatImage>::New());
    }
    reference->Update();

    // The filter's ten taps stand for a spline that reaches all samples. White noise, half of whose energy lies in
    // the corners of the spectrum, is the worst case; its standard deviation is 1155, the difference's 3.4.
    const bool isLinear = kernel == itk::SeparableKernel::Linear;
    const double tolerance = isLinear ? 0.02 : 20.0;
    double squares = 0.0;
    int checked = 0;
    for (itk::ImageRegionConstIteratorWithIndex<FCCFloatImage> it(output, output->GetBufferedRegion()); !it.IsAtEnd();
         ++it)
    {
      const auto point = output->TransformIndexToPhysicalPoint<double>(it.GetIndex());
      const auto index = image->TransformPhysicalPointToContinuousIndex<double>(point);
      bool inside = true; // beyond the outermost samples the two extend the field differently
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        inside = inside && index[axis] >= 0.0 &&
                 index[axis] <= static_cast<double>(image->GetBufferedRegion().GetSize(axis) - 1);
      }
      if (inside)
      {
        ++checked;
        const double difference = it.Get() - reference->GetOutput()->GetPixel(it.GetIndex());
        squares += difference * difference;
        ASSERT_LT(std::abs(difference), tolerance) << it.GetIndex();
      }
    }
    EXPECT_GT(checked, 20000);
    EXPECT_LT(std::sqrt(squares / checked), isLinear ? 0.01 : 4.0);
  }
}

template <typename TPixel>
class CartesianToFCCPixelTypes : public testing::Test
{};

using PixelTypes = testing::Types<std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, float>;
TYPED_TEST_SUITE(CartesianToFCCPixelTypes, PixelTypes);

TYPED_TEST(CartesianToFCCPixelTypes, KeepsConstants)
{
  const auto image = MakeImage<TypeParam>({ { 9, 8, 7 } });
  image->FillBuffer(static_cast<TypeParam>(117));
  const auto filter = Filter<TypeParam>::New();
  filter->SetInput(image);
  filter->Update();
  const auto * const output = filter->GetOutput();
  for (std::size_t n = 0; n < output->GetBufferedRegion().GetNumberOfPixels(); ++n)
  {
    ASSERT_NEAR(output->GetBufferPointer()[n], 117, 1e-4);
  }
}

TYPED_TEST(CartesianToFCCPixelTypes, ClampsOvershootToTheTypesRange)
{
  const auto image = MakeImage<TypeParam>({ { 24, 24, 24 } });
  using Limits = std::numeric_limits<TypeParam>;
  const bool isFloat = std::is_same<TypeParam, float>::value;
  const auto low = isFloat ? TypeParam(-1000) : Limits::lowest();
  const auto high = isFloat ? TypeParam(1000) : Limits::max();
  for (itk::ImageRegionIteratorWithIndex<Cartesian<TypeParam>> it(image, image->GetBufferedRegion()); !it.IsAtEnd();
       ++it)
  {
    it.Set(it.GetIndex()[0] < 12 ? low : high);
  }
  const auto filter = Filter<TypeParam>::New();
  filter->SetInput(image);
  filter->Update();
  const auto * const output = filter->GetOutput();
  bool overshoots = false;
  for (itk::ImageRegionConstIteratorWithIndex<itk::FCCImage<TypeParam>> it(output, output->GetBufferedRegion());
       !it.IsAtEnd();
       ++it)
  {
    const auto x = image->template TransformPhysicalPointToContinuousIndex<double>(
      output->template TransformIndexToPhysicalPoint<double>(it.GetIndex()))[0];
    const double middle = 0.5 * (static_cast<double>(low) + static_cast<double>(high));
    ASSERT_TRUE(x < 11.4 ? it.Get() < middle : x < 11.6 || it.Get() > middle) << "an overshoot wrapped around";
    overshoots = overshoots || it.Get() > high;
  }
  EXPECT_EQ(overshoots, isFloat);
}

TEST(CartesianToFCCImageFilter, GivesTheSameBytesForAnyNumberOfThreads)
{
  const auto image = MakeImage<std::int16_t>({ { 33, 41, 19 } });
  FillWithNoise(*image, -1000, 1000);
  const auto single = Filter<std::int16_t>::New();
  single->SetInput(image);
  single->SetNumberOfWorkUnits(1);
  single->Update();
  for (const unsigned int units : { 2u, 3u, 4u, 5u, 64u })
  {
    const auto many = Filter<std::int16_t>::New();
    many->SetInput(image);
    many->SetNumberOfWorkUnits(units);
    many->Update();
    ASSERT_EQ(std::memcmp(single->GetOutput()->GetBufferPointer(),
                          many->GetOutput()->GetBufferPointer(),
                          Bytes(*single->GetOutput())),
              0);
  }
}

TEST(CartesianToFCCImageFilter, AnyRequestedRegionIsTheCropOfTheWholeAndNeedsOnlyItsSurroundings)
{
  const auto image = MakeImage({ { 50, 60, 70 } }, { { 5, -3, 0 } });
  FillWithNoise(*image, -100, 100);
  const auto whole = Filter<float>::New();
  whole->SetInput(image);
  whole->Update();
  const auto all = whole->GetOutput()->GetLargestPossibleRegion();
  std::mt19937 random(23);
  for (int trial = 0; trial < 20; ++trial)
  {
    FCCFloatImage::RegionType region;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto begin = random() % all.GetSize(axis);
      region.SetIndex(axis, static_cast<itk::IndexValueType>(begin));
      region.SetSize(axis, 1 + random() % (all.GetSize(axis) - begin));
    }
    for (const auto kernel : { itk::SeparableKernel::Linear, itk::SeparableKernel::CubicBSpline })
    {
      whole->SetKernel(kernel);
      whole->Update();
      const auto part = Filter<float>::New();
      part->SetInput(image);
      part->SetKernel(kernel);
      part->GetOutput()->SetRequestedRegion(region);
      part->Update();
      for (itk::ImageRegionConstIteratorWithIndex<FCCFloatImage> it(part->GetOutput(), region); !it.IsAtEnd(); ++it)
      {
        ASSERT_EQ(it.Get(), whole->GetOutput()->GetPixel(it.GetIndex()));
      }
      const double reach = kernel == itk::SeparableKernel::Linear ? 3.0 : 12.0;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const double step = (axis == 0 ? 2.0 : 1.0) * part->GetOutput()->GetSpacing()[axis] / image->GetSpacing()[axis];
        EXPECT_LE(static_cast<double>(image->GetRequestedRegion().GetSize(axis)),
                  step * static_cast<double>(region.GetSize(axis)) + reach);
      }
    }
  }
}

TYPED_TEST(CartesianToFCCPixelTypes, IsTheSumOfTheTapsForAnySizeStartRegionAndThreads)
{
  std::mt19937 random(41);
  for (int trial = 0; trial < 60; ++trial)
  {
    itk::Size<3> size;
    itk::Index<3> start;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      size[axis] = trial % 3 == static_cast<int>(axis) ? 1 : 1 + random() % 24;
      start[axis] = static_cast<itk::IndexValueType>(random() % 9) - 4;
    }
    const auto image = MakeImage<TypeParam>(size, start);
    FillWithNoise(*image, 0.0, 250.0);
    const itk::SeparableKernel kernels[] = { itk::SeparableKernel::Linear,
                                             itk::SeparableKernel::CubicBSpline,
                                             itk::SeparableKernel::Lanczos4 };
    const auto kernel = kernels[random() % 3];
    const double density = trial % 2 == 0 ? itk::FCCLattice::NyquistDensity : 0.02 + 0.001 * (random() % 2000);
    const auto whole = Filter<TypeParam>::New();
    whole->SetInput(image);
    whole->SetKernel(kernel);
    whole->SetDensity(density);
    whole->SetNumberOfWorkUnits(1);
    whole->Update();
    const auto * const output = whole->GetOutput();

    const auto all = output->GetLargestPossibleRegion();
    auto region = all;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto begin = random() % all.GetSize(axis);
      region.SetIndex(axis, static_cast<itk::IndexValueType>(begin));
      region.SetSize(axis, 1 + random() % (all.GetSize(axis) - begin));
    }
    const auto part = Filter<TypeParam>::New();
    part->SetInput(image);
    part->SetKernel(kernel);
    part->SetDensity(density);
    part->SetNumberOfWorkUnits(1 + static_cast<unsigned int>(trial) % 5);
    part->GetOutput()->SetRequestedRegion(region);
    part->Update();
    for (itk::ImageRegionConstIteratorWithIndex<itk::FCCImage<TypeParam>> it(part->GetOutput(), region); !it.IsAtEnd();
         ++it)
    {
      ASSERT_EQ(it.Get(), output->GetPixel(it.GetIndex())) << size << start << region;
      if (random() % 16 != 0)
      {
        continue;
      }
      const auto x = image->template TransformPhysicalPointToContinuousIndex<double>(
        output->template TransformIndexToPhysicalPoint<double>(it.GetIndex()));
      std::vector<itk::SeparableTaps> taps;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        taps.emplace_back(kernel, size[axis], std::vector<double>{ x[axis] - static_cast<double>(start[axis]) });
      }
      double sum = 0.0;
      itk::Index<3> tap;
      for (tap[2] = 0; tap[2] < static_cast<itk::IndexValueType>(taps[2].GetNumberOfTaps()); ++tap[2])
      {
        for (tap[1] = 0; tap[1] < static_cast<itk::IndexValueType>(taps[1].GetNumberOfTaps()); ++tap[1])
        {
          for (tap[0] = 0; tap[0] < static_cast<itk::IndexValueType>(taps[0].GetNumberOfTaps()); ++tap[0])
          {
            double weight = 1.0;
            auto index = start;
            for (unsigned int axis = 0; axis < 3; ++axis)
            {
              weight *= taps[axis].GetWeights(0)[tap[axis]];
              index[axis] += static_cast<itk::IndexValueType>(taps[axis].GetFirst(0)) + tap[axis];
            }
            sum += weight * static_cast<double>(image->GetPixel(index));
          }
        }
      }
      const bool isFloat = std::is_same<TypeParam, float>::value;
      const double clamped = isFloat ? sum
                                     : std::clamp(sum,
                                                  static_cast<double>(std::numeric_limits<TypeParam>::lowest()),
                                                  static_cast<double>(std::numeric_limits<TypeParam>::max()));
      ASSERT_NEAR(it.Get(), clamped, isFloat ? 2e-3 : 0.502) << size << start << it.GetIndex();
    }
  }
}

TEST(CartesianToFCCImageFilter, HonoursAnExplicitSpacing)
{
  const auto image = MakeImage({ { 30, 30, 30 } });
  const auto filter = Filter<float>::New();
  filter->SetInput(image);
  filter->SetOutputSpacing(itk::Vector<double>(1.5));
  filter->UpdateOutputInformation();
  EXPECT_EQ(filter->GetOutput()->GetSpacing(), itk::Vector<double>(1.5));
  EXPECT_EQ(filter->GetOutput()->GetLargestPossibleRegion().GetSize(2), 40u) << "60 mm in steps of 1.5 mm";
}

TEST(CartesianToFCCImageFilter, RefusesNonsense)
{
  const auto image = MakeImage({ { 3, 3, 3 } });
  const auto filter = Filter<float>::New();
  filter->SetInput(image);
  for (const double density :
       { 0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    filter->SetDensity(density);
    EXPECT_THROW(filter->Update(), itk::ExceptionObject);
  }
  filter->SetDensity(1.0);
  const double flat[3] = { 1.0, 0.0, 1.0 };
  filter->SetOutputSpacing(flat);
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
  filter->SetOutputSpacing(itk::Vector<double>(1e-12));
  EXPECT_THROW(filter->Update(), itk::ExceptionObject) << "more samples than can be counted";
  EXPECT_THROW(Filter<float>::New()->Update(), itk::ExceptionObject) << "no input";
}

TEST(CartesianToFCCImageFilter, ReportsProgressAndStopsOnAbort)
{
  const auto image = MakeImage({ { 64, 64, 64 } });
  const auto filter = Filter<float>::New();
  filter->SetInput(image);
  float last = 0.0f;
  std::set<float> reported;
  bool monotonic = true;
  filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    monotonic = monotonic && filter->GetProgress() >= last;
    last = filter->GetProgress();
    reported.insert(last);
  });
  filter->Update();
  EXPECT_TRUE(monotonic);
  EXPECT_NEAR(last, 1.0f, 1e-3f);
  EXPECT_GT(reported.size(), 5u);

  const auto aborting = Filter<float>::New();
  aborting->SetInput(image);
  aborting->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) { aborting->AbortGenerateDataOn(); });
  EXPECT_THROW(aborting->Update(), itk::ProcessAborted);
}

TEST(FCCToCartesianImageFilter, BringsALinearFieldBackOntoTheReferenceGrid)
{
  const auto image = MakeImage({ { 40, 40, 40 } });
  for (itk::ImageRegionIteratorWithIndex<FloatImage> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto p = image->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    it.Set(static_cast<float>(p[0] + 2 * p[1] - p[2]));
  }
  const auto there = Filter<float>::New();
  there->SetInput(image);
  there->SetKernel(itk::SeparableKernel::Linear);
  const auto back = itk::FCCToCartesianImageFilter<FCCFloatImage>::New();
  back->SetInput(there->GetOutput());
  back->SetReferenceImage(image);
  back->Update();
  ASSERT_EQ(back->GetOutput()->GetLargestPossibleRegion(), image->GetLargestPossibleRegion());
  for (itk::ImageRegionConstIteratorWithIndex<FloatImage> it(
         image, FloatImage::RegionType({ { 2, 2, 2 } }, { { 36, 36, 36 } }));
       !it.IsAtEnd();
       ++it)
  {
    ASSERT_NEAR(back->GetOutput()->GetPixel(it.GetIndex()), it.Get(), 1e-3);
  }
}

TEST(FCCToCartesianImageFilter, DefaultGridHasTheOriginalSpacingAndDirection)
{
  const auto image = MakeImage<std::int16_t>({ { 40, 30, 20 } });
  image->FillBuffer(-1000);
  const auto there = Filter<std::int16_t>::New();
  there->SetInput(image);
  const auto back = itk::FCCToCartesianImageFilter<itk::FCCImage<std::int16_t>>::New();
  back->SetInput(there->GetOutput());
  back->SetNumberOfWorkUnits(3);
  back->Update();
  const auto * const output = back->GetOutput();
  EXPECT_EQ(output->GetDirection(), image->GetDirection());
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(output->GetSpacing()[axis], image->GetSpacing()[axis], 1e-9);
    EXPECT_NEAR(static_cast<double>(output->GetBufferedRegion().GetSize(axis)),
                static_cast<double>(image->GetBufferedRegion().GetSize(axis)),
                2.0);
  }
  for (std::size_t n = 0; n < output->GetBufferedRegion().GetNumberOfPixels(); ++n)
  {
    ASSERT_EQ(output->GetBufferPointer()[n], -1000);
  }
}

TEST(CartesianToFCCImageFilter, RoundsExactly)
{
  for (const std::int32_t value : { 8388609, -8388609, 117, 0, -1 })
  {
    const auto image = MakeImage<std::int32_t>({ { 5, 5, 5 } });
    image->FillBuffer(value);
    const auto filter = Filter<std::int32_t>::New();
    filter->SetInput(image);
    filter->SetKernel(itk::SeparableKernel::Linear);
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetPixel({ { 1, 2, 2 } }), value);
  }
  EXPECT_EQ(itk::RoundAndClamp<std::uint8_t>(254.5f), 255);
  EXPECT_EQ(itk::RoundAndClamp<std::uint8_t>(300.7), 255);
  EXPECT_EQ(itk::RoundAndClamp<std::uint8_t>(-3.0f), 0);
  EXPECT_EQ(itk::RoundAndClamp<std::int16_t>(-2.5f), -3);
  EXPECT_EQ(itk::RoundAndClamp<std::int32_t>(2147483647.0), 2147483647);
  EXPECT_EQ(itk::RoundAndClamp<std::int32_t>(1e20f), 2147483647);
  EXPECT_EQ(itk::RoundAndClamp<std::int32_t>(-1e20), -2147483647 - 1);
  EXPECT_EQ(itk::RoundAndClamp<std::int16_t>(std::numeric_limits<float>::quiet_NaN()), -32768);
}

TEST(CartesianToFCCImageFilter, ReproducesQuadraticsInAllDirections)
{
  const auto image = MakeImage({ { 44, 44, 44 } });
  const auto field = [](const auto & i) {
    return 0.5 * i[0] * i[1] - 0.25 * i[2] * i[2] + 0.1 * i[0] * i[2] - 3.0 * i[1];
  };
  for (itk::ImageRegionIteratorWithIndex<FloatImage> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<float>(field(it.GetIndex())));
  }
  const auto filter = Filter<float>::New();
  filter->SetInput(image);
  filter->Update();
  const auto * const output = filter->GetOutput();
  int checked = 0;
  for (itk::ImageRegionConstIteratorWithIndex<FCCFloatImage> it(output, output->GetBufferedRegion()); !it.IsAtEnd();
       ++it)
  {
    const auto point = output->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    const auto index = image->TransformPhysicalPointToContinuousIndex<double>(point);
    if (std::min({ index[0], index[1], index[2] }) > 14.0 && std::max({ index[0], index[1], index[2] }) < 29.0)
    {
      ++checked;
      ASSERT_NEAR(it.Get(), field(index), 5e-3) << "of values up to 400";
    }
  }
  EXPECT_GT(checked, 1000);
}

TEST(CartesianToFCCImageFilter, StreamsAndFeedsPixelwiseFilters)
{
  const auto image = MakeImage<std::int16_t>({ { 30, 31, 32 } });
  FillWithNoise(*image, -1000, 1000);
  using LatticeType = itk::FCCImage<std::int16_t>;
  const auto filter = Filter<std::int16_t>::New();
  filter->SetInput(image);
  filter->Update();
  const auto streamed = Filter<std::int16_t>::New();
  streamed->SetInput(image);
  const auto streaming = itk::StreamingImageFilter<LatticeType, LatticeType>::New();
  streaming->SetInput(streamed->GetOutput());
  streaming->SetNumberOfStreamDivisions(5);
  const auto cast = itk::CastImageFilter<LatticeType, FCCFloatImage>::New();
  cast->SetInput(streaming->GetOutput());
  cast->Update();
  EXPECT_EQ(cast->GetOutput()->GetOrigin(), filter->GetOutput()->GetOrigin());
  EXPECT_EQ(cast->GetOutput()->GetSpacing(), filter->GetOutput()->GetSpacing());
  for (std::size_t n = 0; n < filter->GetOutput()->GetBufferedRegion().GetNumberOfPixels(); ++n)
  {
    ASSERT_EQ(cast->GetOutput()->GetBufferPointer()[n], filter->GetOutput()->GetBufferPointer()[n]);
  }
}

TEST(FCCToCartesianImageFilter, FollowsAChangedReferenceAndRefusesNonsense)
{
  const auto image = MakeImage({ { 10, 10, 10 } });
  image->FillBuffer(5.0f);
  const auto there = Filter<float>::New();
  there->SetInput(image);
  const auto reference = MakeImage({ { 4, 5, 6 } });
  const auto back = itk::FCCToCartesianImageFilter<FCCFloatImage>::New();
  back->SetInput(there->GetOutput());
  back->SetReferenceImage(reference);
  back->Update();
  EXPECT_EQ(back->GetOutput()->GetLargestPossibleRegion(), reference->GetLargestPossibleRegion());
  reference->SetSpacing(itk::Vector<double>(0.25));
  back->Update();
  EXPECT_EQ(back->GetOutput()->GetSpacing(), itk::Vector<double>(0.25));

  for (const double spacing :
       { std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(), -1.0, 1e-13 })
  {
    const auto refusing = itk::FCCToCartesianImageFilter<FCCFloatImage>::New();
    refusing->SetInput(there->GetOutput());
    refusing->SetOutputSpacing(itk::Vector<double>(spacing));
    EXPECT_THROW(refusing->Update(), itk::ExceptionObject) << spacing;
  }
}

TEST(FCCToCartesianImageFilter, GivesTheSameBytesForAnyThreadsAndRegion)
{
  const auto image = MakeImage({ { 20, 21, 22 } });
  FillWithNoise(*image, -100, 100);
  const auto there = Filter<float>::New();
  there->SetInput(image);
  const auto whole = itk::FCCToCartesianImageFilter<FCCFloatImage>::New();
  whole->SetInput(there->GetOutput());
  whole->SetNumberOfWorkUnits(1);
  whole->Update();
  const auto part = itk::FCCToCartesianImageFilter<FCCFloatImage>::New();
  part->SetInput(there->GetOutput());
  part->SetNumberOfWorkUnits(7);
  part->UpdateOutputInformation();
  FloatImage::RegionType region({ { 3, 2, 5 } }, { { 11, 9, 10 } });
  part->GetOutput()->SetRequestedRegion(region);
  part->Update();
  for (itk::ImageRegionConstIteratorWithIndex<FloatImage> it(part->GetOutput(), region); !it.IsAtEnd(); ++it)
  {
    ASSERT_EQ(it.Get(), whole->GetOutput()->GetPixel(it.GetIndex()));
  }
}

TEST(FCCToCartesianImageFilter, FillsOutsideWithTheDefaultPixelValue)
{
  const auto image = MakeImage({ { 10, 10, 10 } });
  image->FillBuffer(5.0f);
  const auto there = Filter<float>::New();
  there->SetInput(image);
  const auto reference = MakeImage({ { 10, 10, 10 } });
  const double far[3] = { 1000.0, 0.0, 0.0 };
  reference->SetOrigin(far);
  const auto back = itk::FCCToCartesianImageFilter<FCCFloatImage>::New();
  back->SetInput(there->GetOutput());
  back->SetReferenceImage(reference);
  back->SetDefaultPixelValue(-7.0f);
  back->Update();
  EXPECT_EQ(back->GetOutput()->GetPixel({ { 5, 5, 5 } }), -7.0f);
}

} // namespace
