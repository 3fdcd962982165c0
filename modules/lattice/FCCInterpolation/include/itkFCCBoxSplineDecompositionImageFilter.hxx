#ifndef itkFCCBoxSplineDecompositionImageFilter_hxx
#define itkFCCBoxSplineDecompositionImageFilter_hxx

#include "detail/itkFCCBoxSpline.h"
#include "detail/itkFCCMirror.h"
#include "itkInputSamples.h"
#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
void
FCCBoxSplineDecompositionImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfIterations: " << m_NumberOfIterations << std::endl;
}

template <typename TInputImage, typename TOutputImage>
void
FCCBoxSplineDecompositionImageFilter<TInputImage, TOutputImage>::GenerateInputRequestedRegion()
{
  const_cast<TInputImage *>(this->GetInput())->SetRequestedRegionToLargestPossibleRegion();
}

template <typename TInputImage, typename TOutputImage>
void
FCCBoxSplineDecompositionImageFilter<TInputImage, TOutputImage>::EnlargeOutputRequestedRegion(DataObject * output)
{
  output->SetRequestedRegionToLargestPossibleRegion();
}

template <typename TInputImage, typename TOutputImage>
void
FCCBoxSplineDecompositionImageFilter<TInputImage, TOutputImage>::GenerateData()
{
  VerifyInputSamples(*this, *this->GetInput());
  this->AllocateOutputs();
  const auto & region = this->GetOutput()->GetBufferedRegion();
  WorkProgress progress(*this, (SizeValueType{ m_NumberOfIterations } + 1) * region.GetSize(2));
  constexpr double toQuasiInterpolant = 1.0;
  constexpr double fastest = 1.5; // minimises the largest |1 - gain * eigenvalue|, the error's factor in an iteration

  // Iterations write to two buffers in turn, the last one to the output.
  const std::unique_ptr<CoefficientType[]> spare(
    m_NumberOfIterations > 0 ? new CoefficientType[region.GetNumberOfPixels()] : nullptr);
  CoefficientType * target = this->GetOutput()->GetBufferPointer();
  CoefficientType * previous = spare.get();
  if (m_NumberOfIterations % 2 == 1)
  {
    std::swap(target, previous);
  }
  this->Correct(this->GetInput()->GetBufferPointer(), toQuasiInterpolant, target, progress);
  for (unsigned int iteration = 0; iteration < m_NumberOfIterations; ++iteration)
  {
    std::swap(target, previous);
    this->Correct(previous, fastest, target, progress);
  }
  progress.Finish();
}

template <typename TInputImage, typename TOutputImage>
template <typename TPixel>
void
FCCBoxSplineDecompositionImageFilter<TInputImage, TOutputImage>::Correct(const TPixel * coefficients,
                                                                         double gain,
                                                                         CoefficientType * target,
                                                                         WorkProgress & progress)
{
  const auto & region = this->GetOutput()->GetBufferedRegion();
  const InputPixelType * const samples = this->GetInput()->GetBufferPointer();
  const auto width = static_cast<IndexValueType>(region.GetSize(0));
  const auto height = static_cast<IndexValueType>(region.GetSize(1));
  const auto depth = static_cast<IndexValueType>(region.GetSize(2));
  const IndexValueType parityOfFirstRow = FCCLattice::Parity(region.GetIndex(1), region.GetIndex(2));
  const auto correctRow = [=](IndexValueType j, IndexValueType k) {
    const auto rowAt = [=](IndexValueType stepY, IndexValueType stepZ) {
      return coefficients +
             (MirrorIntoRange(k + stepZ, 0, depth - 1) * height + MirrorIntoRange(j + stepY, 0, height - 1)) * width;
    };
    const IndexValueType row = (k * height + j) * width;
    const IndexValueType parity = (parityOfFirstRow + j + k) & 1;
    const TPixel * const sides[4] = { rowAt(-1, 0), rowAt(1, 0), rowAt(0, -1), rowAt(0, 1) };
    const TPixel * const corners[4] = { rowAt(-1, -1), rowAt(1, -1), rowAt(-1, 1), rowAt(1, 1) };
    for (IndexValueType i = 0; i < width; ++i)
    {
      // The neighbours before and after in x; one beyond an end is mirrored onto the other one.
      const IndexValueType before = std::max<IndexValueType>(i + parity - 1, 0);
      const IndexValueType after = std::min(i + parity, width - 1);
      double sum = 0.0;
      for (unsigned int n = 0; n < 4; ++n)
      {
        sum += static_cast<double>(sides[n][before]) + static_cast<double>(sides[n][after]) +
               static_cast<double>(corners[n][i]);
      }
      const auto own = static_cast<double>(coefficients[row + i]);
      const double splineAtSite = FCCBoxSpline::AtSite * own + FCCBoxSpline::AtNearestNeighbor * sum;
      target[row + i] =
        static_cast<CoefficientType>(own + gain * (static_cast<double>(samples[row + i]) - splineAtSite));
    }
  };

  ThreadFailure failure;
  MultiThreaderBase * const threader = this->GetMultiThreader();
  threader->SetNumberOfWorkUnits(this->GetNumberOfWorkUnits());
  threader->ParallelizeArray(
    0,
    region.GetSize(2),
    [&](SizeValueType k) {
      failure.Capture([&] {
        for (IndexValueType j = 0; j < height; ++j)
        {
          progress.CheckAbort();
          correctRow(j, static_cast<IndexValueType>(k));
        }
        progress.Completed(1);
      });
    },
    nullptr);
  failure.Rethrow();
}

} // namespace itk

#endif
