#ifndef itkCartesianToNestedFCCImageFilter_hxx
#define itkCartesianToNestedFCCImageFilter_hxx

#include "detail/itkFCCMirror.h"
#include "detail/itkProduceOutput.h"
#include "detail/itkRowArithmetic.h"
#include "detail/itkRowPasses.h"
#include "itkFCCResamplingChecks.h"

#include <algorithm>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
void
CartesianToNestedFCCImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Antialiasing: " << (m_Antialiasing ? "On" : "Off") << std::endl;
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToNestedFCCImageFilter<TInputImage, TOutputImage>::GenerateOutputInformation()
{
  const TInputImage * const input = this->GetInput();
  TOutputImage * const output = this->GetOutput();
  const InputImageRegionType region = input->GetLargestPossibleRegion();
  if (region.GetNumberOfPixels() == 0)
  {
    itkExceptionMacro("The input has no samples; its size is " << region.GetSize() << ".");
  }
  if (!AreAxesPerpendicular(input->GetDirection()))
  {
    itkExceptionMacro("The input's axes are not perpendicular to each other, so that every other sample of it is no "
                      "face-centered cubic lattice; resample it with CartesianToFCCImageFilter instead.");
  }
  if (IsFromUnevenSlices(*input))
  {
    itkExceptionMacro("The input's slices are unevenly spaced, so that every other sample of it is no face-centered "
                      "cubic lattice; resample it with CartesianToFCCImageFilter instead.");
  }
  OutputImageRegionType outputRegion;
  outputRegion.SetSize(0, (region.GetSize(0) + 1) / 2);
  outputRegion.SetSize(1, region.GetSize(1));
  outputRegion.SetSize(2, region.GetSize(2));
  output->SetLargestPossibleRegion(outputRegion);
  output->SetSpacing(input->GetSpacing());
  output->SetDirection(input->GetDirection());
  output->SetOrigin(input->template TransformIndexToPhysicalPoint<double>(region.GetIndex()));
  output->SetNumberOfComponentsPerPixel(1);
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToNestedFCCImageFilter<TInputImage, TOutputImage>::GenerateInputRequestedRegion()
{
  Superclass::GenerateInputRequestedRegion();
  auto * const input = const_cast<TInputImage *>(this->GetInput());
  const OutputImageRegionType & requested = this->GetOutput()->GetRequestedRegion();
  const IndexValueType reach = m_Antialiasing ? HalfBandReach : 0;
  InputImageRegionType needed = input->GetLargestPossibleRegion();
  if (requested.GetNumberOfPixels() > 0)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const IndexValueType unitsPerIndex = axis == 0 ? 2 : 1;
      const IndexValueType begin = unitsPerIndex * requested.GetIndex(axis) - reach;
      const IndexValueType end = unitsPerIndex * (requested.GetUpperIndex()[axis] + 1) + reach;
      const auto length = static_cast<IndexValueType>(needed.GetSize(axis));
      IndexValueType first = length;
      IndexValueType last = 0;
      for (IndexValueType sample = begin; sample < end; ++sample)
      {
        const IndexValueType source = MirrorIntoRange(sample, 0, length - 1);
        first = std::min(first, source);
        last = std::max(last, source);
      }
      needed.SetIndex(axis, needed.GetIndex(axis) + first);
      needed.SetSize(axis, static_cast<SizeValueType>(last - first + 1));
    }
  }
  input->SetRequestedRegion(needed);
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToNestedFCCImageFilter<TInputImage, TOutputImage>::GenerateData()
{
  this->AllocateOutputs();
  ProduceOutput(*this, AllDivided, [this](const OutputImageRegionType & region, WorkProgress::Share & progress) {
    m_Antialiasing ? this->FilterSites(region, progress) : this->CopySites(region, progress);
  });
}

template <typename TInputImage, typename TOutputImage>
auto
CartesianToNestedFCCImageFilter<TInputImage, TOutputImage>::GetInputRow(IndexValueType y, IndexValueType z) const
  -> const PixelType *
{
  const TInputImage * const input = this->GetInput();
  auto index = input->GetLargestPossibleRegion().GetIndex();
  index[1] += y;
  index[2] += z;
  return input->GetBufferPointer() + input->ComputeOffset(index);
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToNestedFCCImageFilter<TInputImage, TOutputImage>::CopySites(const OutputImageRegionType & region,
                                                                      WorkProgress::Share & progress)
{
  TOutputImage * const output = this->GetOutput();
  const auto length = static_cast<IndexValueType>(this->GetInput()->GetLargestPossibleRegion().GetSize(0));

  auto index = region.GetIndex();
  for (index[2] = region.GetIndex(2); index[2] <= region.GetUpperIndex()[2]; ++index[2])
  {
    for (index[1] = region.GetIndex(1); index[1] <= region.GetUpperIndex()[1]; ++index[1])
    {
      const PixelType * const inputRow = this->GetInputRow(index[1], index[2]);
      PixelType * const outputRow = output->GetBufferPointer() + output->ComputeOffset(index);
      const auto count = static_cast<IndexValueType>(region.GetSize(0));
      const IndexValueType first = FCCLattice::SiteOf(index)[0];
      for (IndexValueType i = 0; i < count - 1; ++i)
      {
        outputRow[i] = inputRow[first + 2 * i];
      }
      // Only a row's last site may lie beyond the input.
      outputRow[count - 1] = inputRow[MirrorIntoRange(first + 2 * (count - 1), 0, length - 1)];
      progress.Completed(region.GetSize(0));
    }
  }
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToNestedFCCImageFilter<TInputImage, TOutputImage>::FilterSites(const OutputImageRegionType & region,
                                                                        WorkProgress::Share & progress)
{
  TOutputImage * const output = this->GetOutput();
  FilterHalfBandRows(
    this->GetInput()->GetLargestPossibleRegion().GetSize(),
    region,
    [&](const Index<3> & start, SizeValueType length, float * row) {
      RowArithmetic::ConvertFrom(this->GetInputRow(start[1], start[2]) + start[0], length, row);
    },
    [&](const Index<3> & start, SizeValueType length, const float * values) {
      RowArithmetic::RoundTo(values, length, output->GetBufferPointer() + output->ComputeOffset(start));
      progress.Completed(length);
    });
}

} // namespace itk

#endif
