#ifndef itkFCCToCartesianImageFilter_hxx
#define itkFCCToCartesianImageFilter_hxx

#include "detail/itkProduceOutput.h"
#include "itkFCCLinearInterpolateImageFunction.h"
#include "itkFCCResamplingChecks.h"
#include "itkImageScanlineIterator.h"

#include <algorithm>
#include <cmath>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
FCCToCartesianImageFilter<TInputImage, TOutputImage>::FCCToCartesianImageFilter()
{
  this->AddOptionalInputName("ReferenceImage", 1);
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
  if (!IsFCCSpacingOrUnset(m_OutputSpacing))
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
  const auto & extent = input->GetLargestPossibleRegion();
  if (extent.GetNumberOfPixels() == 0)
  {
    itkExceptionMacro("The input has no samples; its size is " << extent.GetSize() << ".");
  }
  if (const ReferenceImageType * const reference = this->GetReferenceImage())
  {
    output->CopyInformation(reference);
    return;
  }

  const double scale = std::cbrt(FCCLattice::CellVolume * FCCLattice::NyquistDensity);
  std::array<double, 3> counts{};
  SpacingType spacing;
  std::array<double, 3> first{}; // the first voxel's centre in lattice coordinates
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    constexpr double tolerance = 1e-9; // relative to a voxel, against rounding
    const double unitsPerIndex = axis == 0 ? 2.0 : 1.0;
    const double units = unitsPerIndex * static_cast<double>(extent.GetSize(axis));
    const double begin = unitsPerIndex * static_cast<double>(extent.GetIndex(axis)) - 0.5;
    spacing[axis] = m_OutputSpacing[axis] > 0.0 ? m_OutputSpacing[axis] : scale * input->GetSpacing()[axis];
    const double step = spacing[axis] / input->GetSpacing()[axis];
    counts[axis] = std::max(1.0, std::floor(units / step + tolerance));
    first[axis] = begin + (units - (counts[axis] - 1.0) * step) / 2.0;
  }
  if (!IsFCCSizeCountable(counts))
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
  const_cast<TInputImage *>(this->GetInput())
    ->SetRequestedRegion(this->FindNeededSamples(this->GetOutput()->GetRequestedRegion()));
  if (const ReferenceImageType * const reference = this->GetReferenceImage())
  {
    const_cast<ReferenceImageType *>(reference)->SetRequestedRegion(reference->GetBufferedRegion());
  }
}

template <typename TInputImage, typename TOutputImage>
auto
FCCToCartesianImageFilter<TInputImage, TOutputImage>::FindNeededSamples(const OutputImageRegionType & region) const ->
  typename TInputImage::RegionType
{
  const TInputImage * const input = this->GetInput();
  std::array<double, 3> lowest{}; // lowest centre of a voxel, in lattice coordinates
  std::array<double, 3> highest{};
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    auto index = region.GetIndex();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      index[axis] += (corner >> axis & 1) != 0 ? static_cast<IndexValueType>(region.GetSize(axis)) - 1 : 0;
    }
    const auto coordinates =
      input->TransformPhysicalPointToLattice(this->GetOutput()->template TransformIndexToPhysicalPoint<double>(index));
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      lowest[axis] = corner == 0 ? coordinates[axis] : std::min(lowest[axis], coordinates[axis]);
      highest[axis] = corner == 0 ? coordinates[axis] : std::max(highest[axis], coordinates[axis]);
    }
  }

  const auto & whole = input->GetLargestPossibleRegion();
  typename TInputImage::RegionType needed;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    // The sites of a point's tetrahedron are at most this far from it, see LocateFCCTetrahedron(); and for rounding.
    const double reach = (axis == 0 ? 2.0 : 1.0) + 1e-6;
    const double unitsPerIndex = axis == 0 ? 2.0 : 1.0;
    const auto first = static_cast<double>(whole.GetIndex(axis));
    const auto last = static_cast<double>(whole.GetUpperIndex()[axis]);
    const double begin = std::clamp(std::floor((lowest[axis] - reach) / unitsPerIndex), first, last);
    const double end = std::clamp(std::floor((highest[axis] + reach) / unitsPerIndex), first, last);
    needed.SetIndex(axis, static_cast<IndexValueType>(begin));
    needed.SetSize(axis, static_cast<SizeValueType>(end - begin) + 1);
  }
  return needed;
}

template <typename TInputImage, typename TOutputImage>
void
FCCToCartesianImageFilter<TInputImage, TOutputImage>::GenerateData()
{
  this->AllocateOutputs();
  ProduceOutput(*this, AllDivided, [this](const OutputImageRegionType & region, WorkProgress::Share & progress) {
    this->Resample(region, progress);
  });
}

template <typename TInputImage, typename TOutputImage>
void
FCCToCartesianImageFilter<TInputImage, TOutputImage>::Resample(const OutputImageRegionType & region,
                                                               WorkProgress::Share & progress)
{
  const TInputImage * const input = this->GetInput();
  TOutputImage * const output = this->GetOutput();
  const auto interpolator = FCCLinearInterpolateImageFunction<TInputImage>::New();
  interpolator->SetInputImage(input);

  for (ImageScanlineIterator<TOutputImage> it(output, region); !it.IsAtEnd(); it.NextLine())
  {
    auto index = it.GetIndex();
    for (; !it.IsAtEndOfLine(); ++it, ++index[0])
    {
      const auto point = output->template TransformIndexToPhysicalPoint<double>(index);
      ContinuousIndex<double, 3> continuous;
      if (!input->TransformPhysicalPointToContinuousIndex(point, continuous))
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
