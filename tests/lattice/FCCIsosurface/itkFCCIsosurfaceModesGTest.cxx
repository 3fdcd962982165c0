#include "itkFCCIsosurfaceFilter.h"

#include "itkFCCTestImages.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace
{

using fcctest::ImageType;
using Filter = itk::FCCIsosurfaceFilter<ImageType>;
using Mode = itk::FCCIsosurfaceMode;
using Surface = itk::TriangleSurface;

Surface::Pointer
Extract(const ImageType * image,
        double isovalue,
        Mode mode,
        bool insideIsBelow = false,
        unsigned int workUnits = 2,
        bool closed = true)
{
  const auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetIsovalue(isovalue);
  filter->SetMode(mode);
  filter->SetInsideIsBelow(insideIsBelow);
  filter->SetClosed(closed);
  filter->SetNumberOfWorkUnits(workUnits);
  filter->Update();
  Surface::Pointer surface = filter->GetOutput();
  surface->DisconnectPipeline();
  return surface;
}

class FCCIsosurfaceModes : public testing::TestWithParam<Mode>
{};

// The hard cases at once: any size down to one sample, values equal to the isovalue, checkerboards, lone samples, thin
// walls, mirrored axes, values that are no numbers. Lean and Fine keep the topology of Tetrahedra.
TEST_P(FCCIsosurfaceModes, AThousandRandomVolumesAreWatertight)
{
  std::mt19937 random(3);
  const auto draw = [&random](unsigned int below) { return static_cast<unsigned int>(random() % below); };
  itk::SizeValueType triangles = 0;
  for (unsigned int trial = 0; trial < 1000; ++trial)
  {
    ImageType::RegionType region;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      region.SetIndex(axis, static_cast<itk::IndexValueType>(draw(7)) - 3);
      region.SetSize(axis, 1 + draw(axis == 0 && trial % 20 == 0 ? 140 : 9));
    }
    const int levels = 2 + static_cast<int>(draw(6));
    const auto image = fcctest::MakeNoise(region, trial, levels);
    const unsigned int kind = trial % 5;
    const unsigned int axis = draw(3);
    for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, region); !it.IsAtEnd(); ++it)
    {
      const auto & index = it.GetIndex();
      switch (kind)
      {
        case 0: // a checkerboard
          it.Set(static_cast<float>((index[0] + index[axis] + 8) % 2));
          break;
        case 1: // thin walls of unequal values
          it.Set((index[axis] + 8) % 3 == 0 ? it.Get() + 1.0f : 0.0f);
          break;
        case 2: // holes in what is known
          it.Set(draw(6) == 0 ? std::numeric_limits<float>::quiet_NaN() : it.Get());
          break;
        case 3: // fractions, so that crossings lie anywhere
          it.Set(it.Get() + 0.001f * static_cast<float>(draw(1000)));
          break;
        default:;
      }
    }
    if (draw(2) == 0)
    {
      ImageType::DirectionType mirror;
      mirror.SetIdentity();
      mirror[draw(3)][0] *= 1.0;
      mirror[2][2] = -1.0;
      image->SetDirection(mirror);
    }
    const double isovalue = kind == 0 ? 1.0 : static_cast<double>(draw(static_cast<unsigned int>(levels)));
    const bool below = draw(2) == 0;
    const auto surface = Extract(image, isovalue, GetParam(), below);
    const auto topology = ComputeTriangleSurfaceTopology(*surface);
    ASSERT_TRUE(topology.IsWatertight()) << "trial " << trial << ' ' << region << topology;
    ASSERT_EQ(topology.unusedPoints, 0u);
    triangles += surface->GetNumberOfTriangles();
    if (GetParam() == Mode::Fine || GetParam() == Mode::Lean)
    {
      const auto expected = ComputeTriangleSurfaceTopology(*Extract(image, isovalue, Mode::Tetrahedra, below));
      ASSERT_EQ(topology.components, expected.components) << "trial " << trial;
      ASSERT_EQ(topology.eulerCharacteristic, expected.eulerCharacteristic) << "trial " << trial;
    }
  }
  EXPECT_GT(triangles, 100000u);
}

TEST_P(FCCIsosurfaceModes, AnyNumberOfThreadsGivesTheSameBytes)
{
  const auto image = fcctest::MakeNoise({ { { -2, 1, 0 } }, { { 70, 40, 50 } } }, 7, 40);
  const auto one = Extract(image, 33.0, GetParam(), false, 1);
  for (const unsigned int threads : { 2, 3, 4, 7 })
  {
    const auto more = Extract(image, 33.0, GetParam(), false, threads);
    EXPECT_TRUE(one->GetPoints() == more->GetPoints());
    EXPECT_TRUE(one->GetNormals() == more->GetNormals());
    EXPECT_TRUE(one->GetTriangles() == more->GetTriangles());
  }
}

TEST_P(FCCIsosurfaceModes, AnyInstructionSetGivesTheSameBytes)
{
  const auto image = fcctest::MakeNoise({ { { 0, 0, 0 } }, { { 150, 20, 20 } } }, 8, 40);
  const auto expected = Extract(image, 31.0, GetParam());
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1)
  {
    const std::int64_t target = left & -left;
    hwy::SetSupportedTargetsForTest(target);
    const auto found = Extract(image, 31.0, GetParam());
    EXPECT_TRUE(expected->GetPoints() == found->GetPoints()) << hwy::TargetName(target);
    EXPECT_TRUE(expected->GetNormals() == found->GetNormals()) << hwy::TargetName(target);
    EXPECT_TRUE(expected->GetTriangles() == found->GetTriangles()) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST_P(FCCIsosurfaceModes, SeveralIsovaluesGiveTheSurfacesOfEach)
{
  const auto image = fcctest::MakeImage(0.7, 8.0, [](const auto & p) { return fcctest::Sphere(p, 6.0); });
  const std::vector<double> isovalues{ -1.0, 0.5, 2.25 };
  const auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetMode(GetParam());
  filter->SetIsovalues(isovalues);
  filter->Update();
  for (std::size_t n = 0; n < isovalues.size(); ++n)
  {
    const auto alone = Extract(image, isovalues[n], GetParam());
    EXPECT_TRUE(filter->GetOutput(n)->GetPoints() == alone->GetPoints());
    EXPECT_TRUE(filter->GetOutput(n)->GetNormals() == alone->GetNormals());
    EXPECT_TRUE(filter->GetOutput(n)->GetTriangles() == alone->GetTriangles());
  }
}

TEST_P(FCCIsosurfaceModes, NormalsAreUnitVectorsOutwardsOrAbsent)
{
  const auto image = fcctest::MakeImage(0.8, 12.0, [](const auto & p) { return fcctest::Sphere(p, 9.0); });
  const auto surface = Extract(image, 0.0, GetParam());
  ASSERT_TRUE(surface->HasNormals());
  for (itk::SizeValueType n = 0; n < surface->GetNumberOfPoints(); ++n)
  {
    const auto & point = surface->GetPoints()[n];
    const auto & normal = surface->GetNormals()[n];
    ASSERT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1.0, 1e-5);
    ASSERT_GT((point[0] * normal[0] + point[1] * normal[1] + point[2] * normal[2]) / 9.0, 0.99);
  }
  const auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetMode(GetParam());
  filter->ComputeNormalsOff();
  filter->Update();
  EXPECT_FALSE(filter->GetOutput()->HasNormals());
  EXPECT_TRUE(filter->GetOutput()->GetPoints() == surface->GetPoints());
}

/** Skin in a head scan of thick pixels: a ball's step, blurred less than the pixels are wide. */
ImageType::Pointer
MakeSharpStep()
{
  const auto image = ImageType::New();
  image->SetRegions(ImageType::SizeType{ { 24, 48, 90 } });
  image->Allocate();
  ImageType::SpacingType spacing;
  spacing[0] = 2.8;
  spacing[1] = 2.8;
  spacing[2] = 1.3;
  image->SetSpacing(spacing);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto point = image->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    const double distance = 50.0 - std::hypot(point[0] - 66.0, point[1] - 66.0, point[2] - 58.0);
    it.Set(static_cast<float>(500.0 + 500.0 * std::erf(distance / 1.2)));
  }
  return image;
}

using VectorType = itk::Vector<double, 3>;

/** A triangle's normal, twice its area long. */
VectorType
FacetOf(const Surface & surface, const Surface::TriangleType & triangle)
{
  VectorType edges[2];
  for (unsigned int end = 0; end < 2; ++end)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      edges[end][axis] = surface.GetPoints()[triangle[end + 1]][axis] - surface.GetPoints()[triangle[0]][axis];
    }
  }
  return itk::CrossProduct(edges[0], edges[1]);
}

/** The share of edges where the surface turns by more than a right angle. */
double
ComputeFoldedFraction(const Surface & surface)
{
  std::map<std::pair<unsigned int, unsigned int>, VectorType> facets; // by edge, of the first triangle there
  itk::SizeValueType folded = 0;
  for (const auto & triangle : surface.GetTriangles())
  {
    const VectorType facet = FacetOf(surface, triangle);
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      const auto [first, isFirst] =
        facets.emplace(std::minmax({ triangle[corner], triangle[(corner + 1) % 3] }), facet);
      folded += !isFirst && first->second * facet < 0.0 ? 1 : 0;
    }
  }
  return static_cast<double>(folded) / static_cast<double>(facets.size());
}

TEST_P(FCCIsosurfaceModes, NormalsAgreeWithTheTrianglesOnASharpStep)
{
  const auto surface = Extract(MakeSharpStep(), 850.5, GetParam());

  std::vector<VectorType> facets(surface->GetNumberOfPoints(), VectorType(0.0));
  for (const auto & triangle : surface->GetTriangles())
  {
    for (const auto corner : triangle)
    {
      facets[corner] += FacetOf(*surface, triangle);
    }
  }
  itk::SizeValueType against = 0;
  double cosines = 0.0;
  for (itk::SizeValueType n = 0; n < facets.size(); ++n)
  {
    const auto & normal = surface->GetNormals()[n];
    const double cosine =
      (normal[0] * facets[n][0] + normal[1] * facets[n][1] + normal[2] * facets[n][2]) / facets[n].GetNorm();
    against += cosine < 0.0 ? 1 : 0;
    cosines += cosine;
  }
  EXPECT_LE(against, facets.size() / 1000);
  EXPECT_GT(cosines / static_cast<double>(facets.size()), 0.9);
}

// Points of linear interpolation look like stairs there: along x, samples are further apart than along z.
TEST(FCCIsosurfaceOfASharpStep, HardlyFoldsInFineAndLean)
{
  const auto image = MakeSharpStep();
  for (const double isovalue : { 150.5, 500.5, 850.5 })
  {
    for (const Mode mode : { Mode::Fine, Mode::Lean })
    {
      EXPECT_LT(ComputeFoldedFraction(*Extract(image, isovalue, mode)), 0.005) << mode << " at " << isovalue;
    }
    EXPECT_GT(ComputeFoldedFraction(*Extract(image, isovalue, Mode::Tetrahedra)), 0.05) << isovalue;
  }
}

TEST_P(FCCIsosurfaceModes, UndefinedSamplesAreCounted)
{
  const auto image = fcctest::MakeNoise({ { { 0, 0, 0 } }, { { 5, 6, 7 } } }, 7, 4);
  image->SetPixel({ { 1, 2, 3 } }, std::numeric_limits<float>::quiet_NaN());
  image->SetPixel({ { 4, 5, 6 } }, std::numeric_limits<float>::quiet_NaN());
  const auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetMode(GetParam());
  filter->SetIsovalue(2.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfUndefinedSamples(), 2u);
}

TEST_P(FCCIsosurfaceModes, OpenSurfacesHaveManifoldEdges)
{
  const auto plane = fcctest::MakeImage(0.5, 4.0, [](const auto & p) { return 0.3 * p[0] + 0.5 * p[1] + p[2]; });
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*Extract(plane, 0.1, GetParam())).IsWatertight());
  const auto open = Extract(plane, 0.1, GetParam(), false, 2, false);
  EXPECT_GT(ComputeTriangleSurfaceTopology(*open).boundaryEdges, 0u);
  for (const auto & point : open->GetPoints())
  {
    ASSERT_NEAR(0.3 * point[0] + 0.5 * point[1] + point[2], 0.1, 0.002) << "on the plane, not on the border's faces";
  }

  std::mt19937 random(9);
  for (unsigned int trial = 0; trial < 100; ++trial)
  {
    const ImageType::RegionType region({ { 0, 0, 0 } }, { { 1 + random() % 8, 1 + random() % 8, 1 + random() % 8 } });
    const auto topology =
      ComputeTriangleSurfaceTopology(*Extract(fcctest::MakeNoise(region, trial, 3), 1.0, GetParam(), false, 2, false));
    ASSERT_EQ(topology.nonManifoldEdges + topology.misorientedEdges + topology.degenerateTriangles, 0u) << topology;
    ASSERT_EQ(topology.unusedPoints, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(
  All,
  FCCIsosurfaceModes,
  testing::Values(Mode::Tetrahedra, Mode::Octahedra, Mode::Parallelepipeds, Mode::Fine, Mode::Lean),
  testing::PrintToStringParamName());

} // namespace
