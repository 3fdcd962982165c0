#include "itkFCCLinearInterpolateImageFunction.h"

#include "detail/itkFCCTetrahedron.h"
#include "itkFCCCells.h"
#include "itkImage.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkResampleImageFilter.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

using ImageType = itk::FCCImage<float>;
using Interpolator = itk::FCCLinearInterpolateImageFunction<ImageType>;
using PointType = ImageType::PointType;

double
LinearField(const PointType & point)
{
  return 3.0 + 0.5 * point[0] - 0.25 * point[1] + 2.0 * point[2];
}

ImageType::Pointer
MakeImage()
{
  auto image = ImageType::New();
  image->SetRegions(ImageType::RegionType({ { 1, -2, 3 } }, { { 6, 9, 8 } }));
  image->Allocate();
  const double spacing[3] = { 0.5, 0.75, 1.25 };
  image->SetSpacing(spacing);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<float>(LinearField(image->TransformIndexToPhysicalPoint<double>(it.GetIndex()))));
  }
  return image;
}

TEST(FCCTetrahedron, WeightsAreBarycentricCoordinatesOfSites)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-5.0, 5.0);
  for (int trial = 0; trial < 20000; ++trial)
  {
    std::array<double, 3> point{ coordinate(random), coordinate(random), coordinate(random) };
    if (trial % 4 == 0)
    {
      point[static_cast<std::size_t>(trial / 4 % 3)] = std::round(point[0]); // on faces of the cells, too
    }
    const auto tetrahedron = itk::LocateFCCTetrahedron(point);
    std::array<double, 3> sum{};
    double weights = 0.0;
    for (unsigned int corner = 0; corner < 4; ++corner)
    {
      ASSERT_TRUE(itk::FCCLattice::IsSite(tetrahedron.sites[corner]));
      for (unsigned int other = 0; other < corner; ++other)
      {
        const auto step = itk::FCCStep::Subtract(tetrahedron.sites[corner], tetrahedron.sites[other]);
        ASSERT_LT(itk::FCCCells::DirectionOf(step), itk::FCCCells::Directions)
          << "the tetrahedra are those of FCCCells";
      }
      ASSERT_GE(tetrahedron.weights[corner], -1e-12);
      weights += tetrahedron.weights[corner];
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        sum[axis] += tetrahedron.weights[corner] * static_cast<double>(tetrahedron.sites[corner][axis]);
      }
    }
    ASSERT_NEAR(weights, 1.0, 1e-12);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      ASSERT_NEAR(sum[axis], point[axis], 1e-11);
    }
  }
}

TEST(FCCTetrahedron, CutsOctahedraAboutTheirXDiagonal)
{
  // The octahedron around (1, 0, 0): its centre lies half way between its two sites on the x axis.
  const auto tetrahedron = itk::LocateFCCTetrahedron({ 1.0, 1e-3, 1e-3 });
  double onAxis = 0.0;
  for (unsigned int corner = 0; corner < 4; ++corner)
  {
    const auto & site = tetrahedron.sites[corner];
    onAxis += site[1] == 0 && site[2] == 0 ? tetrahedron.weights[corner] : 0.0;
  }
  EXPECT_NEAR(onAxis, 1.0 - 2e-3, 1e-12);
}

TEST(FCCLinearInterpolateImageFunction, ReproducesLinearFields)
{
  const auto image = MakeImage();
  auto interpolator = Interpolator::New();
  interpolator->SetInputImage(image);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(4.0, 11.0);
  std::uniform_real_distribution<double> y(-1.0, 5.0);
  std::uniform_real_distribution<double> z(4.0, 9.0);
  for (int trial = 0; trial < 5000; ++trial)
  {
    const auto point = image->TransformLatticeToPhysicalPoint<double>({ x(random), y(random), z(random) });
    ASSERT_TRUE(interpolator->IsInsideBuffer(point));
    ASSERT_NEAR(interpolator->Evaluate(point), LinearField(point), 1e-5);
  }
}

TEST(FCCLinearInterpolateImageFunction, StaysWithinTheRangeUpToTheExtent)
{
  auto image = MakeImage();
  image->FillBuffer(7.0f);
  auto interpolator = Interpolator::New();
  interpolator->SetInputImage(image);
  for (const std::array<double, 3> lattice : { std::array<double, 3>{ 1.5, -2.5, 2.5 },
                                               std::array<double, 3>{ 13.49, 6.49, 10.49 },
                                               std::array<double, 3>{ 1.5, 0.3, 5.2 } })
  {
    const auto point = image->TransformLatticeToPhysicalPoint<double>(lattice);
    EXPECT_TRUE(interpolator->IsInsideBuffer(point));
    EXPECT_EQ(interpolator->Evaluate(point), 7.0);
  }
  EXPECT_FALSE(interpolator->IsInsideBuffer(image->TransformLatticeToPhysicalPoint<double>({ 1.4, 0, 5 })));
}

TEST(FCCLinearInterpolateImageFunction, WorksInsideResampleImageFilter)
{
  const auto image = MakeImage();
  using Cartesian = itk::Image<float, 3>;
  const auto resample = itk::ResampleImageFilter<ImageType, Cartesian>::New();
  const Cartesian::PointType origin = image->TransformLatticeToPhysicalPoint<double>({ 5, 0, 5 });
  resample->SetInput(image);
  resample->SetInterpolator(Interpolator::New());
  resample->SetOutputOrigin(origin);
  resample->SetOutputSpacing(Cartesian::SpacingType(0.4));
  resample->SetSize({ { 5, 6, 7 } });
  resample->Update();
  const auto * const output = resample->GetOutput();
  for (itk::ImageRegionConstIteratorWithIndex<Cartesian> it(output, output->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    ASSERT_NEAR(it.Get(), LinearField(output->TransformIndexToPhysicalPoint<double>(it.GetIndex())), 1e-4);
  }
}

} // namespace
