#include "rhombicReferenceField.h"
#include "rhombicFieldSampling.h"
#include "rhombicShapeFields.h"
#include "rhombicSurfaceErrors.h"
#include "rhombicExtractSurface.h"

#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

using namespace rhombic;

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
const SurfaceErrorSettings everywhere{ { -infinity, -infinity, -infinity }, { infinity, infinity, infinity }, 1.0 };

/** A sphere around the origin from an octahedron whose triangles are cut into four again and again, with exact normals.
 */
itk::TriangleSurface::Pointer
MakeSphere(double radius, unsigned int cuts)
{
  using Triangle = itk::TriangleSurface::TriangleType;
  std::vector<Vector3> points{ { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
  std::vector<Triangle> triangles{ { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 },
                                   { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 }, { 0, 3, 5 } };
  for (unsigned int cut = 0; cut < cuts; ++cut)
  {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, isNew] = middles.emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (isNew)
      {
        Vector3 point;
        double squared = 0.0;
        for (unsigned int i = 0; i < 3; ++i)
        {
          point[i] = points[a][i] + points[b][i];
          squared += point[i] * point[i];
        }
        for (double & component : point)
        {
          component /= std::sqrt(squared);
        }
        points.push_back(point);
      }
      return found->second;
    };
    std::vector<Triangle> finer;
    for (const auto & [a, b, c] : triangles)
    {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), { { a, ab, ca }, { ab, b, bc }, { ca, bc, c }, { ab, bc, ca } });
    }
    triangles = finer;
  }
  auto surface = itk::TriangleSurface::New();
  for (const Vector3 & p : points)
  {
    const auto scaled = [&p](double scale) {
      return std::array<float, 3>{ static_cast<float>(scale * p[0]),
                                   static_cast<float>(scale * p[1]),
                                   static_cast<float>(scale * p[2]) };
    };
    surface->GetPoints().push_back(scaled(radius));
    surface->GetNormals().push_back(scaled(1.0));
  }
  surface->GetTriangles().assign(triangles.begin(), triangles.end());
  return surface;
}

} // namespace

TEST(FieldProjection, FindsTheNearestPointOfShapes)
{
  const ReferenceField torus = MakeTorusField({ 0, 0, 0 }, { 0, 0, 1 }, 10.0, 4.0);
  const FieldProjection outside = ProjectOntoField(torus, { 0.0, 10.0, 4.7 });
  EXPECT_TRUE(outside.isResolved);
  EXPECT_NEAR(outside.distance, 0.7, 1e-9);
  EXPECT_NEAR(outside.point[2], 4.0, 1e-9);
  EXPECT_NEAR(outside.normal[2], 1.0, 1e-9);
  EXPECT_NEAR(ProjectOntoField(torus, { 0.0, 13.5, 0.0 }).distance, 0.5, 1e-9);
}

TEST(FieldProjection, EndsOnTheSurfaceStraightBelowThePoint)
{
  const ReferenceField field = MakeBandLimitedField(0.75, 5);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(0.0, 40.0);
  unsigned int resolved = 0;
  unsigned int near = 0;
  for (unsigned int i = 0; i < 2000; ++i)
  {
    const Vector3 point{ coordinate(random), coordinate(random), coordinate(random) };
    const FieldProjection projection = ProjectOntoField(field, point);
    if (projection.distance > 0.2)
    {
      continue;
    }
    ++near;
    if (projection.isResolved)
    {
      ++resolved;
      EXPECT_NEAR(field.Evaluate(projection.point), 0.0, 1e-3);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const double offset = std::abs(point[axis] - projection.point[axis]);
        EXPECT_NEAR(offset, projection.distance * std::abs(projection.normal[axis]), 1e-3);
      }
    }
  }
  EXPECT_GT(near, 100U);
  EXPECT_EQ(resolved, near);
}

TEST(FieldProjection, FindsTheSurfaceFromWhereThereIsNoGradient)
{
  const FieldProjection projection = ProjectOntoField(MakeSphereField({ 0, 0, 0 }, 2.0), { 0, 0, 0 });
  EXPECT_TRUE(projection.isResolved);
  EXPECT_NEAR(projection.distance, 2.0, 1e-3);
}

TEST(FieldProjection, SaysWhereNoSurfaceIsNear)
{
  const FieldProjection projection = ProjectOntoField(MakeSphereField({ 0, 0, 0 }, 4.0), { 0, 0, 0 });
  EXPECT_FALSE(projection.isResolved);
  EXPECT_EQ(projection.distance, 3.0);
}

TEST(FieldProjection, IsNeverFartherThanTheSurfaceAlongAnyAxis)
{
  const ReferenceField field = MakeBandLimitedField(0.75, 8);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> coordinate(0.0, 40.0);
  for (unsigned int i = 0; i < 500; ++i)
  {
    const Vector3 point{ coordinate(random), coordinate(random), coordinate(random) };
    const double distance = ProjectOntoField(field, point).distance;
    const bool isInside = field.Evaluate(point) >= 0.0;
    for (double x = 0.05; x < distance - 0.1; x += 0.05)
    {
      EXPECT_EQ(field.Evaluate({ point[0] + x, point[1], point[2] }) >= 0.0, isInside) << x << " < " << distance;
      EXPECT_EQ(field.Evaluate({ point[0], point[1], point[2] - x }) >= 0.0, isInside) << x << " < " << distance;
    }
  }
}

TEST(SurfaceErrors, OfAFineSphereThatIsTooLarge)
{
  const ReferenceField sphere = MakeSphereField({ 0, 0, 0 }, 1.0);
  const auto surface = MakeSphere(1.01, 6);
  const SurfaceErrors errors = ComputeSurfaceErrors(*surface, NearestOnField(sphere, everywhere.unit), everywhere);
  EXPECT_EQ(errors.triangles, 8U * 4096U);
  EXPECT_NEAR(errors.area, 4.0 * 3.14159265 * 1.01 * 1.01, 0.01);
  EXPECT_NEAR(errors.meanDistance, 0.01, 2e-4);
  EXPECT_NEAR(errors.rmsDistance, 0.01, 2e-4);
  EXPECT_NEAR(errors.distance99, 0.01, 2e-4);
  EXPECT_NEAR(errors.maximumDistance, 0.01, 1e-6);
  EXPECT_NEAR(errors.facetNormalError, 0.0, 0.2);
  EXPECT_NEAR(errors.vertexNormalError, 0.0, 1e-4);
  EXPECT_GT(errors.meanQuality, 0.9);
  EXPECT_EQ(errors.poorFraction, 0.0);
  EXPECT_EQ(errors.unresolvedFraction, 0.0);
}

TEST(SurfaceErrors, AreInTheUnitAsked)
{
  const ReferenceField sphere = MakeSphereField({ 0, 0, 0 }, 1.0);
  SurfaceErrorSettings settings = everywhere;
  settings.unit = 0.5;
  const auto surface = MakeSphere(1.01, 5);
  EXPECT_NEAR(ComputeSurfaceErrors(*surface, NearestOnField(sphere, settings.unit), settings).meanDistance,
              2.0 * ComputeSurfaceErrors(*surface, NearestOnField(sphere, everywhere.unit), everywhere).meanDistance,
              1e-9);
}

TEST(SurfaceErrors, CountTheTrianglesInTheBoxOnly)
{
  const ReferenceField sphere = MakeSphereField({ 0, 0, 0 }, 1.0);
  SurfaceErrorSettings upperHalf = everywhere;
  upperHalf.lower[2] = 0.0;
  EXPECT_EQ(ComputeSurfaceErrors(*MakeSphere(1.0, 3), NearestOnField(sphere, upperHalf.unit), upperHalf).triangles,
            4U * 64U);
  upperHalf.lower[2] = 2.0;
  EXPECT_EQ(ComputeSurfaceErrors(*MakeSphere(1.0, 3), NearestOnField(sphere, upperHalf.unit), upperHalf).triangles, 0U);
}

TEST(SurfaceErrors, SeeNormalsThatPointInwards)
{
  const ReferenceField sphere = MakeSphereField({ 0, 0, 0 }, 1.0);
  const auto surface = MakeSphere(1.0, 5);
  for (auto & triangle : surface->GetTriangles())
  {
    std::swap(triangle[0], triangle[1]);
  }
  surface->GetNormals().clear();
  const SurfaceErrors errors = ComputeSurfaceErrors(*surface, NearestOnField(sphere, everywhere.unit), everywhere);
  EXPECT_NEAR(errors.facetNormalError, 180.0, 0.5);
  EXPECT_TRUE(std::isnan(errors.vertexNormalError));
}

TEST(SurfaceErrors, NinetyNinePercentOfTheAreaIsNearer)
{
  // A square of 1000 strips; all lie on the surface but 20, which are half a unit above it.
  const ReferenceField plane([](const Vector3 & point, Vector3 & gradient) {
    gradient = { 0.0, 0.0, -1.0 };
    return -point[2];
  });
  const auto surface = itk::TriangleSurface::New();
  for (unsigned int i = 0; i < 1000; ++i)
  {
    const auto first = static_cast<std::uint32_t>(surface->GetNumberOfPoints());
    const auto x = static_cast<float>(i);
    const float z = i < 20 ? 0.5F : 0.0F;
    surface->GetPoints().insert(surface->GetPoints().end(), { { x, 0.0F, z }, { x + 1.0F, 0.0F, z }, { x, 1.0F, z } });
    surface->GetTriangles().push_back({ first, first + 1, first + 2 });
  }
  const SurfaceErrors errors = ComputeSurfaceErrors(*surface, NearestOnField(plane, everywhere.unit), everywhere);
  EXPECT_NEAR(errors.meanDistance, 0.01, 1e-9);
  EXPECT_NEAR(errors.rmsDistance, std::sqrt(0.005), 1e-9);
  EXPECT_NEAR(errors.distance99, 0.5, 1e-9);
  EXPECT_NEAR(errors.maximumDistance, 0.5, 1e-9);
  EXPECT_NEAR(errors.facetNormalError, 0.0, 1e-9);
}

TEST(VTKIsosurface, LooksOutsideWhereValuesAreLower)
{
  const ReferenceField sphere = MakeSphereField({ 9.3, 9.4, 9.6 }, 6.0);
  const auto grid = SampleOnGrid<float>(sphere, 20, 1.0);
  const auto volume = ShareWithVTK(grid.GetPointer());
  for (const VTKExtractor extractor : { VTKExtractor::FlyingEdges, VTKExtractor::MarchingCubes })
  {
    const auto surface = PolyDataToSurface(ExtractWithVTK(extractor, volume, 0.0, true));
    EXPECT_TRUE(itk::ComputeTriangleSurfaceTopology(*surface).IsWatertight());
    const SurfaceErrors errors = ComputeSurfaceErrors(*surface, NearestOnField(sphere, everywhere.unit), everywhere);
    EXPECT_LT(errors.meanDistance, 0.05);
    EXPECT_LT(errors.facetNormalError, 5.0);
    EXPECT_LT(errors.vertexNormalError, 5.0);
    EXPECT_FALSE(PolyDataToSurface(ExtractWithVTK(extractor, volume, 0.0, false))->HasNormals());
  }
}
