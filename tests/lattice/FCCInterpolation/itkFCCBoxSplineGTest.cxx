#include "detail/itkFCCBoxSpline.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace
{

using itk::FCCBoxSpline;
using Point = FCCBoxSpline::PointType;
using Site = itk::FCCLattice::SiteType;

Point
Subtract(const Point & point, const Site & site)
{
  return { point[0] - static_cast<double>(site[0]),
           point[1] - static_cast<double>(site[1]),
           point[2] - static_cast<double>(site[2]) };
}

Point
Random(std::mt19937 & random, double reach)
{
  std::uniform_real_distribution<double> coordinate(-reach, reach);
  return { coordinate(random), coordinate(random), coordinate(random) };
}

/** phi and its gradient: the spline whose coefficient is 1 at the site 0 and 0 at all others. */
FCCBoxSpline::Jet
Evaluate(const Point & point)
{
  const FCCBoxSpline::Piece piece = FCCBoxSpline::FindPiece(point);
  std::array<double, FCCBoxSpline::SupportSize> coefficients{};
  for (unsigned int n = 0; n < FCCBoxSpline::SupportSize; ++n)
  {
    coefficients[n] = piece.sites[n] == Site{ 0, 0, 0 } ? 1.0 : 0.0;
  }
  return FCCBoxSpline::MakeCubic(piece, coefficients).GetJet(point);
}

double
ValueAt(const Point & point)
{
  return Evaluate(point).value;
}

/** The pieces as the literature lists them, for x >= y >= z >= 0; the first that matches. */
double
Piece(double x, double y, double z)
{
  const double x2 = x * x;
  const double y2 = y * y;
  const double z2 = z * z;
  const double x3 = x2 * x;
  const double y3 = y2 * y;
  const double z3 = z2 * z;
  if (x + y + z >= 3.0 || x >= 2.0)
  {
    return 0.0;
  }
  if (x + y + z <= 1.0)
  {
    return 12 - 12 * (x2 + y2 + z2) + 4 * (x3 + y3 + z3);
  }
  if (x + y - z <= 1.0)
  {
    return 15 - 6 * (x + y + z) - 9 * (x2 + y2 + z2) + 6 * (x * y + y * z + z * x) + 4 * (x3 + y3 + z3);
  }
  if (x <= 1.0 && x - y + z <= 1.0)
  {
    return 19 - 9 * z2 + 2 * z3 - 15 * y + 3 * y * z2 - 3 * y2 + 3 * y3 - 15 * x + 3 * x * z2 + 18 * x * y -
           3 * x * y2 - 3 * x2 - 3 * x2 * y + 3 * x3;
  }
  if (y > 1.0)
  {
    return 27 - 9 * z2 + 2 * z3 - 27 * y + 3 * y * z2 + 9 * y2 - y3 - 27 * x + 3 * x * z2 + 18 * x * y - 3 * x * y2 +
           9 * x2 - 3 * x2 * y - x3;
  }
  if (x - y + z <= 1.0)
  {
    return 23 - 9 * z2 + 2 * z3 - 15 * y + 3 * y * z2 - 3 * y2 + 3 * y3 - 27 * x + 3 * x * z2 + 18 * x * y -
           3 * x * y2 + 9 * x2 - 3 * x2 * y - x3;
  }
  if (x - y - z <= 1.0)
  {
    return 27 - 9 * z - 3 * z2 + z3 - 9 * y - 6 * y * z + 3 * y * z2 - 3 * y2 + 3 * y2 * z + y3 - 36 * x + 12 * x * z +
           12 * x * y + 15 * x2 - 3 * x2 * z - 3 * x2 * y - 2 * x3;
  }
  return 4 * (2 - x) * (2 - x) * (2 - x);
}

TEST(FCCBoxSpline, HasItsKnownValues)
{
  EXPECT_DOUBLE_EQ(ValueAt({ 0, 0, 0 }), 1.0 / 2.0);
  for (const Site & neighbor : itk::FCCLattice::NearestNeighbors)
  {
    EXPECT_DOUBLE_EQ(ValueAt(Subtract({ 0, 0, 0 }, neighbor)), 1.0 / 24.0);
  }
  EXPECT_EQ(ValueAt({ 2, 0, 0 }), 0.0);
  EXPECT_DOUBLE_EQ(ValueAt({ 0, -1, 0 }), 1.0 / 6.0) << "the middle of an octahedron";
  EXPECT_DOUBLE_EQ(ValueAt({ 0.5, -0.5, 0.5 }), 7.0 / 32.0) << "the middle of a tetrahedron";
}

TEST(FCCBoxSpline, IsThePiecesOfTheLiteratureJoined)
{
  std::mt19937 random(1);
  for (int trial = 0; trial < 100000; ++trial)
  {
    Point point = Random(random, 2.2);
    const double value = ValueAt(point);
    for (double & coordinate : point)
    {
      coordinate = std::abs(coordinate);
    }
    std::sort(point.begin(), point.end());
    ASSERT_NEAR(value, Piece(point[2], point[1], point[0]) / 24.0, 1e-14);
  }
}

// The definition: the density of a point that moves along six segments at once, twice over for the sites' volume.
// Three segments make a box, which is integrated here over the other three.
TEST(FCCBoxSpline, IsTheProjectionOfACube)
{
  constexpr int steps = 100;
  std::mt19937 random(2);
  for (int trial = 0; trial < 10; ++trial)
  {
    const Point point = Random(random, 1.4);
    int hits = 0;
    for (int a = 0; a < steps; ++a)
    {
      for (int b = 0; b < steps; ++b)
      {
        for (int c = 0; c < steps; ++c)
        {
          const auto at = [](int n) { return (n + 0.5) / steps - 0.5; };
          // Less (1, -1, 0), (1, 0, -1) and (1, 1, 0); the rest in terms of (0, 1, 1), (1, 0, 1) and (0, 1, -1).
          const double x = point[0] - at(a) - at(b) - at(c);
          const double y = point[1] + at(a) - at(c);
          const double z = point[2] + at(b);
          const double first = (y + z - x) / 2.0;
          const double last = y - first;
          hits += std::abs(x) <= 0.5 && std::abs(first) <= 0.5 && std::abs(last) <= 0.5 ? 1 : 0;
        }
      }
    }
    EXPECT_NEAR(ValueAt(point), hits / std::pow(steps, 3), 0.005);
  }
}

TEST(FCCBoxSpline, GradientIsThatOfTheValueAndContinuous)
{
  std::mt19937 random(3);
  for (int trial = 0; trial < 50000; ++trial)
  {
    Point point = Random(random, 2.2);
    if (trial % 3 == 0)
    {
      point[0] = std::round(point[0]); // on the borders of pieces
    }
    if (trial % 5 == 0)
    {
      point[1] = std::round(point[0] + point[2]) - point[0] - point[2];
    }
    const auto jet = Evaluate(point);
    constexpr double step = 1e-5;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      Point ahead = point;
      Point behind = point;
      ahead[axis] += step;
      behind[axis] -= step;
      ASSERT_NEAR(jet.gradient[axis], (ValueAt(ahead) - ValueAt(behind)) / (2.0 * step), 1e-5);
      // Second derivatives are bounded: no jumps in the first ones.
      const auto next = Evaluate(ahead);
      for (unsigned int component = 0; component < 3; ++component)
      {
        ASSERT_NEAR(next.gradient[component], jet.gradient[component], 3.0 * step);
      }
    }
  }
}

// phi itself is evaluated through one coefficient at a time; here are all 16.
TEST(FCCBoxSpline, CubicsAreSumsOfShiftedBoxSplines)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coefficient(-1.0, 1.0);
  for (int trial = 0; trial < 5000; ++trial)
  {
    const Point point = Random(random, 3.0);
    const auto piece = FCCBoxSpline::FindPiece(point);
    std::array<double, FCCBoxSpline::SupportSize> coefficients;
    FCCBoxSpline::Jet expected;
    for (unsigned int n = 0; n < coefficients.size(); ++n)
    {
      coefficients[n] = coefficient(random);
      const auto jet = Evaluate(Subtract(point, piece.sites[n]));
      expected.value += coefficients[n] * jet.value;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        expected.gradient[axis] += coefficients[n] * jet.gradient[axis];
      }
    }
    const auto cubic = FCCBoxSpline::MakeCubic(piece, coefficients);
    ASSERT_NEAR(cubic.GetValue(point), expected.value, 1e-13);
    ASSERT_EQ(cubic.GetValue(point), cubic.GetJet(point).value);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      ASSERT_NEAR(cubic.GetJet(point).gradient[axis], expected.gradient[axis], 1e-13);
    }
  }
}

TEST(FCCBoxSpline, SupportHoldsEverySiteThatReachesThePoint)
{
  std::mt19937 random(4);
  for (int trial = 0; trial < 20000; ++trial)
  {
    Point point = Random(random, 3.0);
    const bool isGeneric = trial % 4 != 0;
    if (!isGeneric) // on the borders of supports
    {
      for (double & coordinate : point)
      {
        coordinate = random() % 2 == 0 ? std::round(2.0 * coordinate) / 2.0 : coordinate;
      }
    }
    const auto support = FCCBoxSpline::FindPiece(point).sites;
    const std::set<Site> sites(support.begin(), support.end());
    ASSERT_EQ(sites.size(), 16u);
    double sum = 0.0;
    for (itk::IndexValueType z = -6; z <= 6; ++z)
    {
      for (itk::IndexValueType y = -6; y <= 6; ++y)
      {
        for (itk::IndexValueType x = -6; x <= 6; ++x)
        {
          const Site site{ x, y, z };
          const double value = itk::FCCLattice::IsSite(site) ? ValueAt(Subtract(point, site)) : 0.0;
          if (sites.count(site) == 0)
          {
            ASSERT_NEAR(value, 0.0, isGeneric ? 0.0 : 1e-15) << x << ' ' << y << ' ' << z;
          }
          else
          {
            ASSERT_TRUE(itk::FCCLattice::IsSite(site));
            ASSERT_GE(value, -1e-15);
          }
          sum += value;
        }
      }
    }
    ASSERT_NEAR(sum, 1.0, 1e-14) << "partition of unity";
  }
}

} // namespace
