#include "itkCartesianToFCCImageFilter.h"
#include "itkFCCBoxSplineInterpolateImageFunction.h"
#include "itkFCCLinearField.h"
#include "itkFCCLinearInterpolateImageFunction.h"
#include "itkFCCToCartesianImageFilter.h"

#include "itkAffineTransform.h"
#include "itkEuler3DTransform.h"
#include "itkResampleImageFilter.h"

#include <gtest/gtest.h>

#include <cstring>

/** itk::ResampleImageFilter from the lattice, onto it, and both. */
namespace
{

using LatticeType = itk::FCCImage<float>;
using GridType = itk::Image<float, 3>;
using PointType = itk::Point<double, 3>;
using FromLattice = itk::ResampleImageFilter<LatticeType, GridType>;
using OntoLattice = itk::ResampleImageFilter<GridType, LatticeType>;
using BetweenLattices = itk::ResampleImageFilter<LatticeType, LatticeType>;
using LinearType = itk::FCCLinearInterpolateImageFunction<LatticeType>;
using BoxSplineType = itk::FCCBoxSplineInterpolateImageFunction<LatticeType>;

constexpr float outside = -1000.0f;

/** A turned grid that reaches beyond the lattice of MakeTurnedLinearField() on all sides. */
GridType::Pointer
MakeGrid()
{
  auto grid = GridType::New();
  grid->SetRegions(itk::ImageRegion<3>({ { -4, 2, 1 } }, { { 33, 36, 34 } }));
  const auto lattice = fcctest::MakeTurnedLinearField();
  const double spacing[3] = { 1.1, 0.9, 1.2 };
  grid->SetSpacing(spacing);
  grid->SetDirection(fcctest::Turn(-0.2, 0.5));
  const auto center = lattice->TransformIndexToPhysicalPoint<double>({ { 3, 15, 3 } });
  const auto middle = grid->TransformIndexToPhysicalPoint<double>({ { 12, 20, 18 } });
  grid->SetOrigin(grid->GetOrigin() + (center - middle));
  grid->Allocate();
  return grid;
}

template <typename TFilter>
typename TFilter::Pointer
MakeFilter(const typename TFilter::InputImageType * input, const itk::ImageBase<3> * frame)
{
  auto filter = TFilter::New();
  filter->SetInput(input);
  filter->SetOutputParametersFromImage(frame);
  filter->SetDefaultPixelValue(outside);
  return filter;
}

/** The motion of a patient between two scans. */
itk::Euler3DTransform<double>::Pointer
MakeMotion()
{
  auto motion = itk::Euler3DTransform<double>::New();
  motion->SetRotation(0.1, -0.05, 0.2);
  const double translation[3] = { 1.5, -2.0, 0.7 };
  motion->SetTranslation(translation);
  return motion;
}

/** Whether the point is in the extent, and if so, whether it is so far from its faces that \a samples around it are
 * too.
 */
bool
IsInside(const LatticeType & lattice, const PointType & point, double margin)
{
  const auto region = lattice.GetBufferedRegion();
  const auto x = lattice.TransformPhysicalPointToLattice(point);
  const double first[3] = { 2.0 * region.GetIndex(0), 1.0 * region.GetIndex(1), 1.0 * region.GetIndex(2) };
  const double length[3] = { 2.0 * region.GetSize(0) - 1, region.GetSize(1) - 1.0, region.GetSize(2) - 1.0 };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (x[axis] < first[axis] + margin || x[axis] > first[axis] + length[axis] - margin)
    {
      return false;
    }
  }
  return true;
}

/** Compares all pixels with the linear field at the points the transform takes theirs to, and expects the default value
 * beyond the lattice's extent, half a lattice unit around its sites. \a reach: the lattice units at the border within
 * which values are not those of the field. */
template <typename TOutput>
void
ExpectLinearField(const TOutput * output,
                  const LatticeType & input,
                  const itk::Transform<double> & transform,
                  double reach)
{
  unsigned int inside = 0, beyond = 0, border = 0;
  for (itk::ImageRegionConstIteratorWithIndex<TOutput> it(output, output->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto point = transform.TransformPoint(output->template TransformIndexToPhysicalPoint<double>(it.GetIndex()));
    if (IsInside(input, point, reach))
    {
      ASSERT_NEAR(it.Get(), fcctest::LinearField(point), 2e-4) << it.GetIndex();
      ++inside;
    }
    else if (!IsInside(input, point, -0.5))
    {
      ASSERT_EQ(it.Get(), outside) << it.GetIndex();
      ++beyond;
    }
    else
    {
      ASSERT_GT(it.Get(), outside + 500) << it.GetIndex();
      ++border;
    }
  }
  EXPECT_GT(inside, 500u);
  EXPECT_GT(beyond, 500u);
  EXPECT_GT(border, 100u);
}

TEST(FCCResample, FromTheLatticeIsExactForLinearFields)
{
  const auto lattice = fcctest::MakeTurnedLinearField();
  const auto motion = MakeMotion();
  const auto filter = MakeFilter<FromLattice>(lattice, MakeGrid());
  filter->SetTransform(motion);
  filter->SetInterpolator(LinearType::New());
  filter->Update();
  ExpectLinearField(filter->GetOutput(), *lattice, *motion, 1.0);
  filter->SetInterpolator(BoxSplineType::New());
  filter->Update();
  ExpectLinearField(filter->GetOutput(), *lattice, *motion, 4.0);
}

TEST(FCCResample, FromTheLatticeByAnAffineTransformIsExactToo)
{
  const auto lattice = fcctest::MakeTurnedLinearField();
  const auto affine = itk::AffineTransform<double>::New();
  affine->Scale(0.9);
  affine->Shear(0, 2, 0.1);
  affine->SetCenter(lattice->TransformIndexToPhysicalPoint<double>({ { 3, 15, 3 } }));
  const auto filter = MakeFilter<FromLattice>(lattice, MakeGrid());
  filter->SetTransform(affine);
  filter->SetInterpolator(LinearType::New());
  filter->Update();
  ExpectLinearField(filter->GetOutput(), *lattice, *affine, 1.0);
}

TEST(FCCResample, FromOneLatticeToAnotherIsExactForLinearFields)
{
  const auto lattice = fcctest::MakeTurnedLinearField();
  auto frame = LatticeType::New();
  frame->CopyInformation(MakeGrid());
  const auto motion = MakeMotion();
  const auto filter = MakeFilter<BetweenLattices>(lattice, frame);
  filter->SetTransform(motion);
  filter->SetInterpolator(LinearType::New());
  filter->Update();
  ExpectLinearField(filter->GetOutput(), *lattice, *motion, 1.0);
}

TEST(FCCResample, OntoTheLatticeIsExactForLinearFields)
{
  const auto grid = MakeGrid();
  const auto motion = MakeMotion();
  fcctest::Sample(grid.GetPointer(), fcctest::LinearField);
  const auto lattice = fcctest::MakeTurnedLinearField();
  const auto filter = MakeFilter<OntoLattice>(grid, lattice);
  filter->SetTransform(motion);
  filter->Update();
  const LatticeType * const output = filter->GetOutput();
  itk::ImageRegion<3> interior = grid->GetBufferedRegion();
  interior.ShrinkByRadius(1);
  unsigned int inside = 0;
  for (itk::ImageRegionConstIteratorWithIndex<LatticeType> it(output, output->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto point = motion->TransformPoint(output->TransformIndexToPhysicalPoint<double>(it.GetIndex()));
    if (interior.IsInside(grid->TransformPhysicalPointToIndex(point)))
    {
      ASSERT_NEAR(it.Get(), fcctest::LinearField(point), 2e-4) << it.GetIndex();
      ++inside;
    }
  }
  EXPECT_GT(inside, 3000u);
}

TEST(FCCResample, AgreesWithFCCToCartesianImageFilter)
{
  const auto lattice = fcctest::MakeTurnedLinearField();
  fcctest::Sample(lattice.GetPointer(), [](const auto & p) { return std::sin(p[0]) * std::cos(2.0 * p[1]) + p[2]; });
  const auto grid = MakeGrid();
  const auto filter = MakeFilter<FromLattice>(lattice, grid);
  filter->SetInterpolator(LinearType::New());
  filter->Update();
  const auto ours = itk::FCCToCartesianImageFilter<LatticeType>::New();
  ours->SetInput(lattice);
  ours->SetReferenceImage(grid);
  ours->SetDefaultPixelValue(outside);
  ours->Update();
  const auto bytes = grid->GetBufferedRegion().GetNumberOfPixels() * sizeof(float);
  EXPECT_EQ(std::memcmp(filter->GetOutput()->GetBufferPointer(), ours->GetOutput()->GetBufferPointer(), bytes), 0);
}

TEST(FCCResample, DoesNotDependOnTheThreads)
{
  const auto lattice = fcctest::MakeTurnedLinearField();
  const auto grid = MakeGrid();
  const auto resample = [&](unsigned int threads) {
    const auto filter = MakeFilter<FromLattice>(lattice, grid);
    filter->SetInterpolator(BoxSplineType::New());
    filter->SetNumberOfWorkUnits(threads);
    filter->Update();
    return GridType::Pointer(filter->GetOutput());
  };
  const auto one = resample(1), many = resample(16);
  const auto bytes = grid->GetBufferedRegion().GetNumberOfPixels() * sizeof(float);
  EXPECT_EQ(std::memcmp(one->GetBufferPointer(), many->GetBufferPointer(), bytes), 0);
}

TEST(FCCResample, WorksBehindAFilterThatHasNotRunYet)
{
  const auto grid = MakeGrid();
  fcctest::Sample(grid.GetPointer(), fcctest::LinearField);
  const auto toLattice = itk::CartesianToFCCImageFilter<GridType>::New();
  toLattice->SetInput(grid);
  const auto back = MakeFilter<FromLattice>(toLattice->GetOutput(), grid);
  back->SetInterpolator(BoxSplineType::New());
  back->Update();
  const PointType point = grid->TransformIndexToPhysicalPoint<double>({ { 12, 20, 18 } });
  EXPECT_NEAR(back->GetOutput()->GetPixel({ { 12, 20, 18 } }), fcctest::LinearField(point), 2e-3);
}

TEST(FCCResample, DerivativesOfALinearFieldAreItsGradient)
{
  const auto lattice = fcctest::MakeTurnedLinearField();
  const auto spline = BoxSplineType::New();
  spline->SetInputImage(lattice);
  for (itk::ImageRegionConstIteratorWithIndex<LatticeType> it(lattice, lattice->GetBufferedRegion()); !it.IsAtEnd();
       ++it)
  {
    const auto point = lattice->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    if (IsInside(*lattice, point, 4.0))
    {
      const auto gradient = spline->EvaluateDerivative(point);
      ASSERT_NEAR(gradient[0], 0.7, 1e-4);
      ASSERT_NEAR(gradient[1], -1.1, 1e-4);
      ASSERT_NEAR(gradient[2], 0.4, 1e-4);
    }
  }
}

} // namespace
