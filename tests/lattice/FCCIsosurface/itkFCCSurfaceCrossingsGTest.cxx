#include "detail/itkTriangleGrid.h"
#include "detail/itkTrianglesOfPoints.h"
#include "itkFCCIsosurfaceFilter.h"

#include "itkFCCScanBorder.h"
#include "itkFCCTestImages.h"
#include "itkTriangleSurfaceIntersections.h"

#include <gtest/gtest.h>

namespace
{

using fcctest::ImageType;
using Filter = itk::FCCIsosurfaceFilter<ImageType>;
using Mode = itk::FCCIsosurfaceMode;

/** Noise of values so different that points crowd at the ends of their edges, where rounding may make triangles cross.
 */
ImageType::Pointer
MakeUnevenNoise(unsigned int seed, double farthest, const ImageType::SizeType & size = { { 5, 8, 8 } })
{
  std::mt19937 random(seed);
  const auto image = ImageType::New();
  image->SetRegions(size);
  ImageType::SpacingType spacing;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    spacing[axis] = std::uniform_real_distribution<double>(0.4, seed % 2 == 0 ? 0.8 : 4.0)(random);
  }
  image->SetSpacing(spacing);
  ImageType::PointType origin;
  origin.Fill(farthest);
  image->SetOrigin(origin);
  image->Allocate();
  const int decades = 1 + static_cast<int>(seed % 7);
  std::uniform_int_distribution<int> power(0, decades);
  std::bernoulli_distribution isInside(0.5);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetLargestPossibleRegion()); !it.IsAtEnd(); ++it)
  {
    const int drawn = power(random);
    const double magnitude = drawn == 0 ? 0.0 : std::pow(10.0, drawn);
    it.Set(static_cast<float>(isInside(random) ? magnitude : -magnitude - 1e-3));
  }
  return image;
}

class FCCSurfaceCrossings : public testing::TestWithParam<Mode>
{};

itk::TriangleSurface::Pointer
Extract(ImageType * image, Mode mode)
{
  const auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetMode(mode);
  filter->SetIsovalue(0.0);
  filter->ComputeNormalsOff();
  filter->Update();
  return filter->GetOutput();
}

double
LongestRoundedEdge(const itk::TriangleSurface & surface, const ImageType & image)
{
  const auto & spacing = image.GetSpacing();
  return FindLongestRoundedEdge(
    surface, *std::min_element(spacing.Begin(), spacing.End()), *std::max_element(spacing.Begin(), spacing.End()));
}

/** A scan whose outermost samples are 0.2 to 1.6 samples inside of the lattice's ends. */
itk::ImageBase<3>::Pointer
MakeScanGrid(const ImageType & image, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> wall(0.2, 1.6);
  const auto low = itk::FindFCCOuterCorner(image, false), high = itk::FindFCCOuterCorner(image, true);
  constexpr unsigned int samples = 12;
  const auto scan = itk::ImageBase<3>::New();
  itk::ImageBase<3>::SpacingType spacing;
  itk::ImageBase<3>::PointType origin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double before = wall(random), after = wall(random);
    spacing[axis] = (high[axis] - low[axis]) / (samples - 1 + before + after);
    origin[axis] = low[axis] + before * spacing[axis];
  }
  scan->SetSpacing(spacing);
  scan->SetOrigin(origin);
  scan->SetRegions(itk::Size<3>{ { samples, samples, samples } });
  return scan;
}

/** Triangles in different tetrahedra cross at most where FindCrossingTriangles() looks: the search of all finds no
 * others. */
TEST_P(FCCSurfaceCrossings, OfPointsOnEdgesOfTetrahedraAreAtShortEdges)
{
  unsigned int crossing = 0;
  for (unsigned int seed = 0; seed < 250; ++seed)
  {
    const double farthest = seed % 3 == 0 ? 0.0 : std::pow(10.0, 1 + seed % 4);
    const auto image = MakeUnevenNoise(seed, farthest);
    const auto surface = Extract(image, GetParam());
    const itk::TrianglesOfPoints fans(*surface);
    const auto found = FindCrossingTriangles(itk::TriangleTree(*surface), fans);
    EXPECT_EQ(FindCrossingTriangles(*surface, fans, { LongestRoundedEdge(*surface, *image) }), found) << seed;
    const bool crosses = !found.empty();
    crossing += crosses ? 1 : 0;
    if (farthest == 0.0)
    {
      EXPECT_FALSE(crosses) << seed;
    }
  }
  EXPECT_GT(crossing, 0u) << "the test's own volumes";
}

/** The same once the walls were moved, which takes points off their edges. */
TEST_P(FCCSurfaceCrossings, OfMovedWallsAreNearThem)
{
  for (unsigned int seed = 0; seed < 60; ++seed)
  {
    const auto image = MakeUnevenNoise(seed, seed % 3 == 0 ? 0.0 : 1000.0, { { 9, 16, 16 } });
    const auto surface = Extract(image, GetParam());
    const auto scan = MakeScanGrid(*image, seed);
    const double longest = LongestRoundedEdge(*surface, *image);
    MoveFCCWallsToBorder(
      *surface, *scan, itk::FindFCCOuterCorner(*image, false), itk::FindFCCOuterCorner(*image, true));
    const auto & spacing = image->GetSpacing();
    const double margin = 3.0 * *std::max_element(spacing.Begin(), spacing.End());
    const itk::CrossingCandidates candidates{ longest, FindTrianglesNearFCCWalls(*surface, *scan, margin) };
    if (seed % 2 == 0)
    {
      EXPECT_LT(candidates.triangles.size(), surface->GetNumberOfTriangles()) << seed;
    }
    const itk::TrianglesOfPoints fans(*surface);
    EXPECT_EQ(FindCrossingTriangles(*surface, fans, candidates),
              FindCrossingTriangles(itk::TriangleTree(*surface), fans))
      << seed;
  }
}

/** In the other modes all triangles are searched: with a grid, which finds what a tree finds. */
TEST(FCCSurfaceCrossingsInAGrid, AreThoseOfATree)
{
  unsigned int crossing = 0;
  for (unsigned int seed = 0; seed < 150; ++seed)
  {
    const Mode mode = seed % 3 == 0 ? Mode::Lean : seed % 3 == 1 ? Mode::Octahedra : Mode::Parallelepipeds;
    const auto surface = Extract(MakeUnevenNoise(seed, seed % 4 == 0 ? 1000.0 : 0.0, { { 9, 14, 14 } }), mode);
    const itk::TrianglesOfPoints fans(*surface);
    const auto sizes = itk::TriangleSizes::Find(*surface);
    ASSERT_TRUE(sizes) << seed;
    const itk::TriangleGrid grid(*surface, *sizes, FindUnfoldedPoints(*surface, fans));
    rhombic::StagedProgress silent({});
    const auto found = FindCrossingTriangles(grid, silent, 1.0);
    EXPECT_EQ(found, FindCrossingTriangles(itk::TriangleTree(*surface), fans)) << seed;
    crossing += found.empty() ? 0 : 1;
  }
  EXPECT_GT(crossing, 30u) << "the test's own volumes";
}

INSTANTIATE_TEST_SUITE_P(All, FCCSurfaceCrossings, testing::Values(Mode::Tetrahedra, Mode::Fine));

} // namespace
