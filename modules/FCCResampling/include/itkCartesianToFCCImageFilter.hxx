#ifndef itkCartesianToFCCImageFilter_hxx
#define itkCartesianToFCCImageFilter_hxx

#include "itkFCCResamplingChecks.h"
#include "itkHugePages.h"
#include "itkInputSamples.h"
#include "itkRowArithmetic.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace itk
{

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
  os << indent << "Kernel: " << m_Kernel << std::endl;
  os << indent << "SliceOrigins: " << m_SliceOrigins.size() << std::endl;
  os << indent << "OutsideValue: " << static_cast<typename NumericTraits<OutputPixelType>::PrintType>(m_OutsideValue)
     << std::endl;
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
bool
CartesianToFCCImageFilter<TInputImage, TOutputImage>::IsSlanted() const
{
  return !m_SliceOrigins.empty() || !AreAxesPerpendicular(this->GetInput()->GetDirection());
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
  if (m_Kernel > SeparableKernel::Lanczos4)
  {
    itkExceptionMacro("There is no Kernel number " << static_cast<int>(m_Kernel)
                                                   << "; use Linear, CubicBSpline or Lanczos4.");
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

  std::optional<SliceStack> stack;
  SpacingType inputSpacing = input->GetSpacing();
  SpacingType lengths;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    lengths[axis] = static_cast<double>(region.GetSize(axis));
  }
  if (this->IsSlanted())
  {
    stack.emplace(*input, m_SliceOrigins);
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
    const double length = lengths[axis];
    spacing[axis] = m_OutputSpacing[axis] > 0.0 ? m_OutputSpacing[axis] : scale * inputSpacing[axis];

    // Along x a row's samples are two units apart and the rows of the other parity are shifted by one, so that covering
    // the input with both takes one unit more.
    constexpr double tolerance = 1e-9; // of a sample, against rounding
    const double step = spacing[axis] / inputSpacing[axis];
    const double units = length / step;
    const double samples = axis == 0 ? (units + 1.0) / 2.0 : units;
    const double count = std::max(1.0, std::ceil(samples - tolerance));
    const double span = axis == 0 ? 2.0 * count - 1.0 : count - 1.0;
    counts[axis] = count;
    first[axis] = (length - 1.0 - span * step) / 2.0;
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
SliceStackPlanes
CartesianToFCCImageFilter<TInputImage, TOutputImage>::MakePlanes(const SliceStack & stack,
                                                                 const OutputImageRegionType & region) const
{
  const TOutputImage * const output = this->GetOutput();
  return SliceStackPlanes(stack,
                          m_Kernel,
                          this->GetInput()->GetLargestPossibleRegion().GetSize(),
                          stack.TransformPointToFrame(output->GetOrigin()),
                          output->GetSpacing(),
                          region);
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::GenerateInputRequestedRegion()
{
  Superclass::GenerateInputRequestedRegion();
  auto * const input = const_cast<TInputImage *>(this->GetInput());
  const OutputImageRegionType & requested = this->GetOutput()->GetRequestedRegion();
  InputImageRegionType needed = input->GetLargestPossibleRegion();
  if (requested.GetNumberOfPixels() > 0 && this->IsSlanted())
  {
    const SliceStack stack(*input, m_SliceOrigins);
    const auto samples = this->MakePlanes(stack, requested).FindNeededSamples();
    needed.SetIndex(needed.GetIndex() + (samples.GetIndex() - typename TInputImage::IndexType{ { 0, 0, 0 } }));
    needed.SetSize(samples.GetSize());
  }
  else if (requested.GetNumberOfPixels() > 0)
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
CartesianToFCCImageFilter<TInputImage, TOutputImage>::BeforeThreadedGenerateData()
{
  VerifyInputSamples(*this, *this->GetInput());
  TOutputImage * const output = this->GetOutput();
  AdviseHugePages(output->GetBufferPointer(),
                  output->GetBufferedRegion().GetNumberOfPixels() * sizeof(OutputPixelType));
  m_WorkProgress.emplace(*this, output->GetRequestedRegion().GetNumberOfPixels());
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::DynamicThreadedGenerateData(const OutputImageRegionType & region)
{
  m_ThreadFailure.Capture([&] { this->IsSlanted() ? this->ResampleStack(region) : this->Resample(region); });
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::AfterThreadedGenerateData()
{
  m_ThreadFailure.Rethrow();
  m_WorkProgress->Finish();
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::Resample(const OutputImageRegionType & region)
{
  const TInputImage * const input = this->GetInput();
  TOutputImage * const output = this->GetOutput();
  const InputImageRegionType buffered = input->GetBufferedRegion();
  const auto & whole = input->GetLargestPossibleRegion();
  WorkProgress::Share progress(*m_WorkProgress);

  const SeparableTaps xTaps[2] = { this->MakeTaps(0, region, 0), this->MakeTaps(0, region, 1) };
  const SeparableTaps yTaps = this->MakeTaps(1, region);
  const SeparableTaps zTaps = this->MakeTaps(2, region);

  // Samples of the input along x, counted from its first one, that this region needs.
  const SizeValueType xFirst = xTaps[0].GetFirst(0);
  const SizeValueType xCount = xTaps[1].GetFirst(region.GetSize(0) - 1) + xTaps[1].GetNumberOfTaps() - xFirst;
  const RowArithmetic::RowTaps rowTaps[2] = { { xTaps[0], region.GetSize(0), xFirst },
                                              { xTaps[1], region.GetSize(0), xFirst } };
  const auto inputRow = [&](SizeValueType y, SizeValueType z) {
    typename TInputImage::IndexType index = whole.GetIndex();
    index[0] += static_cast<IndexValueType>(xFirst);
    index[1] += static_cast<IndexValueType>(y);
    index[2] += static_cast<IndexValueType>(z);
    return input->GetBufferPointer() + input->ComputeOffset(index);
  };

  // Blocks of output rows such that the slabs they are blended from, along z, stay in the second-level cache.
  constexpr SizeValueType cachedSamples = 256 * 1024;
  const SizeValueType stride = RowArithmetic::PaddedLength(xCount);
  const SizeValueType zCount = zTaps.GetNumberOfTaps();
  const SizeValueType yCount = yTaps.GetNumberOfTaps();
  const SizeValueType blockSize =
    std::clamp<SizeValueType>(cachedSamples / (zCount * stride), 8, std::max<SizeValueType>(8, region.GetSize(1)));

  // Rows and slabs are kept in rings: a sample's place is its y or z modulo the ring's length.
  std::vector<float> rowRing(yCount * stride);
  std::vector<float> slabRing(zCount * blockSize * stride);
  std::vector<float> row(stride);
  std::vector<float> values(rowTaps[0].GetPaddedLength());
  std::vector<const float *> terms(std::max(yCount, zCount));

  for (SizeValueType blockBegin = 0; blockBegin < region.GetSize(1); blockBegin += blockSize)
  {
    const SizeValueType blockEnd = std::min(blockBegin + blockSize, region.GetSize(1));

    // The input's plane z at the y of the block's output rows.
    const auto makeSlab = [&](SizeValueType z) {
      SizeValueType nextRow = 0;
      for (SizeValueType j = blockBegin; j < blockEnd; ++j)
      {
        const SizeValueType first = yTaps.GetFirst(j);
        for (nextRow = std::max(nextRow, first); nextRow < first + yCount; ++nextRow)
        {
          RowArithmetic::ConvertFrom(inputRow(nextRow, z), xCount, rowRing.data() + nextRow % yCount * stride);
        }
        for (SizeValueType tap = 0; tap < yCount; ++tap)
        {
          terms[tap] = rowRing.data() + (first + tap) % yCount * stride;
        }
        float * const slabRow = slabRing.data() + (z % zCount * blockSize + (j - blockBegin)) * stride;
        RowArithmetic::Blend(terms.data(), yTaps.GetWeights(j), yCount, xCount, slabRow);
      }
    };

    SizeValueType nextSlab = 0;
    for (SizeValueType k = 0; k < region.GetSize(2); ++k)
    {
      const SizeValueType first = zTaps.GetFirst(k);
      for (nextSlab = std::max(nextSlab, first); nextSlab < first + zCount; ++nextSlab)
      {
        makeSlab(nextSlab);
      }
      for (SizeValueType j = blockBegin; j < blockEnd; ++j)
      {
        for (SizeValueType tap = 0; tap < zCount; ++tap)
        {
          terms[tap] = slabRing.data() + ((first + tap) % zCount * blockSize + (j - blockBegin)) * stride;
        }
        RowArithmetic::Blend(terms.data(), zTaps.GetWeights(k), zCount, xCount, row.data());

        const typename TOutputImage::IndexType index{ { region.GetIndex(0),
                                                        region.GetIndex(1) + static_cast<IndexValueType>(j),
                                                        region.GetIndex(2) + static_cast<IndexValueType>(k) } };
        RowArithmetic::Interpolate(row.data(), rowTaps[FCCLattice::Parity(index[1], index[2])], values.data());
        RowArithmetic::RoundTo(
          values.data(), region.GetSize(0), output->GetBufferPointer() + output->ComputeOffset(index));
        progress.Completed(region.GetSize(0));
      }
    }
  }
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToFCCImageFilter<TInputImage, TOutputImage>::ResampleStack(const OutputImageRegionType & region)
{
  const TInputImage * const input = this->GetInput();
  TOutputImage * const output = this->GetOutput();
  const auto & whole = input->GetLargestPossibleRegion();
  WorkProgress::Share progress(*m_WorkProgress);

  const SliceStack stack(*input, m_SliceOrigins);
  const SliceStackPlanes planes = this->MakePlanes(stack, region);
  const auto needed = planes.FindNeededSamples();
  const auto xFirst = static_cast<SizeValueType>(needed.GetIndex(0));
  const SizeValueType xCount = needed.GetSize(0);
  const SeparableTaps & zTaps = planes.GetSliceTaps();
  const SizeValueType zCount = zTaps.GetNumberOfTaps();

  const SizeValueType stride = RowArithmetic::PaddedLength(xCount);
  std::vector<float> sliceRows(zCount * stride);
  std::vector<const float *> sliceTerms(zCount);
  for (SizeValueType tap = 0; tap < zCount; ++tap)
  {
    sliceTerms[tap] = sliceRows.data() + tap * stride;
  }
  const auto blendSlices = [&](SizeValueType k, SizeValueType y, float * blend) {
    auto index = whole.GetIndex();
    index[0] += static_cast<IndexValueType>(xFirst);
    index[1] += static_cast<IndexValueType>(y);
    index[2] += static_cast<IndexValueType>(zTaps.GetFirst(k));
    for (SizeValueType tap = 0; tap < zCount; ++tap, ++index[2])
    {
      RowArithmetic::ConvertFrom(
        input->GetBufferPointer() + input->ComputeOffset(index), xCount, sliceRows.data() + tap * stride);
    }
    RowArithmetic::Blend(sliceTerms.data(), zTaps.GetWeights(k), zCount, xCount, blend);
  };

  // The sites of a row, and which of them lie in the input.
  struct SiteRow
  {
    SizeValueType begin;
    SizeValueType end;
    RowArithmetic::RowTaps taps;
  };
  const auto makeSiteRow = [&](SizeValueType k, double row, IndexValueType parity) -> SiteRow {
    const std::vector<double> columns = planes.GetColumns(k, row, parity);
    const auto isInside = [&](double column) { return IsInsideVoxels(column, whole.GetSize(0)); };
    const auto begin = std::find_if(columns.begin(), columns.end(), isInside);
    const auto end = std::find_if_not(begin, columns.end(), isInside);
    return { static_cast<SizeValueType>(begin - columns.begin()),
             static_cast<SizeValueType>(end - columns.begin()),
             { planes.MakeColumnTaps(columns), columns.size(), xFirst } };
  };

  // Blends of the slices' rows in a ring, as in Resample().
  std::vector<float> ring;
  std::vector<const float *> terms;
  std::vector<float> row(stride);
  std::vector<float> values;
  for (SizeValueType k = 0; k < region.GetSize(2); ++k)
  {
    const std::vector<double> rows = planes.GetRows(k);
    const SeparableTaps yTaps = planes.MakeRowTaps(rows);
    const SizeValueType yCount = yTaps.GetNumberOfTaps();
    ring.resize(yCount * stride);
    terms.resize(yCount);
    std::optional<SiteRow> siteRows[2];
    SizeValueType nextRow = 0;
    for (SizeValueType j = 0; j < region.GetSize(1); ++j)
    {
      const typename TOutputImage::IndexType index{ { region.GetIndex(0),
                                                      region.GetIndex(1) + static_cast<IndexValueType>(j),
                                                      region.GetIndex(2) + static_cast<IndexValueType>(k) } };
      OutputPixelType * const outputRow = output->GetBufferPointer() + output->ComputeOffset(index);
      const IndexValueType parity = FCCLattice::Parity(index[1], index[2]);
      auto & sites = siteRows[parity];
      if (!sites || stack.AreRowsShifted())
      {
        sites.emplace(makeSiteRow(k, rows[j], parity));
      }
      if (IsInsideVoxels(rows[j], whole.GetSize(1)) && sites->begin < sites->end)
      {
        const SizeValueType first = yTaps.GetFirst(j);
        for (nextRow = std::max(nextRow, first); nextRow < first + yCount; ++nextRow)
        {
          blendSlices(k, nextRow, ring.data() + nextRow % yCount * stride);
        }
        for (SizeValueType tap = 0; tap < yCount; ++tap)
        {
          terms[tap] = ring.data() + (first + tap) % yCount * stride;
        }
        RowArithmetic::Blend(terms.data(), yTaps.GetWeights(j), yCount, xCount, row.data());
        values.resize(sites->taps.GetPaddedLength());
        RowArithmetic::Interpolate(row.data(), sites->taps, values.data());
        RowArithmetic::RoundTo(values.data(), region.GetSize(0), outputRow);
        std::fill(outputRow, outputRow + sites->begin, m_OutsideValue);
        std::fill(outputRow + sites->end, outputRow + region.GetSize(0), m_OutsideValue);
      }
      else
      {
        std::fill(outputRow, outputRow + region.GetSize(0), m_OutsideValue);
      }
      progress.Completed(region.GetSize(0));
    }
  }
}

} // namespace itk

#endif
