#include "itkFCCLinearField.h"
#include "itkFCCLinearInterpolateImageFunction.h"

#include "itkCastImageFilter.h"
#include "itkCropImageFilter.h"
#include "itkExtractImageFilter.h"
#include "itkImageMomentsCalculator.h"
#include "itkMeanSquaresImageToImageMetric.h"
#include "itkPasteImageFilter.h"
#include "itkPipelineMonitorImageFilter.h"
#include "itkStreamingImageFilter.h"
#include "itkTranslationTransform.h"
#include "itkWarpImageFilter.h"

#include <gtest/gtest.h>

/** Filters of ITK that know places, and know them right on the lattice. */
namespace
{

using LatticeType = itk::FCCImage<float>;
using RegionType = LatticeType::RegionType;

void
ExpectSamplesOfLinearField(const LatticeType * image)
{
  for (itk::ImageRegionConstIteratorWithIndex<LatticeType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto point = image->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    ASSERT_NEAR(it.Get(), fcctest::LinearField(point), 1e-4) << it.GetIndex();
  }
}

TEST(FCCRegions, ExtractKeepsSamplesWhereTheyAre)
{
  const auto filter = itk::ExtractImageFilter<LatticeType, LatticeType>::New();
  filter->SetInput(fcctest::MakeTurnedLinearField());
  for (const itk::IndexValueType j : { 6, 7 })
  {
    const RegionType region({ { -1, j, -3 } }, { { 4, 5, 6 } });
    filter->SetExtractionRegion(region);
    filter->SetDirectionCollapseToSubmatrix();
    filter->UpdateLargestPossibleRegion();
    EXPECT_EQ(filter->GetOutput()->GetBufferedRegion(), region);
    ExpectSamplesOfLinearField(filter->GetOutput());
  }
}

TEST(FCCRegions, CropKeepsSamplesWhereTheyAre)
{
  const auto filter = itk::CropImageFilter<LatticeType, LatticeType>::New();
  filter->SetInput(fcctest::MakeTurnedLinearField());
  filter->SetLowerBoundaryCropSize({ { 2, 1, 3 } });
  filter->SetUpperBoundaryCropSize({ { 1, 2, 0 } });
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetBufferedRegion().GetSize(), (itk::Size<3>{ { 9, 20, 18 } }));
  ExpectSamplesOfLinearField(filter->GetOutput());
}

TEST(FCCRegions, PasteBringsSamplesBackToTheirPlaces)
{
  const auto image = fcctest::MakeTurnedLinearField();
  const auto damaged = fcctest::MakeTurnedLinearField();
  const RegionType region({ { -1, 7, -3 } }, { { 4, 5, 6 } });
  for (itk::ImageRegionIterator<LatticeType> it(damaged, region); !it.IsAtEnd(); ++it)
  {
    it.Set(0.0f);
  }
  const auto filter = itk::PasteImageFilter<LatticeType>::New();
  filter->SetDestinationImage(damaged);
  filter->SetSourceImage(image);
  filter->SetSourceRegion(region);
  filter->SetDestinationIndex(region.GetIndex());
  filter->Update();
  ExpectSamplesOfLinearField(filter->GetOutput());
}

TEST(FCCRegions, StreamingMakesTheImagePartByPart)
{
  const auto cast = itk::CastImageFilter<LatticeType, LatticeType>::New();
  cast->SetInput(fcctest::MakeTurnedLinearField());
  cast->InPlaceOff();
  const auto monitor = itk::PipelineMonitorImageFilter<LatticeType>::New();
  monitor->SetInput(cast->GetOutput());
  const auto streaming = itk::StreamingImageFilter<LatticeType, LatticeType>::New();
  streaming->SetInput(monitor->GetOutput());
  streaming->SetNumberOfStreamDivisions(5);
  streaming->Update();
  EXPECT_EQ(monitor->GetNumberOfUpdates(), 5u);
  EXPECT_EQ(streaming->GetOutput()->GetBufferedRegion().GetSize(), (itk::Size<3>{ { 12, 23, 21 } }));
  ExpectSamplesOfLinearField(streaming->GetOutput());
}

TEST(FCCRegions, WarpIsExactForLinearFields)
{
  const auto image = fcctest::MakeTurnedLinearField();
  using FieldType = itk::FCCImage<itk::Vector<double, 3>>;
  const auto field = FieldType::New();
  field->CopyInformation(image);
  field->SetRegions(RegionType({ { 0, 12, 0 } }, { { 5, 6, 5 } }));
  field->Allocate();
  const double shift[3] = { 0.3, -0.2, 0.5 };
  field->FillBuffer(itk::Vector<double, 3>(shift));
  const auto filter = itk::WarpImageFilter<LatticeType, LatticeType, FieldType>::New();
  filter->SetInput(image);
  filter->SetDisplacementField(field);
  filter->SetOutputParametersFromImage(image);
  filter->SetOutputStartIndex(field->GetBufferedRegion().GetIndex());
  filter->SetOutputSize(field->GetBufferedRegion().GetSize());
  filter->SetInterpolator(itk::FCCLinearInterpolateImageFunction<LatticeType>::New());
  filter->Update();
  const LatticeType * const output = filter->GetOutput();
  for (itk::ImageRegionConstIteratorWithIndex<LatticeType> it(output, output->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto point = output->TransformIndexToPhysicalPoint<double>(it.GetIndex()) + itk::Vector<double, 3>(shift);
    ASSERT_NEAR(it.Get(), fcctest::LinearField(point), 2e-4) << it.GetIndex();
  }
}

TEST(FCCRegions, CenterOfGravityIsThatOfTheSamples)
{
  const auto image = fcctest::MakeTurnedLinearField();
  itk::Vector<double, 3> center(0.0);
  double mass = 0.0;
  for (itk::ImageRegionConstIteratorWithIndex<LatticeType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    mass += it.Get();
    center += image->TransformIndexToPhysicalPoint<double>(it.GetIndex()).GetVectorFromOrigin() * it.Get();
  }
  const auto moments = itk::ImageMomentsCalculator<LatticeType>::New();
  moments->SetImage(image);
  moments->Compute();
  EXPECT_NEAR(moments->GetTotalMass(), mass, 1e-6 * std::abs(mass));
  EXPECT_LT((moments->GetCenterOfGravity() - center / mass).GetNorm(), 1e-6);
}

TEST(FCCRegions, MetricsOfRegistrationHaveTheirValues)
{
  const auto fixed = fcctest::MakeTurnedLinearField();
  const auto moving = fcctest::MakeTurnedLinearField();
  const auto metric = itk::MeanSquaresImageToImageMetric<LatticeType, LatticeType>::New();
  metric->SetFixedImage(fixed);
  metric->SetMovingImage(moving);
  metric->SetFixedImageRegion(RegionType({ { 0, 12, 0 } }, { { 5, 6, 5 } }));
  metric->UseAllPixelsOn();
  metric->SetComputeGradient(false); // by a recursive Gaussian, which is wrong on the lattice
  const auto transform = itk::TranslationTransform<double, 3>::New();
  metric->SetTransform(transform);
  metric->SetInterpolator(itk::FCCLinearInterpolateImageFunction<LatticeType>::New());
  metric->Initialize();
  itk::TranslationTransform<double, 3>::ParametersType shift(3);
  shift.Fill(0.0);
  EXPECT_NEAR(metric->GetValue(shift), 0.0, 1e-8);
  shift[0] = 1.5;
  shift[1] = -0.5;
  EXPECT_NEAR(metric->GetValue(shift), 1.6 * 1.6, 1e-3) << "the square of 1.5 * 0.7 + 0.5 * 1.1";
}

} // namespace
