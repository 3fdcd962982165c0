#include "rhombicIntensities.h"

#include "rhombicFailure.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{

using rhombic::Failure;

template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
MakeImage(const std::vector<TPixel> & values)
{
  auto image = itk::Image<TPixel, 3>::New();
  image->SetRegions(itk::Size<3>{ { values.size(), 1, 1 } });
  image->Allocate();
  std::copy(values.begin(), values.end(), image->GetBufferPointer());
  return image;
}

TEST(Intensities, FindRangeAndTheThresholdBetweenTwoGroups)
{
  std::vector<std::int16_t> values;
  for (int n = 0; n < 100; ++n)
  {
    values.push_back(static_cast<std::int16_t>(-1000 + n % 50));
    values.push_back(static_cast<std::int16_t>(40 + n % 30));
  }
  const auto found = rhombic::ComputeIntensities(MakeImage(values));
  EXPECT_EQ(found.lowest, -1000);
  EXPECT_EQ(found.highest, 69);
  EXPECT_GT(found.otsu, -951);
  EXPECT_LT(found.otsu, 40);
  EXPECT_NE(found.otsu, std::floor(found.otsu)) << "between whole numbers, so that no sample equals it";
}

/** Noise of the air, dark and bright tissue of an MR: the lower threshold keeps the dark tissue. */
TEST(Intensities, FindTheThresholdBetweenNoiseAndDarkTissue)
{
  std::vector<std::int16_t> values;
  for (int n = 0; n < 1000; ++n)
  {
    values.push_back(static_cast<std::int16_t>(n % 8));
    values.push_back(static_cast<std::int16_t>(n % 2 == 0 ? 300 + n % 50 : n % 5));
  }
  for (int n = 0; n < 200; ++n)
  {
    values.push_back(static_cast<std::int16_t>(60 + n % 20));
  }
  const auto found = rhombic::ComputeIntensities(MakeImage(values));
  EXPECT_GT(found.otsu, 79);
  EXPECT_LT(found.otsu, 300);
  EXPECT_GT(found.lowOtsu, 7);
  EXPECT_LT(found.lowOtsu, 60);
}

/** Counts of a PET: air, a body, and two hot spots. */
TEST(Intensities, FindTheThresholdsOfABodyWithHotSpots)
{
  std::vector<std::int16_t> values;
  for (int n = 0; n < 4000; ++n)
  {
    values.push_back(static_cast<std::int16_t>(n % 30));
  }
  for (int n = 0; n < 1000; ++n)
  {
    values.push_back(static_cast<std::int16_t>(n % 2 == 0 ? 500 + n % 100 : 1800 + n % 200));
  }
  for (int n = 0; n < 60; ++n)
  {
    values.push_back(static_cast<std::int16_t>(n % 2 == 0 ? 12000 : 20000));
  }
  const auto found = rhombic::ComputeIntensities(MakeImage(values));
  EXPECT_GT(found.lowestOtsu, 29);
  EXPECT_LT(found.lowestOtsu, 500);
  EXPECT_GT(found.lowOtsu, 599);
  EXPECT_LT(found.lowOtsu, 1800);
  EXPECT_GT(found.otsu, 1999);
  EXPECT_LT(found.otsu, 12000);
  EXPECT_GT(found.highOtsu, 12000);
  EXPECT_LT(found.highOtsu, 20000);
}

TEST(Intensities, DoNotCountWhatIsNotFinite)
{
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const auto found = rhombic::ComputeIntensities(MakeImage<float>({ nan, 1.0f, infinity, 3.0f, -infinity }));
  EXPECT_EQ(found.lowest, 1.0);
  EXPECT_EQ(found.highest, 3.0);
  EXPECT_THROW(rhombic::ComputeIntensities(MakeImage<float>({ nan, nan })), Failure);
  EXPECT_EQ(rhombic::ComputeIntensities(MakeImage<float>({ 2.0f, 2.0f })).otsu, 2.0);
}

} // namespace
