#ifndef itkFCCGaussianImageFilter_hxx
#define itkFCCGaussianImageFilter_hxx

#include "detail/itkProduceOutput.h"
#include "detail/itkRowArithmetic.h"
#include "detail/itkRowPasses.h"
#include "itkFCCResamplingChecks.h"

#include <algorithm>
#include <cmath>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Sigma: " << m_Sigma << std::endl;
}

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  if (!(m_Sigma >= 0.0) || !std::isfinite(m_Sigma))
  {
    itkExceptionMacro("Sigma must be a number of mm from 0 on, not " << m_Sigma << "; try 1.");
  }
}

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::VerifyInputInformation() ITKv5_CONST
{
  Superclass::VerifyInputInformation();
  if (!AreAxesPerpendicular(this->GetInput()->GetDirection()))
  {
    itkExceptionMacro("The lattice's axes are not perpendicular, so that no Gaussian on it is isotropic; resample the "
                      "scan with CartesianToFCCImageFilter, whose lattices are.");
  }
  const auto variances = this->GetVariances();
  const double reach = 4.0 * std::sqrt(*std::max_element(variances.begin(), variances.end()));
  if (!(reach <= FCCGaussianTaps::MaximumReach))
  {
    itkExceptionMacro("A Sigma of " << m_Sigma << " mm is out of proportion to the lattice's spacing of "
                                    << this->GetInput()->GetSpacing() << " mm; use at most "
                                    << m_Sigma * FCCGaussianTaps::MaximumReach / reach << '.');
  }
}

template <typename TInputImage, typename TOutputImage>
std::array<double, 3>
FCCGaussianImageFilter<TInputImage, TOutputImage>::GetVariances() const
{
  const TInputImage * const input = this->GetInput();
  std::array<double, 3> variances{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    // Rows hold samples of one parity; other axes need two planes for that.
    if (axis == 0 || input->GetLargestPossibleRegion().GetSize(axis) > 1)
    {
      const double unit = input->GetSpacing()[axis] * input->GetDirection().GetVnlMatrix().get_column(axis).magnitude();
      variances[axis] = m_Sigma * m_Sigma / (unit * unit);
    }
  }
  return variances;
}

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::GenerateInputRequestedRegion()
{
  Superclass::GenerateInputRequestedRegion();
  if (m_Sigma > 0.0)
  {
    auto * const input = const_cast<TInputImage *>(this->GetInput());
    const FCCGaussianTaps taps(this->GetVariances());
    input->SetRequestedRegion(
      taps.AddReach(this->GetOutput()->GetRequestedRegion(), input->GetLargestPossibleRegion()));
  }
}

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::GenerateData()
{
  this->AllocateOutputs();
  const FCCGaussianTaps taps(this->GetVariances());
  constexpr unsigned int undivided = 2; // blocks of rows share the planes within reach
  ProduceOutput(*this, undivided, [&](const RegionType & region, WorkProgress::Share & progress) {
    m_Sigma > 0.0 ? this->Smooth(region, taps, progress) : this->Copy(region, progress);
  });
}

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::Copy(const RegionType & region, WorkProgress::Share & progress)
{
  TOutputImage * const output = this->GetOutput();
  const auto end = region.GetIndex() + region.GetSize();
  auto index = region.GetIndex();
  for (; index[2] < end[2]; ++index[2])
  {
    for (index[1] = region.GetIndex(1); index[1] < end[1]; ++index[1])
    {
      const InputPixelType * const row = this->GetInputRow(index);
      std::transform(row,
                     row + region.GetSize(0),
                     output->GetBufferPointer() + output->ComputeOffset(index),
                     [](auto value) { return static_cast<OutputPixelType>(value); });
      progress.Completed(region.GetSize(0));
    }
  }
}

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::Smooth(const RegionType & region,
                                                          const FCCGaussianTaps & taps,
                                                          WorkProgress::Share & progress)
{
  TOutputImage * const output = this->GetOutput();
  bool isAllFinite = true;
  SmoothRows(
    taps,
    this->GetInput()->GetLargestPossibleRegion(),
    region,
    [&](const Index<3> & start, SizeValueType length, float * row) {
      progress.CheckAbort();
      RowArithmetic::ConvertFrom(this->GetInputRow(start), length, row);
      if constexpr (std::is_floating_point<InputPixelType>::value)
      {
        for (SizeValueType n = 0; n < length; ++n)
        {
          const bool isFinite = std::isfinite(row[n]);
          isAllFinite = isAllFinite && isFinite;
          row[n] = isFinite ? row[n] : 0.0f;
        }
      }
    },
    [&](const Index<3> & start, SizeValueType length, const float * values) {
      RowArithmetic::RoundTo(values, length, output->GetBufferPointer() + output->ComputeOffset(start));
      progress.Completed(length);
    });
  if constexpr (std::is_floating_point<InputPixelType>::value)
  {
    if (!isAllFinite)
    {
      this->AverageFiniteSamples(region, taps, progress);
    }
  }
}

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::AverageFiniteSamples(const RegionType & region,
                                                                        const FCCGaussianTaps & taps,
                                                                        WorkProgress::Share & progress)
{
  const RegionType & whole = this->GetInput()->GetLargestPossibleRegion();
  TOutputImage * const output = this->GetOutput();
  float allWeights = 0.0f; // makes the division of a sample without such neighbours one by exactly 1
  SmoothRows(
    taps,
    whole,
    { region.GetIndex(), { { 1, 1, 1 } } },
    [](const Index<3> &, SizeValueType length, float * row) { std::fill_n(row, length, 1.0f); },
    [&](const Index<3> &, SizeValueType, const float * values) { allWeights = values[0]; });
  SmoothRows(
    taps,
    whole,
    region,
    [&](const Index<3> & start, SizeValueType length, float * row) {
      progress.CheckAbort();
      const InputPixelType * const samples = this->GetInputRow(start);
      std::transform(samples, samples + length, row, [](auto value) { return std::isfinite(value) ? 1.0f : 0.0f; });
    },
    [&](const Index<3> & start, SizeValueType length, const float * weights) {
      const InputPixelType * const own = this->GetInputRow(start);
      OutputPixelType * const row = output->GetBufferPointer() + output->ComputeOffset(start);
      for (SizeValueType n = 0; n < length; ++n)
      {
        row[n] = static_cast<OutputPixelType>(std::isfinite(own[n]) ? row[n] / (weights[n] / allWeights) : own[n]);
      }
    });
}

} // namespace itk

#endif
