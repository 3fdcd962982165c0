#include "rhombicProjection.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <new>
#include <random>

namespace
{

using rhombic::Dot;
using rhombic::Projection;
using rhombic::Vector3;

TEST(Projection, HasNoUnsetNumbers)
{
  alignas(Projection) std::array<unsigned char, sizeof(Projection)> memory;
  memory.fill(0xff);
  const auto * const projection = new (memory.data()) Projection;
  EXPECT_EQ(projection->centre, Vector3{});
  EXPECT_EQ(projection->frame.look, Vector3{});
}

TEST(Projection, LettersOfObliqueDirectionsNameTheLargestComponentFirst)
{
  EXPECT_EQ(rhombic::LettersOf({ 1, 0, 0 }), "L");
  EXPECT_EQ(rhombic::LettersOf({ -2, 0, 0 }), "R");
  EXPECT_EQ(rhombic::LettersOf({ 0.2, -1, 0 }), "A");
  EXPECT_EQ(rhombic::LettersOf({ 0.5, -0.8, 0.3 }), "ALH");
  EXPECT_EQ(rhombic::LettersOf({ 0, 1, -1 }), "PF");
}

TEST(Projection, PositionsAndPointsAreInverse)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-200.0, 200.0);
  const double angle = 0.3;
  Projection projection;
  projection.frame.look = { std::sin(angle), std::cos(angle), 0.0 };
  projection.frame.up = { 0.0, 0.0, 1.0 };
  projection.frame.right = rhombic::Cross(projection.frame.look, projection.frame.up);
  projection.centre = { 10.0, -20.0, 30.0 };
  projection.pixelSize = 0.7;
  projection.width = 300;
  projection.height = 200;
  const auto middle = projection.PositionOf(projection.centre);
  EXPECT_DOUBLE_EQ(middle.x, 150.0);
  EXPECT_DOUBLE_EQ(middle.y, 100.0);
  for (int n = 0; n < 100; ++n)
  {
    const Vector3 point{ coordinate(random), coordinate(random), coordinate(random) };
    const auto position = projection.PositionOf(point);
    const Vector3 seen = projection.PointAt(position);
    const Vector3 difference{ point[0] - seen[0], point[1] - seen[1], point[2] - seen[2] };
    // The point that is seen lies before or behind the point, along the look direction.
    EXPECT_NEAR(Dot(difference, projection.frame.up), 0.0, 1e-9);
    EXPECT_NEAR(Dot(difference, projection.frame.right), 0.0, 1e-9);
  }
}

} // namespace
