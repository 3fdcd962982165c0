#include "detail/itkRowArithmetic.h"

#include "itkCartesianToFCCImageFilter.h"
#include "itkCartesianToNestedFCCImageFilter.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace
{

namespace Rows = itk::RowArithmetic;

/** Runs the work once for each SIMD target that the processor has and the library was compiled for. */
template <typename TWork>
void
ForEachTarget(const TWork & work)
{
  const std::int64_t supported = hwy::SupportedTargets();
  int targets = 0;
  for (std::int64_t rest = supported; rest != 0; rest &= rest - 1)
  {
    const std::int64_t target = rest & -rest;
    if ((target & HWY_TARGETS) == 0)
    {
      continue;
    }
    hwy::SetSupportedTargetsForTest(target);
    SCOPED_TRACE(hwy::TargetName(target));
    ++targets;
    work();
  }
  hwy::SetSupportedTargetsForTest(0);
  EXPECT_GE(targets, 1);
}

std::vector<float>
RandomRow(itk::SizeValueType length, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-1000.0f, 1000.0f);
  std::vector<float> row(Rows::PaddedLength(length));
  std::generate_n(row.begin(), length, [&] { return value(random); });
  return row;
}

template <typename TPixel>
class RowArithmeticPixelTypes : public testing::Test
{};

using PixelTypes = testing::Types<std::uint8_t, std::int8_t, std::int16_t, std::uint16_t, std::int32_t, float>;
TYPED_TEST_SUITE(RowArithmeticPixelTypes, PixelTypes);

TYPED_TEST(RowArithmeticPixelTypes, ConvertsExactlyAsACast)
{
  using Limits = std::numeric_limits<TypeParam>;
  std::mt19937_64 random(2);
  for (itk::SizeValueType length = 1; length < 70; ++length)
  {
    std::vector<TypeParam> row(length);
    std::generate(row.begin(), row.end(), [&] { return static_cast<TypeParam>(random() % 100000007); });
    row.front() = Limits::lowest();
    row.back() = Limits::max();
    ForEachTarget([&] {
      std::vector<float> real(length + 1, -7.0f);
      Rows::ConvertFrom(row.data(), length, real.data());
      for (itk::SizeValueType n = 0; n < length; ++n)
      {
        ASSERT_EQ(real[n], static_cast<float>(row[n]));
      }
      ASSERT_EQ(real[length], -7.0f) << "written beyond the end";
    });
  }
}

TYPED_TEST(RowArithmeticPixelTypes, RoundsExactlyAsRoundAndClamp)
{
  using Limits = std::numeric_limits<TypeParam>;
  const float infinity = std::numeric_limits<float>::infinity();
  std::vector<float> special{ 0.0f,   -0.0f,   0.5f,         -0.5f,        1.5f,          2.5f,          -2.5f,
                              254.5f, 255.5f,  32767.5f,     -32768.5f,    65535.5f,      0.49999997f,   -0.49999997f,
                              1e20f,  -1e20f,  infinity,     -infinity,    8388609.f,     -8388609.f,    4194304.5f,
                              1e9f,   -2.1e9f, 2147483520.f, 2147483648.f, -2147483648.f, std::nanf(""), 3.7f };
  const auto more = RandomRow(200, 9);
  special.insert(special.end(), more.begin(), more.end());
  special.push_back(static_cast<float>(Limits::max()));
  special.push_back(static_cast<float>(Limits::lowest()));
  ForEachTarget([&] {
    for (itk::SizeValueType begin = 0; begin < 20; ++begin)
    {
      const auto length = special.size() - begin;
      std::vector<TypeParam> row(length + 1, 42);
      Rows::RoundTo(special.data() + begin, length, row.data());
      for (itk::SizeValueType n = 0; n < length; ++n)
      {
        const auto expected = itk::RoundAndClamp<TypeParam>(special[begin + n]);
        ASSERT_TRUE(row[n] == expected || (expected != expected && row[n] != row[n])) << special[begin + n];
      }
      ASSERT_EQ(row[length], 42) << "written beyond the end";
    }
  });
}

TEST(RowArithmetic, BlendIsTheSumInOrder)
{
  for (itk::SizeValueType length = 1; length < 150; length += 7)
  {
    for (const itk::SizeValueType count : { 1, 2, 3, 10, 45 })
    {
      std::vector<std::vector<float>> rows;
      std::vector<const float *> pointers;
      for (itk::SizeValueType n = 0; n < count; ++n)
      {
        rows.push_back(RandomRow(length, static_cast<unsigned int>(n)));
        pointers.push_back(rows.back().data());
      }
      const auto weights = RandomRow(count, 77);
      ForEachTarget([&] {
        std::vector<float> blend(Rows::PaddedLength(length));
        Rows::Blend(pointers.data(), weights.data(), count, length, blend.data());
        for (itk::SizeValueType x = 0; x < length; ++x)
        {
          float sum = weights[0] * rows[0][x];
          for (itk::SizeValueType n = 1; n < count; ++n)
          {
            sum += weights[n] * rows[n][x];
          }
          ASSERT_EQ(blend[x], sum);
        }
      });
    }
  }
}

TEST(RowArithmetic, InterpolateIsTheSumOfTheTapsInOrderForAnyStep)
{
  const itk::SizeValueType length = 300;
  const auto row = RandomRow(length, 5);
  for (const auto kernel :
       { itk::SeparableKernel::Linear, itk::SeparableKernel::CubicBSpline, itk::SeparableKernel::Lanczos4 })
  {
    for (const double step : { 0.01, 0.3, 1.0, 1.7320508, 1.99, 2.2, 5.0, 60.0 })
    {
      std::vector<double> positions;
      for (double x = -2.0; x < static_cast<double>(length) + 1.0 && positions.size() < 400; x += step)
      {
        positions.push_back(x);
      }
      const itk::SeparableTaps taps(kernel, length, positions);
      const Rows::RowTaps rowTaps(taps, positions.size(), 0);
      ForEachTarget([&] {
        std::vector<float> values(rowTaps.GetPaddedLength());
        Rows::Interpolate(row.data(), rowTaps, values.data());
        for (itk::SizeValueType n = 0; n < positions.size(); ++n)
        {
          const float * const weights = taps.GetWeights(n);
          const float * const samples = row.data() + taps.GetFirst(n);
          float sum = weights[0] * samples[0];
          for (itk::SizeValueType tap = 1; tap < taps.GetNumberOfTaps(); ++tap)
          {
            sum += weights[tap] * samples[tap];
          }
          ASSERT_EQ(values[n], sum) << kernel << " at " << positions[n] << " of step " << step;
        }
      });
    }
  }
}

TEST(RowArithmetic, FiltersGiveTheSameBytesOnAllTargets)
{
  using ImageType = itk::Image<std::int16_t, 3>;
  const auto image = ImageType::New();
  image->SetRegions(itk::Size<3>{ { 61, 33, 20 } });
  image->Allocate();
  std::mt19937 random(31);
  std::generate_n(
    image->GetBufferPointer(), 61 * 33 * 20, [&] { return static_cast<std::int16_t>(random() % 4096 - 1024); });
  std::vector<std::vector<std::int16_t>> first;
  ForEachTarget([&] {
    std::vector<std::vector<std::int16_t>> outputs;
    const auto keep = [&](auto & filter) {
      filter.SetInput(image);
      filter.Update();
      const auto * const pixels = filter.GetOutput()->GetBufferPointer();
      outputs.emplace_back(pixels, pixels + filter.GetOutput()->GetBufferedRegion().GetNumberOfPixels());
    };
    for (const auto kernel :
         { itk::SeparableKernel::Linear, itk::SeparableKernel::CubicBSpline, itk::SeparableKernel::Lanczos4 })
    {
      const auto filter = itk::CartesianToFCCImageFilter<ImageType>::New();
      filter->SetKernel(kernel);
      keep(*filter);
    }
    keep(*itk::CartesianToNestedFCCImageFilter<ImageType>::New());
    first = first.empty() ? outputs : first;
    ASSERT_EQ(outputs, first);
  });
}

} // namespace
