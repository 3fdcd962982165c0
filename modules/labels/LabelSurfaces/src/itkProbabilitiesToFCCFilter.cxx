#include "itkProbabilitiesToFCCFilter.h"

#include "itkCartesianToFCCImageFilter.h"
#include "itkDiscreteGaussianImageFilter.h"
#include "itkInputSamples.h"
#include "itkLabelsOnLattice.h"
#include "itkSlicePlacement.h"
#include "itkWorkProgress.h"
#include "itkZeroFluxNeumannPadImageFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace itk
{
namespace
{

using ProbabilityImage = ProbabilitiesToFCCFilter::InputImageType;

constexpr double Sigma = 0.5; // of smoothing, in parts of voxels

/** Smooths and resamples an input, which is continued beyond its border. */
class Resampler
{
public:
  using LatticeType = CartesianToFCCImageFilter<ProbabilityImage>::OutputImageType;

  Resampler(const ProbabilityImage & input, double density)
    : m_Pad(PadFilter::New())
    , m_Smooth(Smoothing::New())
    , m_Resample(CartesianToFCCImageFilter<ProbabilityImage>::New())
  {
    const auto image = ProbabilityImage::New(); // not the input, whose source an update would call
    image->CopyInformation(&input);
    image->SetRegions(input.GetLargestPossibleRegion());
    image->SetPixelContainer(const_cast<ProbabilityImage::PixelContainer *>(input.GetPixelContainer()));
    constexpr SizeValueType margin = 2;
    const Size<3> voxels{ { margin, margin, margin } };
    m_Pad->SetInput(image);
    m_Pad->SetPadLowerBound(voxels);
    m_Pad->SetPadUpperBound(voxels);
    const std::array<SizeValueType, 3> parts = DivideVoxels(input.GetSpacing());
    Smoothing::ArrayType variance;
    LatticeType::SpacingType spacing = input.GetSpacing();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      // A site has the volume of two cubes of the spacing's edge.
      spacing[axis] /= static_cast<double>(parts[axis]) * std::cbrt(2.0 * density);
      variance[axis] = Math::sqr(Sigma / static_cast<double>(parts[axis]));
    }
    m_Smooth->SetInput(m_Pad->GetOutput());
    m_Smooth->SetVariance(variance);
    m_Smooth->SetUseImageSpacing(false);
    m_Resample->SetInput(m_Smooth->GetOutput());
    m_Resample->SetOutputSpacing(spacing);
    m_Resample->SetOutsideValue(0.0f);
  }

  /** The lattice, without samples. */
  LatticeType &
  GetLattice()
  {
    m_Resample->UpdateOutputInformation();
    return *m_Resample->GetOutput();
  }

  LatticeType &
  Resample()
  {
    m_Resample->Update();
    return *m_Resample->GetOutput();
  }

private:
  using PadFilter = ZeroFluxNeumannPadImageFilter<ProbabilityImage, ProbabilityImage>;
  using Smoothing = DiscreteGaussianImageFilter<ProbabilityImage, ProbabilityImage>;

  PadFilter::Pointer m_Pad;
  Smoothing::Pointer m_Smooth;
  CartesianToFCCImageFilter<ProbabilityImage>::Pointer m_Resample;
};

/** The depth of each site below the outer faces of a volume, in parts of its voxels, negative beyond it. */
std::vector<float>
FindDepths(const ProbabilitiesToFCCFilter::LatticeType & lattice, const ProbabilityImage & volume)
{
  const std::array<SizeValueType, 3> parts = DivideVoxels(volume.GetSpacing());
  const auto & voxels = volume.GetLargestPossibleRegion();
  const auto & sites = lattice.GetLargestPossibleRegion();
  std::vector<float> depths(sites.GetNumberOfPixels(), FCCLabelWeights::Limit);
  ForEachRow(sites, [&](Index<3> site, SizeValueType offset) {
    for (SizeValueType i = 0; i < sites.GetSize(0); ++i, ++site[0])
    {
      const auto place =
        volume.TransformPhysicalPointToContinuousIndex<double>(lattice.TransformIndexToPhysicalPoint<double>(site));
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const double low = place[axis] - static_cast<double>(voxels.GetIndex(axis)) + 0.5;
        const double depth = std::min(low, static_cast<double>(voxels.GetSize(axis)) - low);
        depths[offset + i] = std::min(depths[offset + i], static_cast<float>(depth * static_cast<double>(parts[axis])));
      }
    }
  });
  return depths;
}

} // namespace

void
ProbabilitiesToFCCFilter::VerifyInputInformation() ITKv5_CONST
{
  Superclass::VerifyInputInformation();
  const auto & region = this->GetInput()->GetLargestPossibleRegion();
  const auto inputs = static_cast<unsigned int>(this->GetNumberOfIndexedInputs());
  if (region.GetNumberOfPixels() == 0 || inputs > std::numeric_limits<LabelType>::max())
  {
    itkExceptionMacro("There are " << inputs << " inputs of " << region.GetSize()
                                   << " voxels; there have to be voxels, and at most 65,535 inputs.");
  }
  for (unsigned int n = 0; n < inputs; ++n)
  {
    const InputImageType * const input = this->GetInput(n);
    if (input == nullptr || input->GetLargestPossibleRegion() != region || IsFromUnevenSlices(*input))
    {
      itkExceptionMacro("Input " << n
                                 << " is missing, has other voxels than the first input, or unevenly spaced slices.");
    }
  }
}

void
ProbabilitiesToFCCFilter::GenerateOutputInformation()
{
  this->GetOutput()->CopyInformation(&Resampler(*this->GetInput(), this->GetDensity()).GetLattice());
}

void
ProbabilitiesToFCCFilter::GenerateData()
{
  constexpr float limit = FCCLabelWeights::Limit;
  const auto inputs = static_cast<unsigned int>(this->GetNumberOfIndexedInputs());
  WorkProgress progress(*this, inputs + SizeValueType{ 1 });
  this->AllocateOutputs();
  LatticeType & labels = *this->GetOutput();
  const auto & region = labels.GetLargestPossibleRegion();
  StrongestLabels strongest(labels, *this->GetWeights());
  const auto background = Resampler::LatticeType::New(); // the weight of label 0, of probability 1 - sum of the others
  background->CopyInformation(&labels);
  background->SetRegions(region);
  background->Allocate();
  background->FillBuffer(limit);
  const std::vector<float> depths = FindDepths(labels, *this->GetInput());
  const auto addLabel = [&](const Resampler::LatticeType & field, unsigned int label) {
    strongest.Add(field, static_cast<LabelType>(label));
    progress.Completed(1);
  };
  for (unsigned int n = 0; n < inputs; ++n)
  {
    VerifyInputSamples(*this, *this->GetInput(n));
    Resampler resampler(*this->GetInput(n), this->GetDensity());
    Resampler::LatticeType & field = resampler.Resample();
    ForEachRow(region, [&](const Index<3> &, SizeValueType offset) {
      float * const row = field.GetBufferPointer() + offset;
      float * const rest = background->GetBufferPointer() + offset;
      for (SizeValueType i = 0; i < region.GetSize(0); ++i)
      {
        rest[i] -= 2.0f * limit * row[i];
        row[i] = std::min(limit * (2.0f * row[i] - 1.0f), depths[offset + i]);
      }
    });
    addLabel(field, n + 1);
  }
  std::transform(depths.begin(),
                 depths.end(),
                 background->GetBufferPointer(),
                 background->GetBufferPointer(),
                 [](float depth, float weight) { return std::max(weight, -depth); });
  addLabel(*background, 0);
  strongest.SortWeights();
  progress.Finish();
}

} // namespace itk
