#ifndef itkCartesianToFCCImageFilter_hxx
#define itkCartesianToFCCImageFilter_hxx

#include "itkFCCResamplingChecks.h"
#include "itkTotalProgressReporter.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace CartesianToFCC
{

/** sum[x] = or += weight * row[x]; the first term of a sum sets, the others add. */
template <typename TPixel>
void
Accumulate(const TPixel * row, float weight, SizeValueType length, bool first, float * sum)
{
  if (first)
  {
    for (SizeValueType x = 0; x < length; ++x)
    {
      sum[x] = weight * static_cast<float>(row[x]);
    }
  }
  else
  {
    for (SizeValueType x = 0; x < length; ++x)
    {
      sum[x] += weight * static_cast<float>(row[x]);
    }
  }
}

/** Weighted sum of consecutive values, in four lanes so that it becomes SIMD code and its order of additions is fixed.
 */
inline float
WeightedSum(const float * values, const float * weights, SizeValueType count)
{
  float lanes[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
  SizeValueType n = 0;
  for (; n + 4 <= count; n += 4)
  {
    for (SizeValueType lane = 0; lane < 4; ++lane)
    {
      lanes[lane] += weights[n + lane] * values[n + lane];
    }
  }
  for (SizeValueType lane = 0; n < count; ++n, ++lane)
  {
    lanes[lane] += weights[n] * values[n];
  }
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

} // namespace CartesianToFCC

template <typename TInputImage, typename TOutputImage>
CartesianToFCCImageFilter<TInputImage, TOutputImage>::CartesianToFCCImageFilter()
{
  this->DynamicMultiThreadingOn();
  this->ThreaderUpdateProgressOff();
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Density: " << m_Density << std::endl;
  os << indent << "OutputSpacing: " << m_OutputSpacing << std::endl;
  os << indent << "Kernel: " << (m_Kernel == SeparableKernel::Linear ? "Linear" : "CubicBSpline") << std::endl;
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  if (!(m_Density > 0.0) || !std::isfinite(m_Density))
  {
    itkExceptionMacro("Density must be a positive number of output samples per input sample, not "
                      << m_Density << "; the default is " << FCCLattice::NyquistDensity << ".");
  }
  if (!IsSpacingOrUnset(m_OutputSpacing))
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

  const double scale = std::cbrt(1.0 / (FCCLattice::CellVolume * m_Density));
  std::array<double, 3> counts{};
  SpacingType spacing;
  ContinuousIndex<double, 3> first; // the lattice point (0, 0, 0) in the input
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double inputSpacing = input->GetSpacing()[axis];
    const auto length = static_cast<double>(region.GetSize(axis));
    spacing[axis] = m_OutputSpacing[axis] > 0.0 ? m_OutputSpacing[axis] : scale * inputSpacing;

    // Along x a row's samples are two units apart and the rows of the other parity are shifted by one, so that covering
    // the input with both takes one unit more.
    constexpr double tolerance = 1e-9; // of a sample, against rounding
    const double step = spacing[axis] / inputSpacing;
    const double units = length / step;
    const double samples = axis == 0 ? (units + 1.0) / 2.0 : units;
    const double count = std::max(1.0, std::ceil(samples - tolerance));
    const double span = axis == 0 ? 2.0 * count - 1.0 : count - 1.0;
    counts[axis] = count;
    first[axis] = static_cast<double>(region.GetIndex(axis)) + (length - 1.0 - span * step) / 2.0;
  }
  if (!IsCountable(counts))
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
  output->SetDirection(input->GetDirection());
  output->SetOrigin(input->template TransformContinuousIndexToPhysicalPoint<double>(first));
  output->SetNumberOfComponentsPerPixel(1);
}

template <typename TInputImage, typename TOutputImage>
SeparableTaps
CartesianToFCCImageFilter<TInputImage, TOutputImage>::MakeTaps(unsigned int axis,
                                                               const OutputImageRegionType & region,
                                                               IndexValueType parity) const
{
  const TInputImage * const input = this->GetInput();
  const TOutputImage * const output = this->GetOutput();
  // The output's axes are the input's: along each, positions depend on one lattice coordinate alone.
  const auto first = input->template TransformPhysicalPointToContinuousIndex<double>(output->GetOrigin());
  const double start = first[axis] - static_cast<double>(input->GetLargestPossibleRegion().GetIndex(axis));
  const double step = output->GetSpacing()[axis] / input->GetSpacing()[axis];

  std::vector<double> positions(region.GetSize(axis));
  for (SizeValueType n = 0; n < positions.size(); ++n)
  {
    const auto index = region.GetIndex(axis) + static_cast<IndexValueType>(n);
    positions[n] = start + step * static_cast<double>(axis == 0 ? 2 * index + parity : index);
  }
  return SeparableTaps(m_Kernel, input->GetLargestPossibleRegion().GetSize(axis), positions);
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::GenerateInputRequestedRegion()
{
  Superclass::GenerateInputRequestedRegion();
  auto * const input = const_cast<TInputImage *>(this->GetInput());
  const OutputImageRegionType & requested = this->GetOutput()->GetRequestedRegion();
  InputImageRegionType needed = input->GetLargestPossibleRegion();
  if (requested.GetNumberOfPixels() > 0)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const SeparableTaps even = this->MakeTaps(axis, requested, 0);
      const SeparableTaps odd = this->MakeTaps(axis, requested, 1); // the same as even, but along x
      const SizeValueType first = even.GetFirst(0);
      const SizeValueType last = odd.GetFirst(requested.GetSize(axis) - 1) + odd.GetNumberOfTaps();
      needed.SetIndex(axis, needed.GetIndex(axis) + static_cast<IndexValueType>(first));
      needed.SetSize(axis, last - first);
    }
  }
  input->SetRequestedRegion(needed);
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::DynamicThreadedGenerateData(const OutputImageRegionType & region)
{
  m_ThreadFailure.Capture([&] { this->Resample(region); });
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::AfterThreadedGenerateData()
{
  m_ThreadFailure.Rethrow();
  this->UpdateProgress(1.0f); // the threads' last reports may have come from another one than the observers'
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::Resample(const OutputImageRegionType & region)
{
  const TInputImage * const input = this->GetInput();
  TOutputImage * const output = this->GetOutput();
  const InputImageRegionType buffered = input->GetBufferedRegion();
  const auto & whole = input->GetLargestPossibleRegion();
  TotalProgressReporter progress(this, output->GetRequestedRegion().GetNumberOfPixels());

  const SeparableTaps xTaps[2] = { this->MakeTaps(0, region, 0), this->MakeTaps(0, region, 1) };
  const SeparableTaps yTaps = this->MakeTaps(1, region);
  const SeparableTaps zTaps = this->MakeTaps(2, region);

  // Samples of the input, counted from its first one, that this region needs along x and y.
  const SizeValueType xFirst = xTaps[0].GetFirst(0);
  const SizeValueType xCount = xTaps[1].GetFirst(region.GetSize(0) - 1) + xTaps[1].GetNumberOfTaps() - xFirst;
  const SizeValueType yFirst = yTaps.GetFirst(0);
  const SizeValueType yCount = yTaps.GetFirst(region.GetSize(1) - 1) + yTaps.GetNumberOfTaps() - yFirst;

  const auto inputRow = [&](SizeValueType y, SizeValueType z) {
    typename TInputImage::IndexType index = whole.GetIndex();
    index[0] += static_cast<IndexValueType>(xFirst);
    index[1] += static_cast<IndexValueType>(y);
    index[2] += static_cast<IndexValueType>(z);
    return input->GetBufferPointer() + input->ComputeOffset(index);
  };

  std::vector<float> plane(xCount * yCount);
  std::vector<float> row(xCount);
  for (SizeValueType k = 0; k < region.GetSize(2); ++k)
  {
    for (SizeValueType y = 0; y < yCount; ++y)
    {
      for (SizeValueType tap = 0; tap < zTaps.GetNumberOfTaps(); ++tap)
      {
        CartesianToFCC::Accumulate(inputRow(yFirst + y, zTaps.GetFirst(k) + tap),
                                   zTaps.GetWeights(k)[tap],
                                   xCount,
                                   tap == 0,
                                   plane.data() + y * xCount);
      }
    }
    for (SizeValueType j = 0; j < region.GetSize(1); ++j)
    {
      for (SizeValueType tap = 0; tap < yTaps.GetNumberOfTaps(); ++tap)
      {
        CartesianToFCC::Accumulate(plane.data() + (yTaps.GetFirst(j) - yFirst + tap) * xCount,
                                   yTaps.GetWeights(j)[tap],
                                   xCount,
                                   tap == 0,
                                   row.data());
      }
      const typename TOutputImage::IndexType index{ { region.GetIndex(0),
                                                      region.GetIndex(1) + static_cast<IndexValueType>(j),
                                                      region.GetIndex(2) + static_cast<IndexValueType>(k) } };
      const SeparableTaps & taps = xTaps[FCCLattice::Parity(index[1], index[2])];
      OutputPixelType * const outputRow = output->GetBufferPointer() + output->ComputeOffset(index);
      for (SizeValueType i = 0; i < region.GetSize(0); ++i)
      {
        outputRow[i] = RoundAndClamp<OutputPixelType>(CartesianToFCC::WeightedSum(
          row.data() + (taps.GetFirst(i) - xFirst), taps.GetWeights(i), taps.GetNumberOfTaps()));
      }
      progress.Completed(region.GetSize(0));
    }
  }
}

} // namespace itk

#endif
