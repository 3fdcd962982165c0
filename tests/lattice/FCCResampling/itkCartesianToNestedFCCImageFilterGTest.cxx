#include "itkCartesianToNestedFCCImageFilter.h"

#include "detail/itkFCCMirror.h"
#include "itkImageRegionIteratorWithIndex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace
{

template <typename TPixel>
using Cartesian = itk::Image<TPixel, 3>;
template <typename TPixel>
using Filter = itk::CartesianToNestedFCCImageFilter<Cartesian<TPixel>>;
using FloatImage = Cartesian<float>;
using Site = itk::FCCLattice::SiteType;

template <typename TPixel, typename TField>
typename Cartesian<TPixel>::Pointer
MakeImage(const itk::Size<3> & size, const itk::Index<3> & start, TField field)
{
  const auto image = Cartesian<TPixel>::New();
  image->SetRegions(typename Cartesian<TPixel>::RegionType(start, size));
  image->Allocate();
  const double spacing[3] = { 0.7, 0.9, 2.0 };
  const double origin[3] = { -30.0, 12.0, 100.0 };
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  for (itk::ImageRegionIteratorWithIndex<Cartesian<TPixel>> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<TPixel>(field(it.GetIndex() - start)));
  }
  return image;
}

/** White noise of any integer or real type. */
template <typename TPixel>
auto
Noise(unsigned int seed)
{
  return [random = std::mt19937(seed)](const auto &) mutable { return static_cast<TPixel>(random() % 251); };
}

template <typename TOutput, typename TCheck>
void
ForEachSite(const TOutput & output, const TCheck & check)
{
  for (itk::ImageRegionConstIteratorWithIndex<TOutput> it(&output, output.GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    check(itk::FCCLattice::SiteOf(it.GetIndex()), it.Get());
  }
}

bool
IsInside(const Site & site, const itk::Size<3> & size, itk::IndexValueType margin)
{
  bool inside = true;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    inside = inside && site[axis] >= margin && site[axis] < static_cast<itk::IndexValueType>(size[axis]) - margin;
  }
  return inside;
}

TEST(CartesianToNestedFCCImageFilter, PinsItsDefaultsAndRefusesNoInput)
{
  const auto filter = Filter<float>::New();
  EXPECT_TRUE(filter->GetAntialiasing());
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("Antialiasing: On"), std::string::npos);
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
}

TEST(CartesianToNestedFCCImageFilter, WithoutAntialiasingSitesAreSamplesAtTheirOwnPoints)
{
  std::mt19937 random(3);
  for (int trial = 0; trial < 60; ++trial)
  {
    itk::Size<3> size;
    itk::Index<3> start;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      size[axis] = 1 + random() % 9;
      start[axis] = static_cast<itk::IndexValueType>(random() % 7) - 3;
    }
    const auto image = MakeImage<std::int16_t>(size, start, Noise<std::int16_t>(random()));
    const auto filter = Filter<std::int16_t>::New();
    filter->SetInput(image);
    filter->AntialiasingOff();
    filter->Update();
    const auto * const output = filter->GetOutput();
    EXPECT_EQ(output->GetSpacing(), image->GetSpacing());
    EXPECT_EQ(output->GetDirection(), image->GetDirection());
    std::size_t found = 0;
    ForEachSite(*output, [&](const Site & site, std::int16_t value) {
      itk::Index<3> index;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        index[axis] =
          start[axis] + itk::MirrorIntoRange(site[axis], 0, static_cast<itk::OffsetValueType>(size[axis]) - 1);
      }
      ASSERT_EQ(value, image->GetPixel(index));
      if (IsInside(site, size, 0))
      {
        ++found;
        const auto at = output->TransformIndexToPhysicalPoint<double>(itk::FCCLattice::IndexOf(site));
        ASSERT_LT(at.EuclideanDistanceTo(image->TransformIndexToPhysicalPoint<double>(index)), 1e-9);
      }
    });
    ASSERT_EQ(found, (size[0] * size[1] * size[2] + 1) / 2) << "every even site";
  }
}

TEST(CartesianToNestedFCCImageFilter, AntialiasingKeepsConstantsEverywhereAndLinearFieldsInside)
{
  const itk::Size<3> size{ { 21, 16, 18 } };
  const auto constant = MakeImage<std::uint16_t>(size, { { 1, 2, 3 } }, [](const auto &) { return 51234; });
  const auto keeping = Filter<std::uint16_t>::New();
  keeping->SetInput(constant);
  keeping->Update();
  ForEachSite(*keeping->GetOutput(), [](const Site &, std::uint16_t value) { ASSERT_EQ(value, 51234); });

  const auto linear =
    MakeImage<float>(size, { { 1, 2, 3 } }, [](const auto & x) { return 2.0 * x[0] - x[1] + 0.5 * x[2]; });
  const auto filter = Filter<float>::New();
  filter->SetInput(linear);
  filter->Update();
  ForEachSite(*filter->GetOutput(), [&](const Site & site, float value) {
    if (IsInside(site, size, 3))
    {
      ASSERT_NEAR(value, 2.0 * site[0] - site[1] + 0.5 * site[2], 2e-5);
    }
  });
}

TEST(CartesianToNestedFCCImageFilter, AntialiasingHasTheHalfBandResponse)
{
  const itk::Size<3> size{ { 24, 24, 24 } };
  const double pi = std::acos(-1.0);
  struct Wave
  {
    double k[3];
    double response;
  };
  const Wave waves[] = { { { 0.5 * pi, 0.5 * pi, 0.5 * pi }, 0.5 }, // where the bands meet
                         { { pi, 0.0, 0.5 * pi }, 0.5 },
                         { { pi, pi, pi }, 0.0 },
                         { { 0.1 * pi, 0.2 * pi, 0.3 * pi }, -1.0 },
                         { { 0.9 * pi, 0.4 * pi, 0.7 * pi }, -1.0 } };
  for (const Wave & wave : waves)
  {
    const double a = (std::cos(wave.k[0]) + std::cos(wave.k[1]) + std::cos(wave.k[2])) / 3.0;
    const double response = 0.5 + 0.75 * a - 0.25 * a * a * a;
    if (wave.response >= 0.0)
    {
      EXPECT_NEAR(response, wave.response, 1e-12);
    }
    const auto field = [&](const auto & x) {
      return std::cos(wave.k[0] * x[0] + wave.k[1] * x[1] + wave.k[2] * x[2] + 0.3);
    };
    const auto filter = Filter<float>::New();
    filter->SetInput(MakeImage<float>(size, { { 0, 0, 0 } }, field));
    filter->Update();
    ForEachSite(*filter->GetOutput(), [&](const Site & site, float value) {
      if (IsInside(site, size, 3))
      {
        ASSERT_NEAR(value, response * field(site), 1e-6);
      }
    });
  }
}

/** 1/2 + 3/4 A - 1/4 A^3 by applying A three times, with mirrored ends. */
std::vector<double>
HalfBandByOperator(const std::vector<double> & samples, const itk::Size<3> & size)
{
  const auto at = [&](const std::vector<double> & f, std::array<itk::OffsetValueType, 3> x) {
    std::size_t place = 0;
    for (unsigned int axis = 3; axis-- > 0;)
    {
      const auto length = static_cast<itk::OffsetValueType>(size[axis]);
      place = place * size[axis] + static_cast<std::size_t>(itk::MirrorIntoRange(x[axis], 0, length - 1));
    }
    return f[place];
  };
  const auto mean = [&](const std::vector<double> & f) {
    std::vector<double> result;
    for (itk::OffsetValueType z = 0; z < static_cast<itk::OffsetValueType>(size[2]); ++z)
    {
      for (itk::OffsetValueType y = 0; y < static_cast<itk::OffsetValueType>(size[1]); ++y)
      {
        for (itk::OffsetValueType x = 0; x < static_cast<itk::OffsetValueType>(size[0]); ++x)
        {
          result.push_back((at(f, { x - 1, y, z }) + at(f, { x + 1, y, z }) + at(f, { x, y - 1, z }) +
                            at(f, { x, y + 1, z }) + at(f, { x, y, z - 1 }) + at(f, { x, y, z + 1 })) /
                           6.0);
        }
      }
    }
    return result;
  };
  const auto once = mean(samples);
  const auto thrice = mean(mean(once));
  std::vector<double> result(samples.size());
  for (std::size_t n = 0; n < samples.size(); ++n)
  {
    result[n] = 0.5 * samples[n] + 0.75 * once[n] - 0.25 * thrice[n];
  }
  return result;
}

TEST(CartesianToNestedFCCImageFilter, AntialiasingIsTheOperatorOnVolumesOfAnySize)
{
  std::mt19937 random(5);
  for (int trial = 0; trial < 40; ++trial)
  {
    const itk::Size<3> size{ { 1 + random() % 40, 1 + random() % 6, 1 + random() % 12 } };
    const auto image = MakeImage<float>(size, { { -2, 5, 1 } }, Noise<float>(random()));
    const auto * const pixels = image->GetBufferPointer();
    const auto expected = HalfBandByOperator({ pixels, pixels + size[0] * size[1] * size[2] }, size);
    const auto filter = Filter<float>::New();
    filter->SetInput(image);
    filter->Update();
    ForEachSite(*filter->GetOutput(), [&](const Site & site, float value) {
      const auto x =
        static_cast<std::size_t>(itk::MirrorIntoRange(site[0], 0, static_cast<itk::OffsetValueType>(size[0]) - 1));
      const auto place =
        (static_cast<std::size_t>(site[2]) * size[1] + static_cast<std::size_t>(site[1])) * size[0] + x;
      ASSERT_NEAR(value, expected[place], 1e-3) << size;
    });
  }
}

template <typename TPixel>
class CartesianToNestedFCCPixelTypes : public testing::Test
{};

using PixelTypes = testing::Types<std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, float, double>;
TYPED_TEST_SUITE(CartesianToNestedFCCPixelTypes, PixelTypes);

TYPED_TEST(CartesianToNestedFCCPixelTypes, AnyThreadsAndRegionGiveTheSameBytesAndNeedOnlyTheirSurroundings)
{
  std::mt19937 random(11);
  for (const bool antialiasing : { true, false })
  {
    for (int trial = 0; trial < 12; ++trial)
    {
      const itk::Size<3> size{ { 1 + random() % 70, 1 + random() % 40, 1 + random() % 30 } };
      const auto image = MakeImage<TypeParam>(size, { { 3, -2, 7 } }, Noise<TypeParam>(random()));
      const auto whole = Filter<TypeParam>::New();
      whole->SetInput(image);
      whole->SetAntialiasing(antialiasing);
      whole->SetNumberOfWorkUnits(1);
      whole->Update();
      const auto all = whole->GetOutput()->GetLargestPossibleRegion();
      auto region = all;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const auto begin = random() % all.GetSize(axis);
        region.SetIndex(axis, static_cast<itk::IndexValueType>(begin));
        region.SetSize(axis, 1 + random() % (all.GetSize(axis) - begin));
      }
      const auto part = Filter<TypeParam>::New();
      part->SetInput(image);
      part->SetAntialiasing(antialiasing);
      part->SetNumberOfWorkUnits(1 + static_cast<unsigned int>(trial) % 5);
      part->GetOutput()->SetRequestedRegion(region);
      part->Update();
      using OutputType = itk::FCCImage<TypeParam>;
      for (itk::ImageRegionConstIteratorWithIndex<OutputType> it(part->GetOutput(), region); !it.IsAtEnd(); ++it)
      {
        ASSERT_EQ(it.Get(), whole->GetOutput()->GetPixel(it.GetIndex()));
      }
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        EXPECT_LE(image->GetRequestedRegion().GetSize(axis), (axis == 0 ? 2 : 1) * region.GetSize(axis) + 6);
      }
    }
  }
}

} // namespace
