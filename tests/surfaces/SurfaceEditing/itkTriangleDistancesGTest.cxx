#include "itkTriangleDistances.h"

#include "detail/itkClosestOnTriangle.h"

#include <gtest/gtest.h>

#include <random>

TEST(FanDistances, NearestTrianglesAreThoseOfASearchOneByOne)
{
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto position = [&] { return itk::PositionType{ normal(random), normal(random), normal(random) }; };
  itk::FanDistances distances;
  std::vector<std::uint16_t> numbers;
  for (int fan = 0; fan < 500; ++fan)
  {
    const std::size_t witnesses = random() % 20;
    std::vector<std::pair<itk::PositionType, std::uint32_t>> all; // with their sheets
    distances.Begin(witnesses);
    for (std::size_t n = 0; n < witnesses; ++n)
    {
      all.emplace_back(position(), random() % 2);
      distances.SetWitness(n, all.back().first, all.back().second);
    }
    std::vector<std::pair<itk::CornersType, std::uint32_t>> triangles;
    for (std::size_t n = 0; n < 12; ++n)
    {
      const itk::PositionType b = position();
      const bool isFlat = random() % 4 == 0;
      const itk::PositionType c =
        isFlat ? itk::Scaled(b, random() % 3) : position(); // also without a side, or with two
      triangles.push_back({ { itk::PositionType{}, b, c }, static_cast<std::uint32_t>(n % 2) });
      distances.AddTriangle(b, c, triangles.back().second);
    }
    double farthest = 0.0;
    distances.FindNearest(1.0, numbers);
    ASSERT_EQ(numbers.size(), witnesses);
    for (std::size_t n = 0; n < witnesses; ++n)
    {
      const auto & [witness, sheet] = all[n];
      const auto distanceFrom = [&, &witness = witness](const itk::CornersType & corners) {
        return itk::SquaredDistance(witness, itk::ClosestOnTriangle(witness, corners));
      };
      double least = std::numeric_limits<double>::infinity();
      for (const auto & [corners, ownSheet] : triangles)
      {
        least = ownSheet == sheet ? std::min(least, distanceFrom(corners)) : least;
      }
      ASSERT_EQ(triangles[numbers[n]].second, sheet);
      ASSERT_NEAR(distanceFrom(triangles[numbers[n]].first), least, 1e-11);
      farthest = std::max(farthest, least);
    }
    EXPECT_TRUE(distances.FindNearest(1.0001 * farthest + 1e-11, numbers));
    EXPECT_TRUE(witnesses == 0 || !distances.FindNearest(0.9999 * farthest - 1e-11, numbers));
  }
}

TEST(FanDistances, AWitnessWithoutATriangleOfItsSheetIsFar)
{
  itk::FanDistances distances;
  std::vector<std::uint16_t> numbers;
  distances.Begin(1);
  distances.SetWitness(0, {}, 1);
  distances.AddTriangle({ 1, 0, 0 }, { 0, 1, 0 }, 0);
  EXPECT_FALSE(distances.FindNearest(1e9, numbers));
}

TEST(FanDistances, TrianglesWhoseNumbersHaveNoRoomAreRefused)
{
  itk::FanDistances distances;
  std::vector<std::uint16_t> numbers;
  distances.Begin(1);
  distances.SetWitness(0, { 0.2, 0.2, 0.5 }, 0);
  for (std::size_t n = 1; n < itk::FanDistances::MostTriangles; ++n)
  {
    distances.AddTriangle({ -1, 0, 0 }, { 0, -1, 0 }, 0);
  }
  distances.AddTriangle({ 1, 0, 0 }, { 0, 1, 0 }, 0); // the nearest, the last with a number
  ASSERT_TRUE(distances.FindNearest(0.26, numbers));
  EXPECT_EQ(numbers[0], itk::FanDistances::MostTriangles - 1);
  distances.AddTriangle({ 1, 0, 0 }, { 0, 1, 0 }, 0);
  EXPECT_FALSE(distances.FindNearest(0.26, numbers));
}

TEST(NearestPoints, AreThoseOfASearchOneByOne)
{
  std::mt19937 random(7);
  std::uniform_int_distribution<int> place(0, 4); // many points are equally near
  const auto position = [&] { return itk::PositionType{ 1.0 * place(random), 1.0 * place(random), 0.0 }; };
  itk::NearestPoints nearest;
  for (int round = 0; round < 200; ++round)
  {
    std::vector<itk::PositionType> points(1 + random() % 20), samples(random() % 20);
    std::generate(points.begin(), points.end(), position);
    std::generate(samples.begin(), samples.end(), position);
    nearest.Clear();
    std::for_each(points.begin(), points.end(), [&](const auto & point) { nearest.AddPoint(point); });
    std::for_each(samples.begin(), samples.end(), [&](const auto & sample) { nearest.AddSample(sample); });
    nearest.Find();
    for (std::size_t n = 0; n < samples.size(); ++n)
    {
      const auto first = std::min_element(points.begin(), points.end(), [&](const auto & a, const auto & b) {
        return itk::SquaredDistance(a, samples[n]) < itk::SquaredDistance(b, samples[n]);
      });
      ASSERT_EQ(nearest.GetPoint(n), static_cast<std::size_t>(first - points.begin()));
      ASSERT_EQ(nearest.GetSquaredDistance(n), itk::SquaredDistance(*first, samples[n]));
    }
  }
}

TEST(NearbyTriangles, TheNearestIsThatOfASearchOneByOne)
{
  std::mt19937 random(6);
  std::normal_distribution<double> normal(100.0, 1.0);
  const auto position = [&] { return itk::PositionType{ normal(random), normal(random), normal(random) }; };
  itk::NearbyTriangles nearby;
  std::vector<itk::CornersType> triangles;
  EXPECT_TRUE(nearby.IsEmpty());
  for (std::uint32_t n = 0; n < itk::NearbyTriangles::Capacity; ++n)
  {
    const itk::PositionType a = position(), b = position();
    triangles.push_back({ a, b, n % 5 == 0 ? itk::Mix(a, b, 0.3) : position() }); // some are flat
    ASSERT_TRUE(nearby.Add(1000 + n, triangles.back()));
    const itk::PositionType from = position();
    double least = std::numeric_limits<double>::infinity();
    for (const itk::CornersType & corners : triangles)
    {
      least = std::min(least, itk::SquaredDistance(from, itk::ClosestOnTriangle(from, corners)));
    }
    const auto nearest = nearby.FindNearest(from);
    ASSERT_NEAR(nearest.squaredDistance, least, 1e-11);
    ASSERT_NEAR(
      itk::SquaredDistance(from, itk::ClosestOnTriangle(from, triangles[nearest.triangle - 1000])), least, 1e-11);
    const double limit = std::uniform_real_distribution<double>(0.0, 4.0)(random);
    const auto within = nearby.FindWithin(limit, from);
    for (std::size_t k = 0; k < within.size(); ++k)
    {
      const double squared = k <= n ? itk::SquaredDistance(from, itk::ClosestOnTriangle(from, triangles[k])) : 1e9;
      ASSERT_TRUE(within[k] ? squared <= limit + 1e-11 : squared >= limit - 1e-11) << k << " of " << n + 1;
    }
  }
  EXPECT_FALSE(nearby.Add(0, triangles.front()));
}
