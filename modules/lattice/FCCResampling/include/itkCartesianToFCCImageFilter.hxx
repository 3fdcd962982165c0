#ifndef itkCartesianToFCCImageFilter_hxx
#define itkCartesianToFCCImageFilter_hxx

#include "detail/itkProduceOutput.h"
#include "detail/itkRowArithmetic.h"
#include "itkFCCResamplingChecks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Density: " << m_Density << std::endl;
  os << indent << "OutputSpacing: " << m_OutputSpacing << std::endl;
  os << indent << "Kernel: " << m_Kernel << std::endl;
  os << indent << "SliceOrigins: ";
  PrintSliceOrigins(os, m_SliceOrigins);
  os << std::endl << indent << "SliceOrigins of the scan: ";
  PrintSliceOrigins(os, m_Scan.origins);
  os << std::endl << indent << "OutsideValue: ";
  if (m_OutsideValue)
  {
    os << static_cast<typename NumericTraits<OutputPixelType>::PrintType>(*m_OutsideValue) << std::endl;
  }
  else
  {
    os << "(lowest of the input)" << std::endl;
  }
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::SetSliceOrigins(const SliceOriginsType & sliceOrigins)
{
  if (m_SliceOrigins != sliceOrigins)
  {
    m_SliceOrigins = sliceOrigins;
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::SetOutsideValue(
  const std::optional<OutputPixelType> & outsideValue)
{
  if (m_OutsideValue != outsideValue)
  {
    m_OutsideValue = outsideValue;
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
auto
CartesianToFCCImageFilter<TInputImage, TOutputImage>::FindSliceOrigins() const -> SliceOriginsType
{
  return m_SliceOrigins.empty() ? itk::FindSliceOrigins(*this->GetInput(), m_Scan) : m_SliceOrigins;
}

template <typename TInputImage, typename TOutputImage>
bool
CartesianToFCCImageFilter<TInputImage, TOutputImage>::IsSlanted() const
{
  return !this->FindSliceOrigins().empty() || !AreAxesPerpendicular(this->GetInput()->GetDirection());
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  if (!(m_Density > 0.0) || !std::isfinite(m_Density))
  {
    itkExceptionMacro("Density must be a positive number of output samples per input sample, not "
                      << m_Density << "; the default is " << FCCLattice::DefaultDensity << ".");
  }
  if (m_Kernel > SeparableKernel::Lanczos4)
  {
    itkExceptionMacro("There is no Kernel number " << static_cast<int>(m_Kernel)
                                                   << "; use Linear, CubicBSpline or Lanczos4.");
  }
  if (!IsFCCSpacingOrUnset(m_OutputSpacing))
  {
    itkExceptionMacro("OutputSpacing must be positive along each axis, not "
                      << m_OutputSpacing << "; set it to zero along all of them to derive it from Density.");
  }
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::GenerateOutputInformation()
{
  const TInputImage * const input = this->GetInput();
  TOutputImage * const output = this->GetOutput();
  const auto & region = input->GetLargestPossibleRegion();
  if (region.GetNumberOfPixels() == 0)
  {
    itkExceptionMacro("The input has no samples; its size is " << region.GetSize() << ".");
  }

  std::optional<SliceStack> stack;
  SpacingType inputSpacing = input->GetSpacing();
  SpacingType lengths;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    lengths[axis] = static_cast<double>(region.GetSize(axis));
  }
  if (this->IsSlanted())
  {
    stack.emplace(*input, this->FindSliceOrigins());
    inputSpacing = stack->GetPitch();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      lengths[axis] = (stack->GetHighest()[axis] - stack->GetLowest()[axis]) / inputSpacing[axis];
    }
  }

  const double scale = std::cbrt(1.0 / (FCCLattice::CellVolume * m_Density));
  std::array<double, 3> counts{};
  SpacingType spacing;
  SpacingType first; // from the middle of the input's first sample to the lattice point (0, 0, 0), in samples
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    constexpr double tolerance = 1e-9; // relative to a sample, against rounding
    spacing[axis] = m_OutputSpacing[axis] > 0.0 ? m_OutputSpacing[axis] : scale * inputSpacing[axis];
    const double step = spacing[axis] / inputSpacing[axis];
    const double units = lengths[axis] / step;
    // Along x a row's samples are two units apart and the rows of the other parity are shifted by one, so that covering
    // the input with both takes one unit more.
    const double samples = axis == 0 ? (units + 1.0) / 2.0 : units;
    counts[axis] = std::max(1.0, std::ceil(samples - tolerance));
    const double span = axis == 0 ? 2.0 * counts[axis] - 1.0 : counts[axis] - 1.0;
    first[axis] = (lengths[axis] - 1.0 - span * step) / 2.0;
  }
  if (!IsFCCSizeCountable(counts))
  {
    itkExceptionMacro("The lattice would have " << counts[0] << " x " << counts[1] << " x " << counts[2]
                                                << " samples; use a larger OutputSpacing or a smaller Density.");
  }
  OutputImageRegionType outputRegion;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    outputRegion.SetSize(axis, static_cast<SizeValueType>(counts[axis]));
  }
  output->SetLargestPossibleRegion(outputRegion);
  output->SetSpacing(spacing);
  if (stack)
  {
    output->SetDirection(stack->GetDirection());
    SpacingType frame = stack->GetLowest();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      frame[axis] += (0.5 + first[axis]) * inputSpacing[axis];
    }
    output->SetOrigin(stack->TransformFrameToPoint(frame));
  }
  else
  {
    output->SetDirection(input->GetDirection());
    ContinuousIndex<double, 3> index;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      index[axis] = static_cast<double>(region.GetIndex(axis)) + first[axis];
    }
    output->SetOrigin(input->template TransformContinuousIndexToPhysicalPoint<double>(index));
  }
  output->SetNumberOfComponentsPerPixel(1);
}

template <typename TInputImage, typename TOutputImage>
CartesianToFCCRows
CartesianToFCCImageFilter<TInputImage, TOutputImage>::MakeRows() const
{
  return { *this->GetInput(), *this->GetOutput(), m_Kernel, this->FindSliceOrigins() };
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::GenerateInputRequestedRegion()
{
  Superclass::GenerateInputRequestedRegion();
  auto * const input = const_cast<TInputImage *>(this->GetInput());
  const OutputImageRegionType & requested = this->GetOutput()->GetRequestedRegion();
  InputImageRegionType needed = input->GetLargestPossibleRegion();
  if (requested.GetNumberOfPixels() > 0 && (m_OutsideValue || !this->IsSlanted()))
  {
    needed = this->MakeRows().FindNeededSamples(requested);
  }
  input->SetRequestedRegion(needed);
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::GenerateData()
{
  this->AllocateOutputs();
  const OutputPixelType outsideValue = this->IsSlanted() ? this->FindOutsideValue() : OutputPixelType{};
  ProduceOutput(*this, AllDivided, [=](const OutputImageRegionType & region, WorkProgress::Share & progress) {
    this->Resample(region, outsideValue, progress);
  });
}

template <typename TInputImage, typename TOutputImage>
auto
CartesianToFCCImageFilter<TInputImage, TOutputImage>::FindOutsideValue() -> OutputPixelType
{
  if (m_OutsideValue)
  {
    return *m_OutsideValue;
  }
  const TInputImage & input = *this->GetInput();
  if (m_LowestValueTime != input.GetMTime())
  {
    VerifyInputSamples(*this, input, input.GetLargestPossibleRegion());
    const InputPixelType * const begin = input.GetBufferPointer();
    const InputPixelType * const end = begin + input.GetBufferedRegion().GetNumberOfPixels();
    auto lowest = std::numeric_limits<InputPixelType>::max();
    std::for_each(begin, end, [&lowest](InputPixelType value) { lowest = value < lowest ? value : lowest; });
    m_LowestValue = RoundAndClamp<OutputPixelType>(static_cast<double>(lowest));
    m_LowestValueTime = input.GetMTime();
  }
  return m_LowestValue;
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::Resample(const OutputImageRegionType & region,
                                                               OutputPixelType outsideValue,
                                                               WorkProgress::Share & progress)
{
  const TInputImage * const input = this->GetInput();
  TOutputImage * const output = this->GetOutput();
  const auto load = [&](const Index<3> & start, SizeValueType length, float * row) {
    const auto * const samples = input->GetBufferPointer() + input->ComputeOffset(start);
    RowArithmetic::ConvertFrom(samples, length, row);
  };
  const auto store = [&](const Index<3> & start, SizeValueType length, const float * values) {
    const Index<3> rowStart{ { region.GetIndex(0), start[1], start[2] } };
    OutputPixelType * const row = output->GetBufferPointer() + output->ComputeOffset(rowStart);
    OutputPixelType * const begin = row + (start[0] - rowStart[0]);
    std::fill(row, begin, outsideValue);
    RowArithmetic::RoundTo(values, length, begin);
    std::fill(begin + length, row + region.GetSize(0), outsideValue);
    progress.Completed(region.GetSize(0));
  };

  this->MakeRows().Resample(region, load, store);
}

} // namespace itk

#endif
