#include "itkFCCGaussianImageFilter.h"

#include "detail/itkFCCMirror.h"
#include "itkCommand.h"
#include "itkFCCTestImages.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <set>

namespace
{

using ImageType = fcctest::ImageType;
using PointType = fcctest::PointType;
template <typename TPixel>
using FilterOf = itk::FCCGaussianImageFilter<itk::FCCImage<TPixel>>;
using Filter = FilterOf<float>;
using SpacingType = ImageType::SpacingType;

template <typename TImage>
typename TImage::Pointer
Smooth(const TImage * image, double sigma, unsigned int threads = 2)
{
  const auto filter = itk::FCCGaussianImageFilter<TImage>::New();
  filter->SetInput(image);
  filter->SetSigma(sigma);
  filter->SetNumberOfWorkUnits(threads);
  filter->Update();
  typename TImage::Pointer output = filter->GetOutput();
  output->DisconnectPipeline();
  return output;
}

template <typename TPixel>
typename itk::FCCImage<TPixel>::Pointer
MakeImage(const ImageType::RegionType & region, const SpacingType & spacing)
{
  auto image = itk::FCCImage<TPixel>::New();
  image->SetRegions(region);
  image->SetSpacing(spacing);
  image->Allocate(true);
  return image;
}

SpacingType
MakeSpacing(double x, double y, double z)
{
  SpacingType spacing;
  spacing[0] = x;
  spacing[1] = y;
  spacing[2] = z;
  return spacing;
}

template <typename TPixel>
void
FillWithNoise(itk::FCCImage<TPixel> & image, double low, double high, unsigned int seed = 17)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(low, high);
  for (itk::ImageRegionIteratorWithIndex<itk::FCCImage<TPixel>> it(&image, image.GetBufferedRegion()); !it.IsAtEnd();
       ++it)
  {
    it.Set(static_cast<TPixel>(value(random)));
  }
}

template <typename TImage>
bool
AreSame(const TImage & one, const TImage & other)
{
  return one.GetBufferedRegion() == other.GetBufferedRegion() &&
         std::memcmp(one.GetBufferPointer(),
                     other.GetBufferPointer(),
                     one.GetBufferedRegion().GetNumberOfPixels() * sizeof(typename TImage::PixelType)) == 0;
}

/** The sum over all taps of one site, in double, each looked up for itself. */
double
SumOfTaps(const ImageType & image, const itk::Index<3> & index, const itk::FCCGaussianTaps & taps)
{
  double sum = 0.0;
  for (unsigned int odd = 0; odd < 4; ++odd)
  {
    const auto & x = taps.GetFactor(0, odd & 1);
    const auto & y = taps.GetFactor(1, odd >> 1);
    const auto & z = taps.GetFactor(2, (odd ^ odd >> 1) & 1);
    for (std::size_t c = 0; c < z.steps.size(); ++c)
    {
      for (std::size_t b = 0; b < y.steps.size(); ++b)
      {
        for (std::size_t a = 0; a < x.steps.size(); ++a)
        {
          auto site = itk::FCCLattice::SiteOf(index);
          site[0] += x.steps[a];
          site[1] += y.steps[b];
          site[2] += z.steps[c];
          const auto source = itk::MirrorIntoRegion(itk::FCCLattice::IndexOf(site), image.GetLargestPossibleRegion());
          sum += static_cast<double>(x.weights[a]) * static_cast<double>(y.weights[b]) *
                 static_cast<double>(z.weights[c]) * static_cast<double>(image.GetPixel(source));
        }
      }
    }
  }
  return sum;
}

itk::FCCGaussianTaps
TapsFor(const SpacingType & spacing, double sigma)
{
  return itk::FCCGaussianTaps({ sigma * sigma / (spacing[0] * spacing[0]),
                                sigma * sigma / (spacing[1] * spacing[1]),
                                sigma * sigma / (spacing[2] * spacing[2]) });
}

TEST(FCCGaussianImageFilter, PinsItsDefaults)
{
  const auto filter = Filter::New();
  EXPECT_EQ(filter->GetSigma(), 0.0);
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("Sigma: 0"), std::string::npos);
}

TEST(FCCGaussianImageFilter, IsTheSumOfTheTapsForAnySizeStartAndSpacing)
{
  std::mt19937 random(5);
  for (unsigned int trial = 0; trial < 60; ++trial)
  {
    const auto number = [&random](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    const auto size = [&](int lowest) { return static_cast<itk::SizeValueType>(number(lowest, 9)); };
    const ImageType::RegionType region({ { number(-3, 3), number(-3, 3), number(-3, 3) } },
                                       { { size(1), size(2), size(2) } });
    const auto spacing = MakeSpacing(0.1 * number(4, 15), 0.1 * number(4, 15), 0.1 * number(4, 40));
    const double sigma = 0.1 * number(1, 20);
    const auto image = MakeImage<float>(region, spacing);
    FillWithNoise(*image, -100.0, 100.0, trial);
    const auto smooth = Smooth(image.GetPointer(), sigma);
    const auto taps = TapsFor(spacing, sigma);
    for (itk::ImageRegionIteratorWithIndex<ImageType> it(smooth, region); !it.IsAtEnd(); ++it)
    {
      ASSERT_NEAR(it.Get(), SumOfTaps(*image, it.GetIndex(), taps), 1e-3) << it.GetIndex() << " of " << region;
    }
  }
}

TEST(FCCGaussianImageFilter, ImpulseResponseIsTheGaussianInMillimetres)
{
  // Slices are farther apart than rows and columns; both are close enough for a Gaussian of 1.2 mm.
  const auto spacing = MakeSpacing(0.6, 0.7, 1.0);
  const auto image = MakeImage<float>({ { { -12, -22, -16 } }, { { 25, 45, 33 } } }, spacing);
  image->SetPixel({ { 0, 0, 0 } }, 1.0f);
  constexpr double sigma = 1.2;
  const auto smooth = Smooth(image.GetPointer(), sigma);
  const double volumePerSite = 2.0 * spacing[0] * spacing[1] * spacing[2];
  const double peak = volumePerSite / std::pow(2.0 * itk::Math::pi * sigma * sigma, 1.5);
  double sum = 0.0;
  std::array<double, 6> moments{};
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(smooth, smooth->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto p = smooth->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    const auto value = static_cast<double>(it.Get());
    const double distance = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    EXPECT_NEAR(value, peak * std::exp(-0.5 * distance / (sigma * sigma)), 2e-3 * peak);
    sum += value;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      moments[axis] += value * p[axis] * p[axis];
      moments[3 + axis] += value * p[axis] * p[(axis + 1) % 3];
    }
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(moments[axis], sigma * sigma, 1e-5);
    EXPECT_NEAR(moments[3 + axis], 0.0, 1e-6);
  }
}

TEST(FCCGaussianImageFilter, SecondMomentsAreExactForThickSlicesAndSmallSigmas)
{
  for (const auto & spacing : { MakeSpacing(0.7, 0.7, 4.3), MakeSpacing(1.0, 1.0, 1.0), MakeSpacing(1.0, 1.0, 0.3) })
  {
    for (const double sigma : { 0.2, 0.5, 1.0 })
    {
      const auto image = MakeImage<float>({ { { -8, -12, -16 } }, { { 17, 25, 33 } } }, spacing);
      image->SetPixel({ { 0, 0, 0 } }, 1.0f);
      const auto smooth = Smooth(image.GetPointer(), sigma);
      std::array<double, 3> moments{};
      for (itk::ImageRegionIteratorWithIndex<ImageType> it(smooth, smooth->GetBufferedRegion()); !it.IsAtEnd(); ++it)
      {
        const auto p = smooth->TransformIndexToPhysicalPoint<double>(it.GetIndex());
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          moments[axis] += static_cast<double>(it.Get()) * p[axis] * p[axis];
        }
      }
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        EXPECT_NEAR(moments[axis], sigma * sigma, 1e-5 * sigma * sigma) << spacing << ", sigma " << sigma;
      }
    }
  }
}

TEST(FCCGaussianImageFilter, LeavesLinearFieldsAndAddsSigmaSquaredToSquares)
{
  constexpr double sigma = 1.1;
  const auto linear = [](const PointType & p) { return 3.0 * p[0] - 2.0 * p[1] + 0.5 * p[2] + 7.0; };
  const auto square = [](const PointType & p) { return p[0] * p[0] + 2.0 * p[1] * p[1] - p[2] * p[2]; };
  const auto linearImage = fcctest::MakeImage(0.8, 12.0, linear);
  const auto squareImage = fcctest::MakeImage(0.8, 12.0, square);
  const auto smoothLinear = Smooth(linearImage.GetPointer(), sigma);
  const auto smoothSquare = Smooth(squareImage.GetPointer(), sigma);
  std::size_t inside = 0;
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(smoothLinear, smoothLinear->GetBufferedRegion()); !it.IsAtEnd();
       ++it)
  {
    const auto p = smoothLinear->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    if (std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) }) < 12.0 - 4.5 * sigma - 0.8)
    {
      EXPECT_NEAR(it.Get(), linear(p), 2e-5);
      EXPECT_NEAR(smoothSquare->GetPixel(it.GetIndex()), square(p) + (1.0 + 2.0 - 1.0) * sigma * sigma, 1e-3);
      ++inside;
    }
  }
  EXPECT_GT(inside, 500u);
}

template <typename TPixel>
class FCCGaussianPixelTypes : public testing::Test
{};
using PixelTypes = testing::Types<std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, float>;
TYPED_TEST_SUITE(FCCGaussianPixelTypes, PixelTypes);

TYPED_TEST(FCCGaussianPixelTypes, KeepsConstantsAndWithSigmaZeroEverything)
{
  using Limits = std::numeric_limits<TypeParam>;
  const double bound = sizeof(TypeParam) == 4 ? 50000.0 : static_cast<double>(Limits::max());
  const double lowest = Limits::is_signed ? -bound : 0.0;
  const ImageType::RegionType region({ { 0, 0, 0 } }, { { 20, 17, 12 } });
  const auto image = MakeImage<TypeParam>(region, MakeSpacing(0.7, 0.7, 2.0));
  for (const double value : { lowest, 0.0, 1.0, 77.0, std::floor(bound / 3.0), bound })
  {
    image->FillBuffer(static_cast<TypeParam>(value));
    const auto smooth = Smooth(image.GetPointer(), 1.5);
    if (std::is_integral<TypeParam>::value)
    {
      EXPECT_TRUE(AreSame(*smooth, *image)) << value;
    }
    for (itk::SizeValueType n = 0; n < region.GetNumberOfPixels(); ++n)
    {
      ASSERT_NEAR(static_cast<double>(smooth->GetBufferPointer()[n]), value, 1e-6 * std::abs(value));
    }
  }
  FillWithNoise(*image, lowest, bound);
  image->GetBufferPointer()[0] = Limits::max(); // which float can't hold for the widest integers
  EXPECT_TRUE(AreSame(*Smooth(image.GetPointer(), 0.0), *image));
}

TEST(FCCGaussianImageFilter, RoundsWithoutBias)
{
  const ImageType::RegionType region({ { 0, 0, 0 } }, { { 40, 60, 50 } });
  const auto spacing = MakeSpacing(0.6, 0.6, 0.6);
  const auto whole = MakeImage<std::int16_t>(region, spacing);
  FillWithNoise(*whole, -1024.0, 3071.0);
  const auto filter = itk::FCCGaussianImageFilter<itk::FCCImage<std::int16_t>, ImageType>::New();
  filter->SetInput(whole);
  filter->SetSigma(1.0);
  filter->Update();
  const auto rounded = Smooth(whole.GetPointer(), 1.0);
  double bias = 0.0;
  const auto count = region.GetNumberOfPixels();
  for (itk::SizeValueType n = 0; n < count; ++n)
  {
    const double difference = static_cast<double>(rounded->GetBufferPointer()[n]) -
                              static_cast<double>(filter->GetOutput()->GetBufferPointer()[n]);
    ASSERT_LE(std::abs(difference), 0.5);
    bias += difference / static_cast<double>(count);
  }
  const double standardError = std::sqrt(1.0 / 12.0 / static_cast<double>(count));
  EXPECT_LT(std::abs(bias), 4.0 * standardError);
}

TEST(FCCGaussianImageFilter, CommutesWithTheLatticesSymmetries)
{
  // Reflections and permutations of the lattice coordinates about the middle site.
  const auto image = fcctest::MakeImage(0.9, 7.0, [](const PointType &) { return 0.0; });
  FillWithNoise(*image, -1000.0, 1000.0);
  const auto region = image->GetBufferedRegion();
  const auto smooth = Smooth(image.GetPointer(), 1.0);
  constexpr unsigned int axes[6][3] = { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 2, 1, 0 } };
  for (unsigned int symmetry = 0; symmetry < 48; ++symmetry)
  {
    const auto turn = [&](const itk::Index<3> & index) {
      const auto site = itk::FCCLattice::SiteOf(index);
      itk::FCCLattice::SiteType turned;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        turned[axis] = (symmetry >> axis & 1 ? -1 : 1) * site[axes[symmetry / 8][axis]];
      }
      return itk::FCCLattice::IndexOf(turned);
    };
    const auto turned = MakeImage<float>(region, image->GetSpacing());
    for (itk::ImageRegionIteratorWithIndex<ImageType> it(turned, region); !it.IsAtEnd(); ++it)
    {
      const auto source = turn(it.GetIndex());
      it.Set(region.IsInside(source) ? image->GetPixel(source) : 0.0f);
    }
    const auto smoothTurned = Smooth(turned.GetPointer(), 1.0);
    std::size_t compared = 0;
    for (itk::ImageRegionIteratorWithIndex<ImageType> it(smoothTurned, region); !it.IsAtEnd(); ++it)
    {
      const auto site = itk::FCCLattice::SiteOf(it.GetIndex());
      if (std::max({ std::abs(site[0]), std::abs(site[1]), std::abs(site[2]) }) <= 3)
      {
        ASSERT_NEAR(it.Get(), smooth->GetPixel(turn(it.GetIndex())), 1e-3);
        ++compared;
      }
    }
    EXPECT_EQ(compared, 171u);
  }
}

TEST(FCCGaussianImageFilter, GivesTheSameBytesForAnyThreadsAndRequestedRegion)
{
  const auto image = MakeImage<std::int16_t>({ { { -3, 5, 2 } }, { { 37, 64, 33 } } }, MakeSpacing(0.6, 0.6, 1.1));
  FillWithNoise(*image, -1024.0, 3071.0);
  const auto whole = Smooth(image.GetPointer(), 1.3, 1);
  for (const unsigned int threads : { 2u, 3u, 7u, 64u })
  {
    EXPECT_TRUE(AreSame(*Smooth(image.GetPointer(), 1.3, threads), *whole)) << threads;
  }
  std::mt19937 random(2);
  for (unsigned int trial = 0; trial < 20; ++trial)
  {
    ImageType::RegionType request;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto length = image->GetBufferedRegion().GetSize(axis);
      const auto begin = random() % length;
      request.SetIndex(axis, image->GetBufferedRegion().GetIndex(axis) + static_cast<itk::IndexValueType>(begin));
      request.SetSize(axis, 1 + random() % (length - begin));
    }
    const auto filter = FilterOf<std::int16_t>::New();
    filter->SetInput(image);
    filter->SetSigma(1.3);
    filter->GetOutput()->SetRequestedRegion(request);
    filter->Update();
    for (itk::ImageRegionIteratorWithIndex<itk::FCCImage<std::int16_t>> it(filter->GetOutput(), request); !it.IsAtEnd();
         ++it)
    {
      ASSERT_EQ(it.Get(), whole->GetPixel(it.GetIndex())) << request;
    }
  }
}

TEST(FCCGaussianImageFilter, AsksForWhatItNeedsOnly)
{
  const auto image = MakeImage<float>({ { { 0, 0, 0 } }, { { 40, 80, 80 } } }, MakeSpacing(1.0, 1.0, 1.0));
  const auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetSigma(1.0);
  filter->UpdateOutputInformation();
  filter->GetOutput()->SetRequestedRegion({ { { 20, 40, 70 } }, { { 2, 3, 10 } } });
  filter->GetOutput()->PropagateRequestedRegion();
  EXPECT_EQ(image->GetRequestedRegion(), ImageType::RegionType({ { 17, 36, 66 } }, { { 8, 11, 14 } }));
}

TEST(FCCGaussianImageFilter, MovesTheSurfaceOfASphereBySigmaSquaredOverItsRadius)
{
  // A ball's blurred edge lies where Gaussian-smoothed curvature says: the level at half height moves by sigma^2 / R.
  constexpr double radius = 12.0;
  constexpr double sigma = 1.5;
  constexpr double edge = 1.0; // of the ball as sampled, which moves its own half level by edge^2 / R
  const auto ball = [](const PointType & p) {
    const double distance = -fcctest::Sphere(p, 0.0);
    const double a = (radius - distance) / (std::sqrt(2.0) * edge);
    const double b = (radius + distance) / (std::sqrt(2.0) * edge);
    const double tails = std::exp(-b * b) - std::exp(-a * a);
    return 0.5 * (std::erf(a) + std::erf(b)) + edge / (std::sqrt(2.0 * itk::Math::pi) * distance) * tails;
  };
  const auto image =
    fcctest::MakeImage(0.6, 20.0, [&](const PointType & p) { return fcctest::Sphere(p, 0.0) > -1e-6 ? 1.0 : ball(p); });
  const auto smooth = Smooth(image.GetPointer(), sigma);
  const auto radiusOfHalf = [](const ImageType & field) {
    double sum = 0.0;
    std::size_t count = 0;
    for (itk::ImageRegionConstIteratorWithIndex<ImageType> it(&field, field.GetBufferedRegion()); !it.IsAtEnd(); ++it)
    {
      // Along x, between samples of a row: the field's slope is that of a smooth step.
      const auto next = it.GetIndex() + itk::Offset<3>{ { 1, 0, 0 } };
      if (field.GetBufferedRegion().IsInside(next) && (it.Get() >= 0.5f) != (field.GetPixel(next) >= 0.5f))
      {
        const double t = (0.5 - static_cast<double>(it.Get())) / static_cast<double>(field.GetPixel(next) - it.Get());
        auto p = field.TransformIndexToPhysicalPoint<double>(it.GetIndex());
        p[0] += t * 2.0 * field.GetSpacing()[0];
        if (std::abs(p[0]) > 0.7 * radius) // steep along x
        {
          sum += -fcctest::Sphere(p, 0.0);
          ++count;
        }
      }
    }
    return sum / static_cast<double>(count);
  };
  const double shrink = radiusOfHalf(*image) - radiusOfHalf(*smooth);
  EXPECT_NEAR(shrink, sigma * sigma / radius, 0.05 * sigma * sigma / radius);
}

TEST(FCCGaussianImageFilter, TakesNoiseAway)
{
  const auto image = fcctest::MakeImage(0.7, 14.0, [](const PointType &) { return 0.0; });
  FillWithNoise(*image, -100.0, 100.0);
  const auto rms = [](const ImageType & field) {
    double sum = 0.0;
    const auto count = field.GetBufferedRegion().GetNumberOfPixels();
    for (itk::SizeValueType n = 0; n < count; ++n)
    {
      sum += std::pow(static_cast<double>(field.GetBufferPointer()[n]), 2) / static_cast<double>(count);
    }
    return std::sqrt(sum);
  };
  constexpr double sigma = 1.0;
  // White noise falls by the root of the squared weights' sum: volume per site / (4 pi sigma^2)^(3/2).
  const double expected = std::sqrt(2.0 * std::pow(0.7, 3) / std::pow(4.0 * itk::Math::pi * sigma * sigma, 1.5));
  EXPECT_NEAR(rms(*Smooth(image.GetPointer(), sigma)) / rms(*image), expected, 0.1 * expected);
}

TEST(FCCGaussianImageFilter, LeavesOutSamplesThatAreNotFinite)
{
  const auto linear = [](const PointType &) { return 40.0; };
  const auto image = fcctest::MakeImage(0.8, 8.0, linear);
  FillWithNoise(*image, 0.0, 100.0);
  const auto clean = Smooth(image.GetPointer(), 1.0);
  const auto holed = fcctest::MakeImage(0.8, 8.0, linear);
  std::copy_n(image->GetBufferPointer(), image->GetBufferedRegion().GetNumberOfPixels(), holed->GetBufferPointer());
  const itk::Index<3> undefined{ { 0, 1, 0 } };
  const itk::Index<3> infinite{ { 2, 0, -1 } };
  holed->SetPixel(undefined, std::numeric_limits<float>::quiet_NaN());
  holed->SetPixel(infinite, std::numeric_limits<float>::infinity());
  const auto smooth = Smooth(holed.GetPointer(), 1.0);
  EXPECT_TRUE(AreSame(*Smooth(holed.GetPointer(), 1.0, 5), *smooth)) << "wherever the threads' parts begin";
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(smooth, smooth->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto p = smooth->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    if (it.GetIndex() == undefined)
    {
      EXPECT_TRUE(std::isnan(it.Get()));
    }
    else if (it.GetIndex() == infinite)
    {
      EXPECT_EQ(it.Get(), std::numeric_limits<float>::infinity());
    }
    else
    {
      EXPECT_GE(it.Get(), 0.0f);
      EXPECT_LE(it.Get(), 100.0f);
      if (std::abs(p[1]) > 5.6 || std::abs(p[2]) > 5.6)
      {
        EXPECT_EQ(it.Get(), clean->GetPixel(it.GetIndex())) << "out of their reach";
      }
    }
  }
  holed->FillBuffer(12.5f);
  holed->SetPixel(undefined, std::numeric_limits<float>::quiet_NaN());
  EXPECT_NEAR(Smooth(holed.GetPointer(), 1.0)->GetPixel({ { 0, 2, 1 } }), 12.5f, 1e-5f) << "an average, not a sum";
}

TEST(FCCGaussianImageFilter, SmoothsThinImagesWithinTheirPlanes)
{
  for (const itk::Size<3> size :
       { itk::Size<3>{ { 9, 1, 1 } }, itk::Size<3>{ { 9, 8, 1 } }, itk::Size<3>{ { 9, 1, 8 } } })
  {
    const auto image = MakeImage<float>({ { { 0, 0, 0 } }, size }, MakeSpacing(1.0, 1.0, 1.0));
    image->FillBuffer(3.0f);
    image->SetPixel({ { 4, 0, 0 } }, 100.0f);
    const auto smooth = Smooth(image.GetPointer(), 1.0);
    EXPECT_LT(smooth->GetPixel({ { 4, 0, 0 } }), 99.0f);
    EXPECT_GT(smooth->GetPixel({ { 3, 0, 0 } }), 3.0f);
    EXPECT_FLOAT_EQ(smooth->GetPixel({ { 3, 0, 0 } }), smooth->GetPixel({ { 5, 0, 0 } }));
  }
}

TEST(FCCGaussianImageFilter, RefusesWhatMakesNoSense)
{
  const auto image = MakeImage<float>({ { { 0, 0, 0 } }, { { 4, 4, 4 } } }, MakeSpacing(0.5, 0.5, 0.5));
  for (const double sigma :
       { -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e6 })
  {
    EXPECT_THROW(Smooth(image.GetPointer(), sigma), itk::ExceptionObject) << sigma;
  }
  auto direction = image->GetDirection();
  direction[0][2] = 0.2;
  image->SetDirection(direction);
  EXPECT_THROW(Smooth(image.GetPointer(), 1.0), itk::ExceptionObject);
}

TEST(FCCGaussianImageFilter, ReportsProgressAndStopsOnAbort)
{
  const auto image = MakeImage<float>({ { { 0, 0, 0 } }, { { 32, 64, 64 } } }, MakeSpacing(1.0, 1.0, 1.0));
  const auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetSigma(1.0);
  float last = 0.0f;
  bool monotonic = true;
  std::set<float> reported;
  filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    monotonic = monotonic && filter->GetProgress() >= last;
    last = filter->GetProgress();
    reported.insert(last);
  });
  filter->Update();
  EXPECT_TRUE(monotonic);
  EXPECT_EQ(last, 1.0f);
  EXPECT_GT(reported.size(), 5u);

  const auto aborting = Filter::New();
  aborting->SetInput(image);
  aborting->SetSigma(1.0);
  aborting->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) { aborting->AbortGenerateDataOn(); });
  EXPECT_THROW(aborting->Update(), itk::ProcessAborted);
}

} // namespace
