#include "itkFCCLattice.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace
{

using Lattice = itk::FCCLattice;
using Site = Lattice::SiteType;

double
SquaredDistance(const std::array<double, 3> & point, const Site & site)
{
  double sum = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double difference = point[axis] - static_cast<double>(site[axis]);
    sum += difference * difference;
  }
  return sum;
}

/** All sites within a cube around the origin. */
std::vector<Site>
SitesNearOrigin(itk::IndexValueType radius)
{
  std::vector<Site> sites;
  for (itk::IndexValueType z = -radius; z <= radius; ++z)
  {
    for (itk::IndexValueType y = -radius; y <= radius; ++y)
    {
      for (itk::IndexValueType x = -radius; x <= radius; ++x)
      {
        if (Lattice::IsSite({ x, y, z }))
        {
          sites.push_back({ x, y, z });
        }
      }
    }
  }
  return sites;
}

TEST(FCCLattice, NeighborsAreExactlyTheNearestSites)
{
  std::set<Site> nearest;
  for (const Site & site : SitesNearOrigin(3))
  {
    const double squared = SquaredDistance({ 0, 0, 0 }, site);
    if (squared == 2.0)
    {
      nearest.insert(site);
    }
    EXPECT_TRUE(squared == 0.0 || squared >= 2.0) << "no site is nearer than the nearest neighbours";
  }
  EXPECT_EQ(nearest, std::set<Site>(Lattice::NearestNeighbors.begin(), Lattice::NearestNeighbors.end()));
}

TEST(FCCLattice, NeighborsSumToEightTimesTheIdentity)
{
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int column = 0; column < 3; ++column)
    {
      itk::IndexValueType sum = 0;
      for (const Site & d : Lattice::NearestNeighbors)
      {
        sum += d[row] * d[column];
      }
      EXPECT_EQ(sum, row == column ? 8 : 0);
    }
  }
}

// Layers (a, a, a / sqrt 2) stored with half that distance between them would be body-centered cubic: eight nearest
// neighbours instead of twelve.
TEST(FCCLattice, IsFaceCenteredNotBodyCentered)
{
  EXPECT_EQ(Lattice::NearestNeighbors.size(), 12u);
  EXPECT_TRUE(Lattice::IsSite({ 1, 1, 0 }));
  EXPECT_FALSE(Lattice::IsSite({ 1, 1, 1 }));
}

TEST(FCCLattice, EachNearestNeighborEdgeAndRowEdgeHasOneOwner)
{
  std::set<Site> directions;
  for (const Site & edge : Lattice::OwnedEdges)
  {
    EXPECT_TRUE(directions.insert(edge).second);
    EXPECT_TRUE(directions.insert({ -edge[0], -edge[1], -edge[2] }).second);
  }
  std::set<Site> expected(Lattice::NearestNeighbors.begin(), Lattice::NearestNeighbors.end());
  expected.insert({ { 2, 0, 0 }, { -2, 0, 0 } });
  EXPECT_EQ(directions, expected);
}

TEST(FCCLattice, IndexAndSiteAreInverse)
{
  for (const Site & site : SitesNearOrigin(4))
  {
    EXPECT_EQ(Lattice::SiteOf(Lattice::IndexOf(site)), site);
  }
  const itk::Index<3> index{ { -3, 5, -2 } };
  EXPECT_EQ(Lattice::IndexOf(Lattice::SiteOf(index)), index);
}

TEST(FCCLattice, OffsetsOfStepsAgreeWithSites)
{
  for (const itk::Index<3> index :
       { itk::Index<3>{ { 4, 0, 0 } }, itk::Index<3>{ { -4, 1, 0 } }, itk::Index<3>{ { 0, -3, 2 } } })
  {
    const Site site = Lattice::SiteOf(index);
    for (const Site & step : Lattice::NearestNeighbors)
    {
      const Site neighbor{ site[0] + step[0], site[1] + step[1], site[2] + step[2] };
      EXPECT_EQ(index + Lattice::OffsetOf(step, Lattice::Parity(index[1], index[2])), Lattice::IndexOf(neighbor));
    }
  }
}

TEST(FCCLattice, NearestSiteAgreesWithBruteForce)
{
  const auto sites = SitesNearOrigin(4);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-2.0, 2.0);
  for (int trial = 0; trial < 2000; ++trial)
  {
    const std::array<double, 3> point{ coordinate(random), coordinate(random), coordinate(random) };
    double nearest = 1e9;
    for (const Site & site : sites)
    {
      nearest = std::min(nearest, SquaredDistance(point, site));
    }
    const Site found = Lattice::NearestSite(point);
    EXPECT_TRUE(Lattice::IsSite(found));
    EXPECT_NEAR(SquaredDistance(point, found), nearest, 1e-12);
  }
}

TEST(FCCLattice, VoronoiCellsShareSpaceEqually)
{
  // The fraction of points nearest to the origin, out of a box with a known number of sites per volume.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-2.0, 2.0);
  constexpr int trials = 200000;
  int mine = 0;
  for (int trial = 0; trial < trials; ++trial)
  {
    mine += Lattice::NearestSite({ coordinate(random), coordinate(random), coordinate(random) }) == Site{ 0, 0, 0 };
  }
  EXPECT_NEAR(64.0 * mine / trials, Lattice::CellVolume, 0.03);
}

TEST(FCCLattice, NyquistDensityIsThatOfEqualBalls)
{
  EXPECT_DOUBLE_EQ(Lattice::NyquistDensity, 4.0 / (3.0 * std::sqrt(3.0)));
  // The reciprocal lattice of D3 with unit s is body-centered with nearest neighbours at sqrt(3) / 2; at density rho
  // its nearest neighbours must be as far as those of the reciprocal of the unit Cartesian grid.
  const double s = std::cbrt(1.0 / (2.0 * Lattice::NyquistDensity));
  EXPECT_NEAR(std::sqrt(3.0) / 2.0 / s, 1.0, 1e-12);
}

} // namespace
