#include "itkFCCLinearField.h"

#include "itkAddImageFilter.h"
#include "itkBinaryThresholdImageFilter.h"
#include "itkCastImageFilter.h"
#include "itkClampImageFilter.h"
#include "itkImageDuplicator.h"
#include "itkImageScanlineIterator.h"
#include "itkMaskImageFilter.h"
#include "itkOtsuThresholdCalculator.h"
#include "itkImageToHistogramFilter.h"
#include "itkLabelStatisticsImageFilter.h"
#include "itkMinimumMaximumImageCalculator.h"
#include "itkRescaleIntensityImageFilter.h"
#include "itkShiftScaleImageFilter.h"
#include "itkStatisticsImageFilter.h"
#include "itkSubtractImageFilter.h"
#include "itkUnaryGeneratorImageFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

/** Filters of ITK that look at each sample by itself, or at all of them without their places: they work as they are. */
namespace
{

using LatticeType = itk::FCCImage<float>;
using MaskType = itk::FCCImage<std::uint8_t>;

template <typename TImage>
std::vector<double>
PixelsOf(const TImage * image)
{
  const auto * const begin = image->GetBufferPointer();
  return { begin, begin + image->GetBufferedRegion().GetNumberOfPixels() };
}

/** Expects each output sample to be \a function of the input's, in an output on the same lattice. */
template <typename TImage>
void
ExpectEach(const LatticeType * input, const TImage * output, const std::function<double(double)> & function)
{
  EXPECT_EQ(output->GetBufferedRegion(), input->GetBufferedRegion());
  EXPECT_EQ(output->GetSpacing(), input->GetSpacing());
  EXPECT_EQ(output->GetOrigin(), input->GetOrigin());
  EXPECT_EQ(output->GetDirection(), input->GetDirection());
  const auto inputs = PixelsOf(input), outputs = PixelsOf(output);
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    ASSERT_NEAR(outputs[i], function(inputs[i]), 1e-4);
  }
}

class FCCPixelwise : public testing::Test
{
protected:
  const LatticeType::Pointer m_Image = fcctest::MakeTurnedLinearField();
  const std::vector<double> m_Pixels = PixelsOf(m_Image.GetPointer());
  const double m_Least = *std::min_element(m_Pixels.begin(), m_Pixels.end());
  const double m_Most = *std::max_element(m_Pixels.begin(), m_Pixels.end());
  const double m_Middle = (m_Least + m_Most) / 2;

  MaskType::Pointer
  MakeMask() const
  {
    const auto filter = itk::BinaryThresholdImageFilter<LatticeType, MaskType>::New();
    filter->SetInput(m_Image);
    filter->SetLowerThreshold(static_cast<float>(m_Middle));
    filter->SetInsideValue(1);
    filter->Update();
    return filter->GetOutput();
  }
};

TEST_F(FCCPixelwise, BinaryThreshold)
{
  ExpectEach(
    m_Image, MakeMask().GetPointer(), [this](double v) { return v >= static_cast<float>(m_Middle) ? 1.0 : 0.0; });
}

TEST_F(FCCPixelwise, RescaleIntensity)
{
  const auto filter = itk::RescaleIntensityImageFilter<LatticeType>::New();
  filter->SetInput(m_Image);
  filter->SetOutputMinimum(-1.0f);
  filter->SetOutputMaximum(1.0f);
  filter->Update();
  ExpectEach(m_Image, filter->GetOutput(), [this](double v) { return 2.0 * (v - m_Least) / (m_Most - m_Least) - 1.0; });
}

TEST_F(FCCPixelwise, UnaryGenerator)
{
  const auto filter = itk::UnaryGeneratorImageFilter<LatticeType, LatticeType>::New();
  filter->SetInput(m_Image);
  filter->SetFunctor([](const float & v) { return std::sqrt(std::abs(v)); });
  filter->Update();
  ExpectEach(m_Image, filter->GetOutput(), [](double v) { return std::sqrt(std::abs(v)); });
}

TEST_F(FCCPixelwise, CastToAnotherPixelType)
{
  const auto filter = itk::CastImageFilter<LatticeType, itk::FCCImage<std::int16_t>>::New();
  filter->SetInput(m_Image);
  filter->Update();
  ExpectEach(m_Image, filter->GetOutput(), [](double v) { return std::trunc(v); });
}

TEST_F(FCCPixelwise, Clamp)
{
  const auto filter = itk::ClampImageFilter<LatticeType, MaskType>::New();
  filter->SetInput(m_Image);
  filter->SetBounds(10, 50);
  filter->Update();
  ExpectEach(m_Image, filter->GetOutput(), [](double v) { return std::floor(std::min(50.0, std::max(10.0, v))); });
}

TEST_F(FCCPixelwise, ShiftScale)
{
  const auto filter = itk::ShiftScaleImageFilter<LatticeType, LatticeType>::New();
  filter->SetInput(m_Image);
  filter->SetShift(3.0);
  filter->SetScale(-0.5);
  filter->Update();
  ExpectEach(m_Image, filter->GetOutput(), [](double v) { return (v + 3.0) * -0.5; });
}

TEST_F(FCCPixelwise, AddAndSubtract)
{
  const auto sum = itk::AddImageFilter<LatticeType>::New();
  sum->SetInput1(m_Image);
  sum->SetInput2(m_Image);
  const auto difference = itk::SubtractImageFilter<LatticeType>::New();
  difference->SetInput1(sum->GetOutput());
  difference->SetConstant2(5.0f);
  difference->InPlaceOn();
  difference->Update();
  ExpectEach(m_Image, difference->GetOutput(), [](double v) { return 2.0 * v - 5.0; });
}

TEST_F(FCCPixelwise, ImagesOnOtherLatticesAreRefused)
{
  const auto moved = fcctest::MakeTurnedLinearField();
  moved->SetOrigin(moved->GetOrigin() + itk::Vector<double, 3>(0.5));
  const auto sum = itk::AddImageFilter<LatticeType>::New();
  sum->SetInput1(m_Image);
  sum->SetInput2(moved);
  EXPECT_THROW(sum->Update(), itk::ExceptionObject);
}

TEST_F(FCCPixelwise, Mask)
{
  const auto filter = itk::MaskImageFilter<LatticeType, MaskType>::New();
  filter->SetInput(m_Image);
  filter->SetMaskImage(MakeMask());
  filter->SetOutsideValue(-7.0f);
  filter->Update();
  ExpectEach(m_Image, filter->GetOutput(), [this](double v) { return v >= static_cast<float>(m_Middle) ? v : -7.0; });
}

TEST_F(FCCPixelwise, ScanlineIterators)
{
  std::vector<double> pixels;
  for (itk::ImageScanlineConstIterator<LatticeType> it(m_Image, m_Image->GetBufferedRegion()); !it.IsAtEnd();
       it.NextLine())
  {
    for (; !it.IsAtEndOfLine(); ++it)
    {
      pixels.push_back(it.Get());
    }
  }
  EXPECT_EQ(pixels, m_Pixels);
}

TEST_F(FCCPixelwise, StatisticsAndMinimumMaximum)
{
  const auto filter = itk::StatisticsImageFilter<LatticeType>::New();
  filter->SetInput(m_Image);
  filter->Update();
  const double mean = std::accumulate(m_Pixels.begin(), m_Pixels.end(), 0.0) / static_cast<double>(m_Pixels.size());
  EXPECT_NEAR(filter->GetMean(), mean, 1e-9);
  EXPECT_EQ(filter->GetMinimum(), static_cast<float>(m_Least));
  EXPECT_EQ(filter->GetMaximum(), static_cast<float>(m_Most));

  const auto calculator = itk::MinimumMaximumImageCalculator<LatticeType>::New();
  calculator->SetImage(m_Image);
  calculator->Compute();
  EXPECT_EQ(calculator->GetMaximum(), static_cast<float>(m_Most));
  EXPECT_EQ(m_Image->GetPixel(calculator->GetIndexOfMinimum()), static_cast<float>(m_Least));
}

TEST_F(FCCPixelwise, LabelStatistics)
{
  const auto filter = itk::LabelStatisticsImageFilter<LatticeType, MaskType>::New();
  filter->SetInput(m_Image);
  filter->SetLabelInput(MakeMask());
  filter->Update();
  const auto above =
    std::count_if(m_Pixels.begin(), m_Pixels.end(), [this](double v) { return v >= static_cast<float>(m_Middle); });
  EXPECT_EQ(filter->GetCount(1), static_cast<itk::SizeValueType>(above));
  EXPECT_EQ(filter->GetMaximum(1), static_cast<float>(m_Most));
}

TEST_F(FCCPixelwise, HistogramAndOtsuThreshold)
{
  fcctest::Sample(m_Image.GetPointer(), [](const auto & p) { return (p[0] > -18.0 ? 100.0 : 0.0) + std::sin(p[1]); });
  using HistogramFilterType = itk::Statistics::ImageToHistogramFilter<LatticeType>;
  const auto filter = HistogramFilterType::New();
  filter->SetInput(m_Image);
  HistogramFilterType::HistogramSizeType bins(1);
  bins.Fill(128);
  filter->SetHistogramSize(bins);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetTotalFrequency(), m_Pixels.size());
  const auto otsu = itk::OtsuThresholdCalculator<HistogramFilterType::HistogramType>::New();
  otsu->SetInput(filter->GetOutput());
  otsu->Compute();
  EXPECT_GT(otsu->GetThreshold(), 0.0);
  EXPECT_LT(otsu->GetThreshold(), 100.0);
}

TEST_F(FCCPixelwise, Duplicator)
{
  const auto duplicator = itk::ImageDuplicator<LatticeType>::New();
  duplicator->SetInputImage(m_Image);
  duplicator->Update();
  const LatticeType * const copy = duplicator->GetOutput();
  EXPECT_NE(copy->GetBufferPointer(), m_Image->GetBufferPointer());
  ExpectEach(m_Image, copy, [](double v) { return v; });
}

} // namespace
