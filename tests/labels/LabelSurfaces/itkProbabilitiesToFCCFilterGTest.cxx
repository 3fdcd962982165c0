#include "itkProbabilitiesToFCCFilter.h"

#include "itkFCCLabelSurfaceFilter.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkMultiThreaderBase.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace
{

using Filter = itk::ProbabilitiesToFCCFilter;
using Probabilities = Filter::InputImageType;
using Point = Probabilities::PointType;
using Field = std::function<double(const Point &)>;

Probabilities::Pointer
MakeVolume(const Probabilities::SizeType & size, double slices, const Field & field)
{
  const auto image = Probabilities::New();
  image->SetRegions(Probabilities::RegionType({ { 2, -3, 1 } }, size));
  const double spacing[3] = { 1.0, 1.0, slices };
  image->SetSpacing(spacing);
  Point origin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto first = static_cast<double>(image->GetLargestPossibleRegion().GetIndex(axis));
    origin[axis] = -spacing[axis] * (first + 0.5 * static_cast<double>(size[axis] - 1));
  }
  image->SetOrigin(origin);
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<Probabilities> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<float>(field(image->TransformIndexToPhysicalPoint<double>(it.GetIndex()))));
  }
  return image;
}

itk::LabelWalls::Pointer
MakeWalls(const std::vector<Field> & fields, const Probabilities::SizeType & size, double slices)
{
  const auto toLattice = Filter::New();
  for (unsigned int n = 0; n < fields.size(); ++n)
  {
    toLattice->SetInput(n, MakeVolume(size, slices, fields[n]));
  }
  toLattice->Update();
  const auto surfaces = itk::FCCLabelSurfaceFilter::New();
  surfaces->SetInput(toLattice->GetOutput());
  surfaces->SetWeights(toLattice->GetWeights());
  surfaces->Update();
  itk::LabelWalls::Pointer walls = surfaces->GetOutput();
  walls->DisconnectPipeline();
  return walls;
}

/** The points of the walls between two labels, 0 being outside, that are in a box around the origin. */
std::vector<Point>
PointsBetween(const itk::LabelWalls & walls, std::uint16_t one, std::uint16_t other, const Point & box)
{
  std::vector<Point> points;
  for (std::size_t n = 0; n < walls.GetNumberOfTriangles(); ++n)
  {
    const auto & pair = walls.GetTriangleLabels()[n];
    if (std::min(pair[0], pair[1]) != one || std::max(pair[0], pair[1]) != other)
    {
      continue;
    }
    for (const auto corner : walls.GetTriangles()[n])
    {
      Point point;
      bool isInside = true;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        point[axis] = walls.GetPoints()[corner][axis];
        isInside = isInside && std::abs(point[axis]) < box[axis];
      }
      if (isInside)
      {
        points.push_back(point);
      }
    }
  }
  return points;
}

/** Half the size of a volume, without four voxels at its border. */
Point
InnerBox(const Probabilities::SizeType & size, double slices)
{
  Point box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    box[axis] = (0.5 * static_cast<double>(size[axis]) - 4.0) * (axis == 2 ? slices : 1.0);
  }
  return box;
}

/** Probabilities that are linear functions tie in planes, which the walls are then. */
TEST(ProbabilitiesToFCCFilter, LinearProbabilitiesTieWhereTheyDo)
{
  const Field first = [](const Point & p) { return 0.4 + 0.011 * p[0] + 0.004 * p[1] - 0.003 * p[2]; };
  const Field second = [](const Point & p) { return 0.35 - 0.009 * p[0] + 0.006 * p[1]; };
  const Field third = [&](const Point & p) { return 1.0 - first(p) - second(p); };
  const std::vector<Field> fields{ first, second, third };
  for (const double slices : { 1.0, 2.9 })
  {
    const Probabilities::SizeType size{ { 34, 32, slices > 1.0 ? 16u : 34u } };
    const auto walls = MakeWalls(fields, size, slices);
    for (std::uint16_t one = 1; one <= 3; ++one)
    {
      for (auto other = static_cast<std::uint16_t>(one + 1); other <= 3; ++other)
      {
        const auto points = PointsBetween(*walls, one, other, InnerBox(size, slices));
        EXPECT_GT(points.size(), 100u);
        for (const Point & point : points)
        {
          // Points on the junction of three walls stay in their cells, where ties may be outside.
          const double probability = fields[one - 1u](point);
          const double last = fields[5u - one - other](point);
          EXPECT_NEAR(probability, fields[other - 1u](point), last > probability - 0.04 ? 0.02 : 3e-4);
          EXPECT_GT(probability, last - 0.02) << "the third is not more probable";
        }
      }
    }
  }
}

/** What labels leave to 1 is outside: the border of one label lies where its probability is a half. */
TEST(ProbabilitiesToFCCFilter, OutsideIsWhatIsLeft)
{
  constexpr double radius = 9.0;
  const Field ball = [](const Point & p) {
    return std::clamp(0.5 + 0.25 * (radius - p.GetVectorFromOrigin().GetNorm()), 0.0, 1.0);
  };
  const Probabilities::SizeType size{ { 30, 30, 30 } };
  const auto walls = MakeWalls({ ball }, size, 1.0);
  EXPECT_EQ(walls->FindLabels(), (std::vector<std::uint16_t>{ 1 }));
  for (const Point & point : PointsBetween(*walls, 0, 1, Point(radius + 1.0)))
  {
    EXPECT_NEAR(point.GetVectorFromOrigin().GetNorm(), radius, 0.1);
  }
  EXPECT_NEAR(itk::ComputeTriangleSurfaceVolume(*walls->ExtractLabel(1)),
              4.0 / 3.0 * 3.14159265 * radius * radius * radius,
              60.0);
}

/** Two half balls by the shares of voxels that they fill, also in thick slices. */
TEST(ProbabilitiesToFCCFilter, HalfBallsShareTheirWall)
{
  constexpr double radius = 14.0;
  for (const double slices : { 1.0, 3.0, 5.0 })
  {
    const auto half = [slices](bool isRight) {
      return [slices, isRight](const Point & p) {
        constexpr int samples = 4;
        int inside = 0;
        for (int n = 0; n < samples * samples * samples; ++n)
        {
          const auto place = [&](int sample) { return (sample + 0.5) / samples - 0.5; };
          const double x = p[0] + place(n % samples);
          const double y = p[1] + place(n / samples % samples);
          const double z = p[2] + slices * place(n / samples / samples);
          inside += std::hypot(x, y, z) < radius && (x > 0.3) == isRight ? 1 : 0;
        }
        return static_cast<double>(inside) / (samples * samples * samples);
      };
    };
    const Probabilities::SizeType size{ { 40, 38, static_cast<itk::SizeValueType>(40.0 / slices) } };
    const auto walls = MakeWalls({ half(false), half(true) }, size, slices);
    EXPECT_EQ(walls->FindLabels(), (std::vector<std::uint16_t>{ 1, 2 }));
    for (const std::uint16_t label : { 1, 2 })
    {
      const auto topology = itk::ComputeTriangleSurfaceTopology(*walls->ExtractLabel(label));
      EXPECT_TRUE(topology.IsWatertight()) << topology;
      EXPECT_EQ(topology.components, 1u);
      double sum = 0.0;
      const auto points = PointsBetween(*walls, 0, label, Point(radius + 1.0));
      for (const Point & point : points)
      {
        sum += std::abs(point.GetVectorFromOrigin().GetNorm() - radius);
      }
      EXPECT_LT(sum / static_cast<double>(points.size()), slices < 2.0 ? 0.08 : slices < 4.0 ? 0.15 : 0.25) << slices;
    }
    for (const Point & point : PointsBetween(*walls, 1, 2, Point(radius)))
    {
      const bool isInner = point.GetVectorFromOrigin().GetNorm() < radius - 2.0 * slices;
      EXPECT_NEAR(point[0], 0.3, isInner ? 0.3 : 1.5);
    }
  }
}

TEST(ProbabilitiesToFCCFilter, LabelsEndAtTheBorderOfTheVolumes)
{
  const auto walls = MakeWalls(
    { [](const Point & p) { return p[0] < 0.0 ? 1.0 : 0.0; }, [](const Point & p) { return p[0] < 0.0 ? 0.0 : 1.0; } },
    { { 12, 10, 4 } },
    3.0);
  const auto bounds = walls->GetBounds();
  const double half[3] = { 6.0, 5.0, 6.0 };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(bounds[2 * axis], -half[axis], 0.05);
    EXPECT_NEAR(bounds[2 * axis + 1], half[axis], 0.05);
  }
}

TEST(ProbabilitiesToFCCFilter, BytesDoNotDependOnThreads)
{
  const Field wave = [](const Point & p) { return 0.5 + 0.5 * std::sin(0.7 * p[0] + std::cos(0.5 * p[1] + p[2])); };
  const Field other = [&](const Point & p) { return 0.8 - 0.8 * wave(p); };
  const auto make = [&](itk::ThreadIdType threads) {
    const auto before = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    auto walls = MakeWalls({ wave, other }, { { 20, 18, 9 } }, 2.0);
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(before);
    return walls;
  };
  const auto one = make(1);
  for (const itk::ThreadIdType threads : { 2, 3, 8 })
  {
    const auto several = make(threads);
    EXPECT_EQ(one->GetPoints(), several->GetPoints());
    EXPECT_EQ(one->GetTriangles(), several->GetTriangles());
    EXPECT_EQ(one->GetTriangleLabels(), several->GetTriangleLabels());
  }
}

TEST(ProbabilitiesToFCCFilter, RefusesOtherGrids)
{
  const Field half = [](const Point &) { return 0.5; };
  const auto filter = Filter::New();
  filter->SetInput(0, MakeVolume({ { 4, 4, 4 } }, 1.0, half));
  filter->SetInput(1, MakeVolume({ { 4, 4, 4 } }, 1.1, half));
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
  filter->SetInput(1, MakeVolume({ { 4, 4, 3 } }, 1.0, half));
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
  filter->SetInput(1, nullptr);
  filter->SetInput(2, MakeVolume({ { 4, 4, 4 } }, 1.0, half));
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
}

} // namespace
