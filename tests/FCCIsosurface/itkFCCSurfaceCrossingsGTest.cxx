#include "itkFCCIsosurfaceFilter.h"

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
MakeUnevenNoise(unsigned int seed, double farthest)
{
  std::mt19937 random(seed);
  const auto image = ImageType::New();
  image->SetRegions(ImageType::SizeType{ { 5, 8, 8 } });
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

/** Triangles in different tetrahedra cross at most where FindCrossingTrianglesAtEdges() looks: the audit finds no
 * others. */
TEST_P(FCCSurfaceCrossings, OfPointsOnEdgesOfTetrahedraAreAtShortEdges)
{
  unsigned int crossing = 0;
  for (unsigned int seed = 0; seed < 250; ++seed)
  {
    const double farthest = seed % 3 == 0 ? 0.0 : std::pow(10.0, 1 + seed % 4);
    const auto image = MakeUnevenNoise(seed, farthest);
    const auto filter = Filter::New();
    filter->SetInput(image);
    filter->SetMode(GetParam());
    filter->SetIsovalue(0.0);
    filter->ComputeNormalsOff();
    filter->Update();
    const itk::TriangleSurface & surface = *filter->GetOutput();
    const auto & spacing = image->GetSpacing();
    const double longest = FindLongestRoundedEdge(
      surface, std::min({ spacing[0], spacing[1], spacing[2] }), std::max({ spacing[0], spacing[1], spacing[2] }));
    const auto found = FindCrossingTriangles(itk::TriangleTree(surface));
    EXPECT_EQ(FindCrossingTrianglesAtEdges(surface, longest), found) << seed;
    const bool crosses = !found.empty();
    crossing += crosses ? 1 : 0;
    if (farthest == 0.0)
    {
      EXPECT_FALSE(crosses) << seed;
    }
  }
  EXPECT_GT(crossing, 0u) << "the test's own volumes";
}

INSTANTIATE_TEST_SUITE_P(All, FCCSurfaceCrossings, testing::Values(Mode::Tetrahedra, Mode::Fine));

} // namespace
