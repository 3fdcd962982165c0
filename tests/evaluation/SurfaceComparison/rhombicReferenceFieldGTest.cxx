#include "rhombicFieldSampling.h"
#include "rhombicShapeFields.h"

#include "itkFCCImage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

using namespace rhombic;

namespace
{

/** Samples a field on an FCC lattice that covers the cube from 0 to \a edge along each axis; a site is at the world's
 * origin. \param density sites per unit of volume, above 0 */
template <typename TPixel>
typename itk::FCCImage<TPixel>::Pointer
SampleOnLattice(const ReferenceField & field, double edge, double density, double scale = 1.0)
{
  using ImageType = itk::FCCImage<TPixel>;
  const double spacing = std::cbrt(1.0 / (itk::FCCLattice::CellVolume * density));
  const auto rows = static_cast<itk::SizeValueType>(std::ceil(edge / spacing)) + 1;
  return SampleField<ImageType>(field, { { rows / 2 + 1, rows, rows } }, spacing, {}, scale);
}

void
ExpectGradientMatchesDifferences(const ReferenceField & field)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-8.0, 8.0);
  constexpr double step = 1e-4;
  for (unsigned int i = 0; i < 200; ++i)
  {
    const Vector3 point{ coordinate(random), coordinate(random), coordinate(random) };
    Vector3 gradient;
    EXPECT_DOUBLE_EQ(field.Evaluate(point), field.Evaluate(point, gradient));
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      Vector3 before = point;
      Vector3 after = point;
      before[axis] -= step;
      after[axis] += step;
      EXPECT_NEAR(gradient[axis], (field.Evaluate(after) - field.Evaluate(before)) / (2.0 * step), 1e-5);
    }
  }
}

} // namespace

TEST(SphereField, IsTheSignedDistance)
{
  const ReferenceField sphere = MakeSphereField({ 1.0, 2.0, 3.0 }, 5.0);
  EXPECT_DOUBLE_EQ(sphere.Evaluate({ 1.0, 2.0, 3.0 }), 5.0);
  EXPECT_DOUBLE_EQ(sphere.Evaluate({ 1.0, 8.0, 3.0 }), -1.0);
  ExpectGradientMatchesDifferences(sphere);
}

TEST(TorusField, IsTheSignedDistance)
{
  const ReferenceField torus = MakeTorusField({ 0.0, 0.0, 0.0 }, { 0.0, 0.0, 2.0 }, 6.0, 2.0);
  EXPECT_DOUBLE_EQ(torus.Evaluate({ 6.0, 0.0, 0.0 }), 2.0);
  EXPECT_DOUBLE_EQ(torus.Evaluate({ 0.0, 6.0, 2.5 }), -0.5);
  EXPECT_DOUBLE_EQ(torus.Evaluate({ 0.0, 9.0, 0.0 }), -1.0);
  ExpectGradientMatchesDifferences(MakeTorusField({ 0.3, -0.2, 0.1 }, { 1.0, 2.0, -1.0 }, 6.0, 2.0));
}

TEST(GyroidField, RepeatsAndHasItsGradient)
{
  const ReferenceField gyroid = MakeGyroidField(12.0);
  EXPECT_NEAR(gyroid.Evaluate({ 1.0, 2.0, 3.0 }), gyroid.Evaluate({ 13.0, -10.0, 27.0 }), 1e-12);
  ExpectGradientMatchesDifferences(gyroid);
}

TEST(MarschnerLobbField, HasItsGradientAndValues)
{
  const ReferenceField field = MakeMarschnerLobbField();
  EXPECT_DOUBLE_EQ(field.Evaluate({ 0.0, 0.0, 1.0 }), 0.25 * 2.0 / 2.5 - 0.5); // cos(12 pi) is 1
  EXPECT_DOUBLE_EQ(field.Evaluate({ 0.0, 0.0, -1.0 }), 0.5);
  for (const double x : { 0.1, 0.33, 0.9 })
  {
    Vector3 gradient;
    field.Evaluate({ x, 0.2, 0.3 }, gradient);
    EXPECT_NEAR(
      gradient[0], (field.Evaluate({ x + 1e-6, 0.2, 0.3 }) - field.Evaluate({ x - 1e-6, 0.2, 0.3 })) / 2e-6, 1e-4);
    EXPECT_NEAR(
      gradient[2], (field.Evaluate({ x, 0.2, 0.3 + 1e-6 }) - field.Evaluate({ x, 0.2, 0.3 - 1e-6 })) / 2e-6, 1e-4);
  }
}

TEST(CornerField, IsThreePlanes)
{
  const ReferenceField field = MakeCornerField(0.5);
  EXPECT_EQ(field.Evaluate({ 0.5, -1.0, 0.3 }), 0.0);
  EXPECT_EQ(field.Evaluate({ 0.1, 0.2, 0.75 }), -0.25);
  ExpectGradientMatchesDifferences(field);
}

TEST(BandLimitedField, HasItsGradient)
{
  ExpectGradientMatchesDifferences(MakeBandLimitedField(0.75, 3));
}

TEST(BandLimitedField, IsTheSameForTheSameSeedOnly)
{
  const Vector3 point{ 1.0, 2.0, 3.0 };
  EXPECT_EQ(MakeBandLimitedField(0.5, 3).Evaluate(point), MakeBandLimitedField(0.5, 3).Evaluate(point));
  EXPECT_NE(MakeBandLimitedField(0.5, 3).Evaluate(point), MakeBandLimitedField(0.5, 4).Evaluate(point));
}

TEST(BandLimitedField, HasMeanZeroAndVarianceOne)
{
  double sum = 0.0;
  double squares = 0.0;
  unsigned int count = 0;
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    const ReferenceField field = MakeBandLimitedField(0.5, seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(0.0, 200.0);
    for (unsigned int i = 0; i < 1000; ++i, ++count)
    {
      const double value = field.Evaluate({ coordinate(random), coordinate(random), coordinate(random) });
      sum += value;
      squares += value * value;
    }
  }
  EXPECT_NEAR(sum / count, 0.0, 0.03);
  EXPECT_NEAR(squares / count, 1.0, 0.03);
}

TEST(BandLimitedField, HasNothingBeyondItsLimit)
{
  // Along a line, the power at a frequency: a field of limit K has waves up to K / 2 per unit. The Hann window's
  // sidelobes are below 1e-6 a few bins on.
  constexpr double limit = 0.5;
  constexpr unsigned int length = 512;
  constexpr double pi = 3.141592653589793;
  const ReferenceField field = MakeBandLimitedField(limit, 11);
  const auto powerAt = [&](double frequency) {
    double real = 0.0;
    double imaginary = 0.0;
    for (unsigned int i = 0; i < length; ++i)
    {
      const double window = 0.5 - 0.5 * std::cos(2.0 * pi * i / length);
      const double value = window * field.Evaluate({ static_cast<double>(i), 0.5, 0.25 }) / length;
      real += value * std::cos(2.0 * pi * frequency * i);
      imaginary += value * std::sin(2.0 * pi * frequency * i);
    }
    return real * real + imaginary * imaginary;
  };
  double inside = 0.0;
  for (double frequency = 0.0; frequency < limit / 2.0; frequency += 1.0 / length)
  {
    inside = std::max(inside, powerAt(frequency));
  }
  for (double frequency = limit / 2.0 + 0.03; frequency < 0.5; frequency += 1.0 / length)
  {
    EXPECT_LT(powerAt(frequency), 1e-6 * inside) << frequency;
  }
  EXPECT_GT(powerAt(0.2) + powerAt(0.22) + powerAt(0.18), 1e-4 * inside) << "nothing near the limit either";
}

TEST(FieldSampling, GridAndLatticeHoldTheFieldAtTheirPoints)
{
  const ReferenceField field = MakeBandLimitedField(0.5, 3);
  const auto grid = SampleOnGrid<float>(field, 6, 1.5);
  EXPECT_FLOAT_EQ(grid->GetPixel({ { 2, 3, 5 } }), static_cast<float>(field.Evaluate({ 3.0, 4.5, 7.5 })));

  const auto lattice = SampleOnLattice<float>(field, 10.0, 0.5); // s = 1
  EXPECT_FLOAT_EQ(lattice->GetPixel({ { 2, 3, 4 } }), static_cast<float>(field.Evaluate({ 5.0, 3.0, 4.0 })));
  const auto & size = lattice->GetLargestPossibleRegion().GetSize();
  EXPECT_GE(2 * size[0] - 1, 11U);
  EXPECT_EQ(size[1], 11U);
  EXPECT_EQ(size[2], 11U);
}

TEST(FieldSampling, IntegersAreScaledAndRounded)
{
  const ReferenceField sphere = MakeSphereField({ 0.0, 0.0, 0.0 }, 5.0);
  const auto grid = SampleOnGrid<std::int16_t>(sphere, 3, 1.0, 10.0);
  EXPECT_EQ(grid->GetPixel({ { 1, 1, 0 } }), 36); // 50 - 14.14
}
