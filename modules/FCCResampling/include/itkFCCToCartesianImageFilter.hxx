#ifndef itkFCCToCartesianImageFilter_hxx
#define itkFCCToCartesianImageFilter_hxx

#include "itkFCCLinearInterpolateImageFunction.h"
#include "itkFCCResamplingChecks.h"
#include "itkImageScanlineIterator.h"
#include "itkTotalProgressReporter.h"

namespace itk
{

template <typename TInputImage, typename TOutputImage>
FCCToCartesianImageFilter<TInputImage, TOutputImage>::FCCToCartesianImageFilter()
{
  this->AddOptionalInputName("ReferenceImage", 1);
  this->DynamicMultiThreadingOn();
  this->ThreaderUpdateProgressOff();
}

template <typename TInputImage, typename TOutputImage>
void
FCCToCartesianImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "OutputSpacing: " << m_OutputSpacing << std::endl;
  os << indent
     << "DefaultPixelValue: " << static_cast<typename NumericTraits<OutputPixelType>::PrintType>(m_DefaultPixelValue)
     << std::endl;
}

template <typename TInputImage, typename TOutputImage>
void
FCCToCartesianImageFilter<TInputImage, TOutputImage>::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  if (!IsSpacingOrUnset(m_OutputSpacing))
  {
    itkExceptionMacro("OutputSpacing must be positive along each axis, not "
                      << m_OutputSpacing << "; set it to zero along all of them to derive it from the input's.");
  }
}

template <typename TInputImage, typename TOutputImage>
void
FCCToCartesianImageFilter<TInputImage, TOutputImage>::GenerateOutputInformation()
{
  const TInputImage * const input = this->GetInput();
  TOutputImage * const output = this->GetOutput();
  if (const ReferenceImageType * const reference = this->GetReferenceImage())
  {
    output->CopyInformation(reference);
    return;
  }

  const auto & extent = input->GetLargestPossibleRegion();
  const double scale = std::cbrt(FCCLattice::CellVolume * FCCLattice::NyquistDensity);
  std::array<double, 3> counts{};
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
    counts[axis] = std::max(1.0, std::floor(units / step + tolerance));
    first[axis] = begin + (units - (counts[axis] - 1.0) * step) / 2.0;
  }
  if (!IsCountable(counts))
  {
    itkExceptionMacro("The grid would have " << counts[0] << " x " << counts[1] << " x " << counts[2]
                                             << " samples; use a larger OutputSpacing.");
  }
  OutputImageRegionType region;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    region.SetSize(axis, static_cast<SizeValueType>(counts[axis]));
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
  if (const ReferenceImageType * const reference = this->GetReferenceImage())
  {
    const_cast<ReferenceImageType *>(reference)->SetRequestedRegion(reference->GetBufferedRegion());
  }
}

template <typename TInputImage, typename TOutputImage>
void
FCCToCartesianImageFilter<TInputImage, TOutputImage>::DynamicThreadedGenerateData(const OutputImageRegionType & region)
{
  m_ThreadFailure.Capture([&] { this->Resample(region); });
}

template <typename TInputImage, typename TOutputImage>
void
FCCToCartesianImageFilter<TInputImage, TOutputImage>::AfterThreadedGenerateData()
{
  m_ThreadFailure.Rethrow();
  this->UpdateProgress(1.0f); // the threads' last reports may have come from another one than the observers'
}

template <typename TInputImage, typename TOutputImage>
void
FCCToCartesianImageFilter<TInputImage, TOutputImage>::Resample(const OutputImageRegionType & region)
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
      it.Set(RoundAndClamp<OutputPixelType>(value));
    }
    progress.Completed(region.GetSize(0));
  }
}

} // namespace itk

#endif
