#ifndef itkFCCToCartesianImageFilter_hxx
#define itkFCCToCartesianImageFilter_hxx

#include "itkFCCLinearInterpolateImageFunction.h"
#include "itkImageScanlineIterator.h"
#include "itkTotalProgressReporter.h"

namespace itk
{

template <typename TInputImage, typename TOutputImage>
FCCToCartesianImageFilter<TInputImage, TOutputImage>::FCCToCartesianImageFilter()
{
  this->DynamicMultiThreadingOn();
  this->ThreaderUpdateProgressOff();
}

template <typename TInputImage, typename TOutputImage>
void
FCCToCartesianImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "OutputSpacing: " << m_OutputSpacing << std::endl;
  os << indent << "ReferenceImage: " << m_ReferenceImage.GetPointer() << std::endl;
  os << indent
     << "DefaultPixelValue: " << static_cast<typename NumericTraits<OutputPixelType>::PrintType>(m_DefaultPixelValue)
     << std::endl;
}

template <typename TInputImage, typename TOutputImage>
void
FCCToCartesianImageFilter<TInputImage, TOutputImage>::VerifyInputInformation() ITKv5_CONST
{
  // There is one input only; the superclass would compare its fake index geometry.
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (m_OutputSpacing[axis] < 0.0)
    {
      itkExceptionMacro("OutputSpacing must not be negative, but is "
                        << m_OutputSpacing << "; set it to zero to derive it from the input's.");
    }
  }
}

template <typename TInputImage, typename TOutputImage>
void
FCCToCartesianImageFilter<TInputImage, TOutputImage>::GenerateOutputInformation()
{
  const TInputImage * const input = this->GetInput();
  TOutputImage * const output = this->GetOutput();
  if (m_ReferenceImage)
  {
    output->SetLargestPossibleRegion(m_ReferenceImage->GetLargestPossibleRegion());
    output->SetSpacing(m_ReferenceImage->GetSpacing());
    output->SetOrigin(m_ReferenceImage->GetOrigin());
    output->SetDirection(m_ReferenceImage->GetDirection());
    return;
  }

  const auto & extent = input->GetLargestPossibleRegion();
  const double scale = std::cbrt(FCCLattice::CellVolume * FCCLattice::NyquistDensity);
  OutputImageRegionType region;
  SpacingType spacing;
  std::array<double, 3> first{}; // the first voxel's centre in lattice coordinates
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    constexpr double tolerance = 1e-9; // of a voxel, against rounding
    const double unitsPerIndex = axis == 0 ? 2.0 : 1.0;
    const double units = unitsPerIndex * static_cast<double>(extent.GetSize(axis));
    const double begin = unitsPerIndex * static_cast<double>(extent.GetIndex(axis)) - 0.5;
    spacing[axis] = m_OutputSpacing[axis] > 0.0 ? m_OutputSpacing[axis] : scale * input->GetSpacing()[axis];
    const double step = spacing[axis] / input->GetSpacing()[axis];
    const double count = std::max(1.0, std::floor(units / step + tolerance));
    region.SetSize(axis, static_cast<SizeValueType>(count));
    first[axis] = begin + (units - (count - 1.0) * step) / 2.0;
  }
  output->SetLargestPossibleRegion(region);
  output->SetSpacing(spacing);
  output->SetDirection(input->GetDirection());
  output->SetOrigin(input->template TransformLatticeToPhysicalPoint<double>(first));
}

template <typename TInputImage, typename TOutputImage>
void
FCCToCartesianImageFilter<TInputImage, TOutputImage>::GenerateInputRequestedRegion()
{
  const_cast<TInputImage *>(this->GetInput())->SetRequestedRegionToLargestPossibleRegion();
}

template <typename TInputImage, typename TOutputImage>
void
FCCToCartesianImageFilter<TInputImage, TOutputImage>::DynamicThreadedGenerateData(const OutputImageRegionType & region)
{
  const TInputImage * const input = this->GetInput();
  TOutputImage * const output = this->GetOutput();
  TotalProgressReporter progress(this, output->GetRequestedRegion().GetNumberOfPixels());
  const auto interpolator = FCCLinearInterpolateImageFunction<TInputImage>::New();
  interpolator->SetInputImage(input);

  for (ImageScanlineIterator<TOutputImage> it(output, region); !it.IsAtEnd(); it.NextLine())
  {
    auto index = it.GetIndex();
    for (; !it.IsAtEndOfLine(); ++it, ++index[0])
    {
      const auto point = output->template TransformIndexToPhysicalPoint<double>(index);
      ContinuousIndex<double, 3> continuous;
      input->TransformPhysicalPointToContinuousIndex(point, continuous);
      if (!interpolator->IsInsideBuffer(continuous))
      {
        it.Set(m_DefaultPixelValue);
        continue;
      }
      const double value = interpolator->EvaluateAtContinuousIndex(continuous);
      if constexpr (std::is_integral_v<OutputPixelType>)
      {
        it.Set(Math::Round<OutputPixelType>(value));
      }
      else
      {
        it.Set(static_cast<OutputPixelType>(value));
      }
    }
    progress.Completed(region.GetSize(0));
  }
}

} // namespace itk

#endif
