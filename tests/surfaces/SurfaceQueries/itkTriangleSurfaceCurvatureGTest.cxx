#include "itkTriangleSurfaceCurvature.h"

#include "itkExampleSurfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using itk::ComputeTriangleSurfaceMeanCurvature;
using namespace itk::example;

/** The root of the mean squared difference of curvatures from a function of the point. */
template <typename TFunction>
double
ErrorOf(const itk::TriangleSurface & surface, double radius, const TFunction & truth)
{
  const itk::BulkVector<float> found = ComputeTriangleSurfaceMeanCurvature(surface, radius);
  double sum = 0.0;
  for (std::size_t n = 0; n < found.size(); ++n)
  {
    const double difference = found[n] - truth(surface.GetPoints()[n]);
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(found.size()));
}

TEST(TriangleSurfaceCurvature, OfABallIsOneOverItsRadius)
{
  for (const double radius : { 5.0, 10.0, 40.0 })
  {
    const auto ball = MakeSphere(radius, 5, { 1.0, 2.0, 3.0 });
    const double bent = 2.0 / radius; // the ball differs from the polynomial by terms of the fourth degree
    EXPECT_LT(ErrorOf(*ball, 2.0, [&](const auto &) { return 1.0 / radius; }), (0.3 * bent * bent + 0.006) / radius)
      << radius;
  }
}

TEST(TriangleSurfaceCurvature, OfAHollowIsBelowZero)
{
  const auto hollow = MakeSphere(10.0, 5);
  TurnInsideOut(*hollow);
  EXPECT_LT(ErrorOf(*hollow, 2.0, [](const auto &) { return -0.1; }), 0.002);
}

/** Mean curvature of a torus at the angle t around its tube: (R + 2 r cos t) / (2 r (R + r cos t)). */
TEST(TriangleSurfaceCurvature, OfATorusIsThatOfItsEquation)
{
  constexpr double radius = 30.0, tube = 10.0;
  const auto torus = MakeTorus(radius, tube, 160);
  EXPECT_LT(ErrorOf(*torus,
                    2.0,
                    [&](const auto & point) {
                      const double cosine = (std::hypot(point[0], point[1]) - radius) / tube;
                      return (radius + 2.0 * tube * cosine) / (2.0 * tube * (radius + tube * cosine));
                    }),
            0.001);
}

/** A torus whose ring is so wide that its tube is a cylinder of radius 8, with a curvature of 1/16. */
TEST(TriangleSurfaceCurvature, OfACylinderIsHalfOfOneOverItsRadius)
{
  const auto cylinder = itk::TriangleSurface::New();
  constexpr std::uint32_t around = 64, along = 60;
  for (std::uint32_t i = 0; i < along; ++i)
  {
    for (std::uint32_t j = 0; j < around; ++j)
    {
      const double angle = 2.0 * std::acos(-1.0) * j / around;
      cylinder->GetPoints().push_back({ static_cast<float>(8.0 * std::cos(angle)),
                                        static_cast<float>(8.0 * std::sin(angle)),
                                        static_cast<float>(0.8 * i) });
      if (i + 1 < along)
      {
        const std::uint32_t next = (j + 1) % around;
        const std::uint32_t a = i * around + j, b = i * around + next, c = b + around, d = a + around;
        cylinder->GetTriangles().insert(cylinder->GetTriangles().end(), { { a, b, c }, { a, c, d } });
      }
    }
  }
  EXPECT_LT(ErrorOf(*cylinder, 2.5, [](const auto &) { return 1.0 / 16.0; }), 0.003);
}

/** Points that are off by 0.05 mm, a tenth of a side: over 4 mm that is averaged. */
TEST(TriangleSurfaceCurvature, AveragesNoiseOverTheRadius)
{
  const auto ball = MakeSphere(20.0, 6);
  std::mt19937 random(5);
  std::normal_distribution<float> noise(0.0f, 0.05f / 20.0f);
  for (auto & point : ball->GetPoints())
  {
    const float factor = 1.0f + noise(random);
    point = { factor * point[0], factor * point[1], factor * point[2] };
  }
  const auto truth = [](const auto &) { return 0.05; };
  EXPECT_LT(ErrorOf(*ball, 4.0, truth), 0.006);
  EXPECT_GT(ErrorOf(*ball, 0.5, truth), 0.03); // what a smaller radius leaves
}

TEST(TriangleSurfaceCurvature, IsUnknownWithoutNeighbours)
{
  const auto triangle = itk::TriangleSurface::New();
  triangle->GetPoints() = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  triangle->GetTriangles() = { { 0, 1, 2 } };
  for (const float curvature : ComputeTriangleSurfaceMeanCurvature(*triangle, 2.0))
  {
    EXPECT_TRUE(std::isnan(curvature));
  }
}

} // namespace
