#include "itkTriangleSurfaceAgreementFilter.h"

#include "itkExampleSurfaces.h"
#include "itkMultiThreaderBase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

using Surface = itk::TriangleSurface;
using Agreement = itk::TriangleSurfaceAgreement;
using itk::ComputeTriangleSurfaceAgreement;
using itk::example::Append;
using itk::example::MakeSphere;

constexpr double Near = 0.005; // mm, and of shares

/** A box with corners at the origin and \a size, of twelve triangles. */
Surface::Pointer
MakeBox(float size, const Surface::PointType & shift = {})
{
  const auto box = Surface::New();
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    box->GetPoints().push_back({ shift[0] + ((corner & 1u) != 0 ? size : 0.0f),
                                 shift[1] + ((corner & 2u) != 0 ? size : 0.0f),
                                 shift[2] + ((corner & 4u) != 0 ? size : 0.0f) });
  }
  box->GetTriangles() = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 }, { 1, 5, 4 },
                          { 2, 6, 3 }, { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
  return box;
}

/** A surface of revolution about z: a ring of \a radius whose cross section is a circle of \a thickness. */
Surface::Pointer
MakeTorus(double radius, double thickness, std::uint32_t around = 480, std::uint32_t across = 120)
{
  const double turn = 2.0 * std::acos(-1.0);
  const auto torus = Surface::New();
  for (std::uint32_t i = 0; i < around; ++i)
  {
    for (std::uint32_t j = 0; j < across; ++j)
    {
      const double u = turn * i / around;
      const double v = turn * j / across;
      const double distance = radius + thickness * std::cos(v);
      torus->GetPoints().push_back({ static_cast<float>(distance * std::cos(u)),
                                     static_cast<float>(distance * std::sin(u)),
                                     static_cast<float>(thickness * std::sin(v)) });
      const std::uint32_t a = i * across + j, b = (i + 1) % around * across + j;
      const std::uint32_t c = i * across + (j + 1) % across, d = (i + 1) % around * across + (j + 1) % across;
      torus->GetTriangles().push_back({ a, b, c });
      torus->GetTriangles().push_back({ b, d, c });
    }
  }
  return torus;
}

TEST(TriangleSurfaceAgreement, ConcentricBallsOfTwentyAndTwentyOne)
{
  const auto first = MakeSphere(20.0, 6);
  const auto second = MakeSphere(21.0, 6);
  for (const auto & [tolerance, dice] : { std::pair{ 1.1, 1.0 }, std::pair{ 0.9, 0.0 } })
  {
    const Agreement found = ComputeTriangleSurfaceAgreement(*first, *second, tolerance);
    EXPECT_NEAR(found.hausdorff, 1.0, Near);
    EXPECT_NEAR(found.hausdorff95, 1.0, Near);
    EXPECT_NEAR(found.meanOfMeans, 1.0, Near);
    EXPECT_NEAR(found.pooledMean, 1.0, Near);
    EXPECT_EQ(found.normalizedDice, dice);
    EXPECT_EQ(found.worstSide, Agreement::Side::Second) << "the larger ball alone is there";
    EXPECT_EQ(ComputeTriangleSurfaceAgreement(*second, *first, tolerance).worstSide, Agreement::Side::First);
  }
}

/** Of a ball of radius R and a copy that is shifted by s, the squared distance of a point from the other's centre is
 * uniformly distributed between (R - s)^2 and (R + s)^2. */
TEST(TriangleSurfaceAgreement, ShiftedBalls)
{
  const double radius = 20.0;
  for (const double shift : { 0.5, 3.0, 12.0 })
  {
    const auto first = MakeSphere(radius, 6);
    const auto second = MakeSphere(radius, 6, { 0.3 * shift, 0.8 * shift, std::sqrt(1.0 - 0.09 - 0.64) * shift });
    const auto distanceAt = [&](double cosine) {
      return std::abs(std::sqrt(radius * radius + shift * shift - 2.0 * radius * shift * cosine) - radius);
    };
    std::vector<double> distances; // of rings of equal area
    constexpr std::size_t rings = 200'000;
    for (std::size_t n = 0; n < rings; ++n)
    {
      distances.push_back(distanceAt(2.0 * (static_cast<double>(n) + 0.5) / rings - 1.0));
    }
    std::sort(distances.begin(), distances.end());
    double mean = 0.0;
    for (const double distance : distances)
    {
      mean += distance / rings;
    }
    const double tolerance = 0.4 * shift;
    const auto within = std::upper_bound(distances.begin(), distances.end(), tolerance) - distances.begin();
    const Agreement found = ComputeTriangleSurfaceAgreement(*first, *second, tolerance);
    EXPECT_NEAR(found.hausdorff, shift, Near) << shift;
    EXPECT_NEAR(found.hausdorff95, distances[rings * 95 / 100], Near) << shift;
    EXPECT_NEAR(found.meanOfMeans, mean, Near) << shift;
    EXPECT_NEAR(found.pooledMean, mean, Near) << shift;
    EXPECT_NEAR(found.normalizedDice, static_cast<double>(within) / rings, Near) << shift;
  }
}

/** Twelve triangles say as much as thousands. A shift by s along x: the two faces across x are s away; a share s / 10
 * of each of the other four faces is beside the other box, up to s away. */
TEST(TriangleSurfaceAgreement, ShiftedBoxesOfTwelveTriangles)
{
  const double shift = 2.0;
  const Agreement found = ComputeTriangleSurfaceAgreement(*MakeBox(10.0f), *MakeBox(10.0f, { 2.0f, 0.0f, 0.0f }), 1.0);
  EXPECT_NEAR(found.hausdorff, shift, Near);
  // One face across x is s outside; the other is s inside of the other's face, but as near to its sides where it is
  // less than s from its own edges.
  const double inner = 10.0 - 2.0 * shift;
  double meanOfInner = 0.0; // of min(s, distance to the edges) over the square
  meanOfInner = (inner * inner * shift +
                 [&] {
                   double sum = 0.0;
                   constexpr int steps = 2000;
                   for (int n = 0; n < steps; ++n)
                   {
                     const double depth = shift * (n + 0.5) / steps;
                     sum += depth * 4.0 * (10.0 - 2.0 * depth) * shift / steps;
                   }
                   return sum;
                 }()) /
                100.0;
  const double mean = (shift + meanOfInner + 4.0 * (shift / 10.0) * shift / 2.0) / 6.0;
  EXPECT_NEAR(found.meanOfMeans, mean, Near);
  EXPECT_NEAR(found.pooledMean, mean, Near);
  // Within 1 mm: of the four sides all but the last millimetre, of the inner face its border of 1 mm.
  EXPECT_NEAR(found.normalizedDice, (4.0 * 90.0 + 100.0 - 64.0) / 600.0, Near);
}

TEST(TriangleSurfaceAgreement, RingsOfTwoThicknesses)
{
  const Agreement found = ComputeTriangleSurfaceAgreement(*MakeTorus(30.0, 5.0), *MakeTorus(30.0, 6.5), 1.0);
  EXPECT_NEAR(found.hausdorff, 1.5, Near);
  EXPECT_NEAR(found.hausdorff95, 1.5, Near);
  EXPECT_NEAR(found.meanOfMeans, 1.5, Near);
  EXPECT_EQ(found.normalizedDice, 0.0);
  EXPECT_EQ(found.worstSide, Agreement::Side::Second);
}

TEST(TriangleSurfaceAgreement, ASmallIslandCountsByItsArea)
{
  const auto one = MakeSphere(20.0, 6);
  const auto two = MakeSphere(20.0, 6);
  Append(*two, *MakeSphere(2.0, 4), { 60.0f, 0.0f, 0.0f });
  const Agreement found = ComputeTriangleSurfaceAgreement(*one, *two);
  EXPECT_NEAR(found.hausdorff, 42.0, 0.01);
  EXPECT_NEAR(found.hausdorff95, 0.0, Near);
  EXPECT_NEAR(found.normalizedDice, 200.0 / 201.0, 1e-4);
  EXPECT_NEAR(found.worst[0], 62.0, 0.01);
  EXPECT_EQ(found.worstSide, Agreement::Side::Second);
}

TEST(TriangleSurfaceAgreement, ASurfaceAgreesWithItself)
{
  const auto sphere = MakeSphere(20.0, 5, { 100.0, -50.0, 7.0 });
  const Agreement found = ComputeTriangleSurfaceAgreement(*sphere, *sphere, 0.0);
  EXPECT_EQ(found.hausdorff, 0.0);
  EXPECT_EQ(found.hausdorff95, 0.0);
  EXPECT_EQ(found.meanOfMeans, 0.0);
  EXPECT_EQ(found.pooledMean, 0.0);
  EXPECT_EQ(found.normalizedDice, 1.0);
}

TEST(TriangleSurfaceAgreement, EmptySurfaces)
{
  const auto sphere = MakeSphere(10.0, 2);
  const auto empty = Surface::New();
  const Agreement one = ComputeTriangleSurfaceAgreement(*sphere, *empty);
  EXPECT_TRUE(std::isinf(one.hausdorff) && std::isinf(one.hausdorff95) && std::isinf(one.pooledMean));
  EXPECT_EQ(one.normalizedDice, 0.0);
  EXPECT_EQ(ComputeTriangleSurfaceAgreement(*empty, *sphere).normalizedDice, 0.0);
  const Agreement none = ComputeTriangleSurfaceAgreement(*empty, *empty);
  EXPECT_EQ(none.hausdorff, 0.0);
  EXPECT_EQ(none.normalizedDice, 1.0);
  const auto flat = Surface::New(); // without area
  flat->GetPoints() = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } };
  flat->GetTriangles() = { { 0, 1, 2 } };
  EXPECT_EQ(ComputeTriangleSurfaceAgreement(*flat, *flat).normalizedDice, 1.0);
  EXPECT_TRUE(std::isinf(ComputeTriangleSurfaceAgreement(*flat, *sphere).hausdorff));
  EXPECT_THROW(ComputeTriangleSurfaceAgreement(*sphere, *sphere, -1.0), itk::ExceptionObject);
}

TEST(TriangleSurfaceAgreement, ExchangedSurfacesAndThreads)
{
  const auto one = MakeSphere(20.0, 5);
  const auto two = MakeSphere(19.0, 5, { 0.4, 1.3, 0.2 });
  const auto usual = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  const Agreement found = ComputeTriangleSurfaceAgreement(*one, *two);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(5);
  const Agreement again = ComputeTriangleSurfaceAgreement(*one, *two);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(usual);
  const Agreement exchanged = ComputeTriangleSurfaceAgreement(*two, *one);
  EXPECT_EQ(found.pooledMean, again.pooledMean);
  EXPECT_EQ(found.hausdorff95, again.hausdorff95);
  EXPECT_EQ(found.normalizedDice, again.normalizedDice);
  EXPECT_EQ(found.hausdorff, exchanged.hausdorff);
  EXPECT_EQ(found.hausdorff95, exchanged.hausdorff95);
  EXPECT_NEAR(found.pooledMean, exchanged.pooledMean, 1e-12);
  EXPECT_NE(found.worstSide, exchanged.worstSide);
}

TEST(TriangleSurfaceAgreement, FilterPassesTheFirstSurfaceOn)
{
  const auto first = MakeSphere(20.0, 4);
  const auto second = MakeSphere(22.0, 4);
  const auto filter = itk::TriangleSurfaceAgreementFilter::New();
  filter->SetInput1(first);
  EXPECT_THROW(filter->Update(), itk::ExceptionObject) << "one input is missing";
  filter->SetInput2(second);
  filter->SetTolerance(2.5);
  filter->Update();
  EXPECT_EQ(filter->GetAgreement().normalizedDice, 1.0);
  EXPECT_EQ(filter->GetOutput()->GetPoints(), first->GetPoints());
  filter->SetTolerance(1.0);
  filter->Update();
  EXPECT_EQ(filter->GetAgreement().normalizedDice, 0.0) << "a setting makes the filter run anew";
}

} // namespace
