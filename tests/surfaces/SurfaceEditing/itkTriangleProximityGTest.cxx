#include "itkTriangleProximity.h"

#include "itkTriangleSurface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using Surface = itk::TriangleSurface;

constexpr std::uint32_t Side = 12; // points of the rough square

/** A rough square: points a unit apart, at random heights up to \a roughness. */
Surface::Pointer
MakeRoughSquare(double roughness, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> height(0.0f, static_cast<float>(roughness));
  const auto surface = Surface::New();
  for (std::uint32_t y = 0; y < Side; ++y)
  {
    for (std::uint32_t x = 0; x < Side; ++x)
    {
      surface->GetPoints().push_back({ static_cast<float>(x), static_cast<float>(y), height(random) });
    }
  }
  for (std::uint32_t y = 0; y + 1 < Side; ++y)
  {
    for (std::uint32_t x = 0; x + 1 < Side; ++x)
    {
      const std::uint32_t corner = x + y * Side;
      surface->GetTriangles().push_back({ corner, corner + 1, corner + Side });
      surface->GetTriangles().push_back({ corner + 1, corner + Side + 1, corner + Side });
    }
  }
  return surface;
}

/** A random triangle over the rough square; its first corner is \a longest from the border, and the others at most so
 * far from it along each axis. */
itk::CornersType
MakeTriangle(double longest, double highest, std::mt19937 & random)
{
  std::uniform_real_distribution<double> place(longest, Side - 1.0 - longest);
  std::uniform_real_distribution<double> step(-longest, longest);
  std::uniform_real_distribution<double> height(0.0, highest);
  const itk::PositionType first{ place(random), place(random), height(random) };
  itk::CornersType corners{ first, first, first };
  for (unsigned int corner = 1; corner < 3; ++corner)
  {
    corners[corner] = { first[0] + step(random), first[1] + step(random), height(random) };
  }
  return corners;
}

/** Expects the triangles of a proof to be within a distance of random points of the triangle. */
void
ExpectNear(const Surface & surface,
           const itk::ProximityProof & proof,
           const itk::CornersType & triangle,
           double distance,
           std::mt19937 & random)
{
  ASSERT_TRUE(proof.size > 0 && proof.IsComplete());
  const itk::TriangleTree some(surface, { proof.triangles.begin(), proof.triangles.begin() + proof.size });
  for (unsigned int sample = 0; sample < 100; ++sample)
  {
    const double a = std::sqrt(std::generate_canonical<double, 32>(random));
    const double b = std::generate_canonical<double, 32>(random);
    const itk::PositionType point = rhombic::Mix(triangle[0], rhombic::Mix(triangle[1], triangle[2], b), a);
    ASSERT_LE(some.FindClosestPoint(point).squaredDistance, distance * distance * (1.0 + 1e-9));
  }
}

TEST(TriangleProximity, TheTrianglesOfAProofAreEnough)
{
  std::mt19937 random(1);
  constexpr double distance = 0.25;
  unsigned int proofs = 0;
  unsigned int incomplete = 0;
  for (unsigned int n = 0; n < 2000; ++n)
  {
    const auto surface = MakeRoughSquare(0.3, n % 50);
    const itk::CornersType triangle = MakeTriangle(1.2, 0.3, random);
    const itk::TriangleTree tree(*surface);
    std::array<std::uint32_t, 3> likely{};
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      likely[corner] = tree.FindClosestPoint(triangle[corner]).triangle;
    }
    itk::ProximityProof proof;
    const bool isNear = itk::TriangleProximity(triangle, tree, distance, &proof).IsNearSurface(likely);
    EXPECT_EQ(isNear, itk::TriangleProximity(triangle, tree, distance).IsNearSurface(likely));
    incomplete += isNear && !proof.IsComplete() ? 1 : 0;
    if (!isNear || !proof.IsComplete())
    {
      continue;
    }
    ++proofs;
    ASSERT_NO_FATAL_FAILURE(ExpectNear(*surface, proof, triangle, distance, random)) << n;
  }
  EXPECT_GT(proofs, 500u);
  EXPECT_GT(incomplete, 0u);
}

TEST(TriangleProximity, FewTrianglesShowWhatTheSearchOfAllSays)
{
  std::mt19937 random(2);
  constexpr double distance = 0.25;
  unsigned int near = 0;
  for (unsigned int n = 0; n < 3000; ++n)
  {
    const auto surface = MakeRoughSquare(0.3, n % 50);
    const itk::CornersType triangle = MakeTriangle(1.6, 0.4, random);
    const itk::TriangleTree tree(*surface);
    itk::ProximityProof proof;
    itk::TriangleProximity proximity(triangle, tree, distance, &proof);
    EXPECT_FALSE(proximity.IsNearNearby());
    std::array<std::uint32_t, 3> likely{};
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      likely[corner] = tree.FindClosestPoint(triangle[corner]).triangle;
      proximity.GetNearby().Add(likely[corner], itk::CornersOf(*surface, surface->GetTriangles()[likely[corner]]));
    }
    if (!proximity.IsNearNearby())
    {
      continue;
    }
    ++near;
    ASSERT_TRUE(itk::TriangleProximity(triangle, tree, distance).IsNearSurface(likely)) << n;
    ASSERT_NO_FATAL_FAILURE(ExpectNear(*surface, proof, triangle, 0.9 * (1.0 - 1e-9) * distance, random)) << n;
  }
  EXPECT_GT(near, 300u);
}

} // namespace
