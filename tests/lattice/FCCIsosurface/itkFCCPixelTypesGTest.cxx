#include "itkFCCIsosurfaceFilter.h"

#include "itkFCCRowKernels.h"
#include "itkFCCTestImages.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace
{

using Mode = itk::FCCIsosurfaceMode;
using Surface = itk::TriangleSurface;

template <typename TPixel, typename TConvert>
typename itk::FCCImage<TPixel>::Pointer
Converted(const fcctest::ImageType & image, const TConvert & convert)
{
  const auto result = itk::FCCImage<TPixel>::New();
  result->CopyInformation(&image);
  result->SetRegions(image.GetBufferedRegion());
  result->Allocate();
  const float * const samples = image.GetBufferPointer();
  std::transform(samples, samples + image.GetBufferedRegion().GetNumberOfPixels(), result->GetBufferPointer(), convert);
  return result;
}

template <typename TPixel>
Surface::Pointer
Extract(const itk::FCCImage<TPixel> * image, double isovalue, Mode mode, bool insideIsBelow = false)
{
  const auto filter = itk::FCCIsosurfaceFilter<itk::FCCImage<TPixel>>::New();
  filter->SetInput(image);
  filter->SetIsovalue(isovalue);
  filter->SetMode(mode);
  filter->SetInsideIsBelow(insideIsBelow);
  filter->SetNumberOfWorkUnits(2);
  filter->Update();
  Surface::Pointer surface = filter->GetOutput();
  surface->DisconnectPipeline();
  return surface;
}

template <typename TPixel>
class FCCPixelTypes : public testing::Test
{};
using PixelTypes = testing::Types<char,
                                  signed char,
                                  unsigned char,
                                  short,
                                  unsigned short,
                                  int,
                                  unsigned int,
                                  long,
                                  unsigned long,
                                  long long,
                                  unsigned long long,
                                  float,
                                  double>;
TYPED_TEST_SUITE(FCCPixelTypes, PixelTypes);

TYPED_TEST(FCCPixelTypes, GiveTheSurfaceThatTheSameNumbersGiveAsFloats)
{
  std::mt19937 random(11);
  for (const Mode mode : { Mode::Tetrahedra, Mode::Octahedra, Mode::Fine, Mode::Lean })
  {
    const auto floats =
      fcctest::MakeNoise({ { { -1, 2, 0 } }, { { 70, 7, 6 } } }, static_cast<unsigned int>(mode), 100);
    const auto image = Converted<TypeParam>(*floats, [](float value) { return static_cast<TypeParam>(value); });
    for (const bool insideIsBelow : { false, true })
    {
      const double isovalue = 0.5 * static_cast<double>(random() % 200); // equal to samples, or between them
      const auto expected = Extract(floats.GetPointer(), isovalue, mode, insideIsBelow);
      const auto found = Extract(image.GetPointer(), isovalue, mode, insideIsBelow);
      EXPECT_GT(expected->GetNumberOfTriangles(), 0u);
      EXPECT_TRUE(found->GetPoints() == expected->GetPoints()) << mode << " at " << isovalue;
      EXPECT_TRUE(found->GetNormals() == expected->GetNormals()) << mode << " at " << isovalue;
      EXPECT_TRUE(found->GetTriangles() == expected->GetTriangles()) << mode << " at " << isovalue;
    }
  }
}

// Against long double, which holds all numbers of all types; on all instruction sets.
TYPED_TEST(FCCPixelTypes, AreComparedExactlyWithAnyIsovalue)
{
  using Limits = std::numeric_limits<TypeParam>;
  static_assert(std::numeric_limits<long double>::digits >= Limits::digits, "");
  const double lowest = static_cast<double>(Limits::lowest());
  const double greatest = static_cast<double>(Limits::max()); // rounded up for 64 bits
  std::vector<double> isovalues{ 0.0, -0.5, 0.5, -1e300, 1e300, std::ldexp(1.0, 53), 0.75 * greatest };
  for (const double isovalue : { lowest, greatest, 3.0, std::ldexp(1.0, 60), -std::ldexp(1.0, 60) })
  {
    constexpr double largest = std::numeric_limits<double>::max();
    isovalues.push_back(isovalue);
    isovalues.push_back(std::nextafter(isovalue, -largest));
    isovalues.push_back(std::nextafter(isovalue, largest));
  }
  std::mt19937_64 random(5);
  std::vector<TypeParam> values{ 0, 1, 2, 3, 4, Limits::lowest(), Limits::max() };
  for (const double isovalue : isovalues)
  {
    if (isovalue > lowest && isovalue < greatest)
    {
      const auto near = static_cast<TypeParam>(isovalue);
      values.insert(values.end(), { near, static_cast<TypeParam>(near - 1), static_cast<TypeParam>(near + 1) });
    }
  }
  while (values.size() < 200)
  {
    values.push_back(static_cast<TypeParam>(random()));
  }
  if (Limits::has_infinity)
  {
    values.insert(values.end(), { Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN() });
  }
  std::shuffle(values.begin(), values.end(), random);

  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1)
  {
    const std::int64_t target = left & -left;
    hwy::SetSupportedTargetsForTest(target);
    for (const double isovalue : isovalues)
    {
      for (const bool isBelow : { false, true })
      {
        std::vector<std::uint64_t> words(values.size() / 64 + 1);
        itk::FCCRowKernels::Classify(values.data(), values.size(), isovalue, isBelow, words.data());
        for (std::size_t i = 0; i < values.size(); ++i)
        {
          const auto value = static_cast<long double>(values[i]);
          const bool isInside = isBelow ? value < isovalue : value >= isovalue;
          ASSERT_EQ(words[i / 64] >> (i % 64) & 1, isInside ? 1u : 0u)
            << hwy::TargetName(target) << ": " << value << (isBelow ? " below " : " at least ") << isovalue;
        }
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

// Differences from the isovalue are zero on both sides of it.
template <typename TPixel, typename TConvert>
void
ExpectWatertight(double isovalue, const TConvert & convert)
{
  for (const Mode mode : { Mode::Tetrahedra, Mode::Octahedra, Mode::Parallelepipeds, Mode::Fine, Mode::Lean })
  {
    for (unsigned int seed = 0; seed < 20; ++seed)
    {
      const auto floats = fcctest::MakeNoise({ { { 0, 0, 0 } }, { { 6, 9, 8 } } }, seed, 4);
      const auto surface = Extract(Converted<TPixel>(*floats, convert).GetPointer(), isovalue, mode);
      const auto topology = ComputeTriangleSurfaceTopology(*surface);
      EXPECT_TRUE(topology.IsWatertight()) << mode << topology;
      EXPECT_EQ(topology.nonFinitePoints, 0u);
      if (mode == Mode::Tetrahedra)
      {
        EXPECT_EQ(surface->GetNumberOfTriangles(), Extract(floats.GetPointer(), 2.0, mode)->GetNumberOfTriangles());
      }
    }
  }
}

TEST(FCCPixelTypes, NumbersTooCloseForFloatsGiveWatertightSurfaces)
{
  const double large = std::ldexp(1.0, 60);
  ExpectWatertight<long long>(large, [](float value) { return (1LL << 60) - 2 + static_cast<long long>(value); });
  ExpectWatertight<unsigned long long>(8.0 * large,
                                       [](float value) { return (1ULL << 63) - 2 + static_cast<unsigned>(value); });
  ExpectWatertight<double>(2e-60, [](float value) { return 1e-60 * static_cast<double>(value); });
  ExpectWatertight<double>(2e60, [](float value) { return 1e60 * static_cast<double>(value); });
}

} // namespace
