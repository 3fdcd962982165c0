#ifndef itkCartesianToNestedFCCImageFilter_hxx
#define itkCartesianToNestedFCCImageFilter_hxx

#include "itkFCCResamplingChecks.h"
#include "itkHugePages.h"
#include "itkInputSamples.h"
#include "itkRowArithmetic.h"

#include <algorithm>
#include <cstdlib>

namespace itk
{
namespace NestedFCC
{

/** How far the half-band filter reaches along each axis, in samples. */
constexpr IndexValueType Reach = 3;

struct HalfBandTerm
{
  FCCLattice::SiteType offset;
  float weight;
};

/** The terms of 1/2 + 3/4 A - 1/4 A^3. A^3 is the mean over all walks of three steps: n! / (|x|! |y|! |z|!) of the 216
 * end n = 3 steps away at (x, y, z), and 15 at each face neighbour. */
inline std::vector<HalfBandTerm>
HalfBandTerms()
{
  constexpr double factorials[] = { 1.0, 1.0, 2.0, 6.0 };
  std::vector<HalfBandTerm> terms{ { { 0, 0, 0 }, 0.5f } };
  for (IndexValueType z = -Reach; z <= Reach; ++z)
  {
    for (IndexValueType y = -Reach; y <= Reach; ++y)
    {
      for (IndexValueType x = -Reach; x <= Reach; ++x)
      {
        const IndexValueType steps = std::abs(x) + std::abs(y) + std::abs(z);
        if (steps == 1)
        {
          terms.push_back({ { x, y, z }, static_cast<float>(0.75 / 6.0 - 0.25 * 15.0 / 216.0) });
        }
        else if (steps == 3)
        {
          const double walks = 6.0 / (factorials[std::abs(x)] * factorials[std::abs(y)] * factorials[std::abs(z)]);
          terms.push_back({ { x, y, z }, static_cast<float>(-0.25 * walks / 216.0) });
        }
      }
    }
  }
  return terms;
}

} // namespace NestedFCC

template <typename TInputImage, typename TOutputImage>
CartesianToNestedFCCImageFilter<TInputImage, TOutputImage>::CartesianToNestedFCCImageFilter()
{
  this->DynamicMultiThreadingOn();
  this->ThreaderUpdateProgressOff();
}

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
  const IndexValueType reach = m_Antialiasing ? NestedFCC::Reach : 0;
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
        const IndexValueType source = MirroredSample(sample, length);
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
CartesianToNestedFCCImageFilter<TInputImage, TOutputImage>::BeforeThreadedGenerateData()
{
  VerifyInputSamples(*this, *this->GetInput());
  TOutputImage * const output = this->GetOutput();
  AdviseHugePages(output->GetBufferPointer(), output->GetBufferedRegion().GetNumberOfPixels() * sizeof(PixelType));
  m_WorkProgress.emplace(*this, output->GetRequestedRegion().GetNumberOfPixels());
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToNestedFCCImageFilter<TInputImage, TOutputImage>::DynamicThreadedGenerateData(
  const OutputImageRegionType & region)
{
  m_ThreadFailure.Capture([&] { m_Antialiasing ? this->FilterSites(region) : this->CopySites(region); });
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToNestedFCCImageFilter<TInputImage, TOutputImage>::AfterThreadedGenerateData()
{
  m_ThreadFailure.Rethrow();
  m_WorkProgress->Finish();
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
CartesianToNestedFCCImageFilter<TInputImage, TOutputImage>::CopySites(const OutputImageRegionType & region)
{
  TOutputImage * const output = this->GetOutput();
  WorkProgress::Share progress(*m_WorkProgress);
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
      outputRow[count - 1] = inputRow[MirroredSample(first + 2 * (count - 1), length)];
      progress.Completed(region.GetSize(0));
    }
  }
}

template <typename TInputImage, typename TOutputImage>
void
CartesianToNestedFCCImageFilter<TInputImage, TOutputImage>::FilterSites(const OutputImageRegionType & region)
{
  using NestedFCC::Reach;
  constexpr IndexValueType window = 2 * Reach + 1;
  TOutputImage * const output = this->GetOutput();
  WorkProgress::Share progress(*m_WorkProgress);
  const InputImageRegionType & whole = this->GetInput()->GetLargestPossibleRegion();
  const auto yLength = static_cast<IndexValueType>(whole.GetSize(1));
  const auto zLength = static_cast<IndexValueType>(whole.GetSize(2));
  const auto begin = region.GetIndex();
  const auto end = begin + region.GetSize();

  const std::vector<NestedFCC::HalfBandTerm> terms = NestedFCC::HalfBandTerms();
  std::vector<float> weights(terms.size());
  std::transform(terms.begin(), terms.end(), weights.begin(), [](const auto & term) { return term.weight; });
  std::vector<const float *> rows(terms.size());
  std::vector<float> values(RowArithmetic::PaddedLength(region.GetSize(0)));

  // An input row is kept as two, its samples of even and of odd x, so that each term is a run of consecutive samples.
  // Sample n of these is x = 2 (begin + n - margin), and one more.
  constexpr IndexValueType margin = 2;
  const SizeValueType halfLength = region.GetSize(0) + 2 * margin;
  const SizeValueType stride = RowArithmetic::PaddedLength(halfLength);
  std::vector<SizeValueType> sources(2 * halfLength);
  for (SizeValueType n = 0; n < sources.size(); ++n)
  {
    IndexValueType x = 2 * (begin[0] - margin) + static_cast<IndexValueType>(n);
    x = std::clamp<IndexValueType>(x, 2 * begin[0] - Reach, 2 * end[0] + Reach - 1); // no term needs the outermost two
    sources[n] = static_cast<SizeValueType>(MirroredSample(x, static_cast<IndexValueType>(whole.GetSize(0))));
  }
  const auto splitRow = [&](const PixelType * row, float * even) {
    float * const odd = even + stride;
    for (SizeValueType n = 0; n < halfLength; ++n)
    {
      even[n] = static_cast<float>(row[sources[2 * n]]);
      odd[n] = static_cast<float>(row[sources[2 * n + 1]]);
    }
  };

  // Blocks of output rows such that the input rows of seven planes around them stay in the second-level cache.
  constexpr SizeValueType cachedSamples = 256 * 1024;
  const auto cachedRows = static_cast<IndexValueType>(cachedSamples / (window * 2 * stride));
  const IndexValueType blockSize = std::max<IndexValueType>(8, cachedRows - 2 * Reach);
  const IndexValueType slabRows = std::min<IndexValueType>(blockSize, end[1] - begin[1]) + 2 * Reach;
  std::vector<float> slabRing(static_cast<SizeValueType>(window * slabRows) * 2 * stride);

  for (IndexValueType blockBegin = begin[1]; blockBegin < end[1]; blockBegin += blockSize)
  {
    const IndexValueType blockEnd = std::min<IndexValueType>(blockBegin + blockSize, end[1]);
    const auto slabRow = [&](IndexValueType y, IndexValueType z) {
      const IndexValueType slot = (z - begin[2] + Reach) % window;
      return slabRing.data() + static_cast<SizeValueType>(slot * slabRows + (y - blockBegin + Reach)) * 2 * stride;
    };

    IndexValueType nextSlab = begin[2] - Reach;
    auto index = begin;
    for (index[2] = begin[2]; index[2] < end[2]; ++index[2])
    {
      for (; nextSlab <= index[2] + Reach; ++nextSlab)
      {
        for (IndexValueType y = blockBegin - Reach; y < blockEnd + Reach; ++y)
        {
          splitRow(this->GetInputRow(MirroredSample(y, yLength), MirroredSample(nextSlab, zLength)),
                   slabRow(y, nextSlab));
        }
      }
      for (index[1] = blockBegin; index[1] < blockEnd; ++index[1])
      {
        for (std::size_t n = 0; n < terms.size(); ++n)
        {
          const auto & offset = terms[n].offset;
          const IndexValueType x = FCCLattice::Parity(index[1], index[2]) + offset[0] + 2 * margin;
          rows[n] = slabRow(index[1] + offset[1], index[2] + offset[2]) + static_cast<SizeValueType>(x & 1) * stride +
                    static_cast<SizeValueType>(x / 2);
        }
        RowArithmetic::Blend(rows.data(), weights.data(), rows.size(), region.GetSize(0), values.data());
        RowArithmetic::RoundTo(
          values.data(), region.GetSize(0), output->GetBufferPointer() + output->ComputeOffset(index));
        progress.Completed(region.GetSize(0));
      }
    }
  }
}

} // namespace itk

#endif
