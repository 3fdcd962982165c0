#ifndef itkFCCToCartesianImageFilter_h
#define itkFCCToCartesianImageFilter_h

#include "detail/itkProduceOutput.h"
#include "itkFCCImage.h"
#include "itkFCCLinearInterpolateImageFunction.h"
#include "itkFCCResamplingChecks.h"
#include "itkImage.h"
#include "itkImageScanlineIterator.h"
#include "itkImageToImageFilter.h"
#include "itkWorkProgress.h"
#include "rhombicPixelTypes.h"

#include <algorithm>
#include <cmath>

namespace itk
{

/** \class FCCToCartesianImageFilter
 * \brief Resamples an FCC image onto a Cartesian grid by linear interpolation in the lattice's tetrahedra.
 *
 * The grid is the grid of the reference image, an optional second input, if set. Otherwise it has the FCC image's
 * direction, the spacing that makes the FCC image's samples FCCLattice::NyquistDensity times as many as the grid's (or
 * SetOutputSpacing()), and its voxels tile the FCC image's extent, centred on it. So an image resampled onto the
 * lattice with the default density and back has its old spacing; use the reference image to get the very same grid.
 *
 * Voxels outside the FCC image's extent become DefaultPixelValue. Integer outputs are rounded half away from zero and
 * clamped to the range of their type; arithmetic is in float64. The filter requests only the part of the input that the
 * requested output needs: the sites of the tetrahedra around its voxels. Any part of the output has the same bytes
 * whether it is computed alone or with the rest, by one thread or many.
 *
 * Throws when OutputSpacing is not positive, when the grid would have more than 2^40 voxels, and when the input's
 * buffer lacks samples that are needed.
 *
 * Overridden pipeline methods: VerifyPreconditions() (parameters in range), VerifyInputInformation() (the two inputs
 * need not share a grid), GenerateOutputInformation() (places the grid), GenerateInputRequestedRegion() (the sites
 * around the voxels; no pixels of the reference), GenerateData() (large memory pages for the output; exceptions of all
 * threads are passed on).
 *
 * \ingroup FCCResampling
 */
template <typename TInputImage, typename TOutputImage = Image<typename TInputImage::PixelType, 3>>
class ITK_TEMPLATE_EXPORT FCCToCartesianImageFilter : public ImageToImageFilter<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FCCToCartesianImageFilter);

  using Self = FCCToCartesianImageFilter;
  using Superclass = ImageToImageFilter<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(FCCToCartesianImageFilter, ImageToImageFilter);

  using OutputPixelType = typename TOutputImage::PixelType;
  using OutputImageRegionType = typename TOutputImage::RegionType;
  using SpacingType = typename TOutputImage::SpacingType;
  using ReferenceImageType = ImageBase<3>;

  static_assert(std::is_base_of<FCCImage<typename TInputImage::PixelType>, TInputImage>::value,
                "The input must be an FCCImage");

  /** Spacing of the output in mm. Default all 0: derived from the input's. Without effect when a reference is set. */
  itkSetMacro(OutputSpacing, SpacingType);
  itkGetConstReferenceMacro(OutputSpacing, SpacingType);

  /** A Cartesian image whose grid the output gets; its pixels are not read. Default none. */
  itkSetInputMacro(ReferenceImage, ReferenceImageType);
  itkGetInputMacro(ReferenceImage, ReferenceImageType);

  /** Value of voxels outside the input's extent. Default 0. */
  itkSetMacro(DefaultPixelValue, OutputPixelType);
  itkGetConstMacro(DefaultPixelValue, OutputPixelType);

protected:
  FCCToCartesianImageFilter()
  {
    this->AddOptionalInputName("ReferenceImage", 1);
  }
  ~FCCToCartesianImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override
  {
    Superclass::PrintSelf(os, indent);
    os << indent << "OutputSpacing: " << m_OutputSpacing << std::endl;
    os << indent
       << "DefaultPixelValue: " << static_cast<typename NumericTraits<OutputPixelType>::PrintType>(m_DefaultPixelValue)
       << std::endl;
  }

  void
  VerifyPreconditions() ITKv5_CONST override
  {
    Superclass::VerifyPreconditions();
    if (!IsFCCSpacingOrUnset(m_OutputSpacing))
    {
      itkExceptionMacro("OutputSpacing must be positive along each axis, not "
                        << m_OutputSpacing << "; set it to zero along all of them to derive it from the input's.");
    }
  }

  void
  VerifyInputInformation() ITKv5_CONST override
  {}

  void
  GenerateOutputInformation() override
  {
    const TInputImage * const input = this->GetInput();
    TOutputImage * const output = this->GetOutput();
    const auto & inputRegion = input->GetLargestPossibleRegion();
    if (inputRegion.GetNumberOfPixels() == 0)
    {
      itkExceptionMacro("The input has no samples; its size is " << inputRegion.GetSize() << ".");
    }
    if (const ReferenceImageType * const reference = this->GetReferenceImage())
    {
      output->CopyInformation(reference);
      return;
    }

    const FCCExtent extent(inputRegion);
    const double scale = std::cbrt(FCCLattice::CellVolume * FCCLattice::NyquistDensity);
    std::array<double, 3> counts{};
    SpacingType spacing;
    std::array<double, 3> first{}; // the first voxel's centre in lattice coordinates
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      constexpr double tolerance = 1e-9; // relative to a voxel, against rounding
      const double units = extent.GetHighest()[axis] - extent.GetLowest()[axis];
      spacing[axis] = m_OutputSpacing[axis] > 0.0 ? m_OutputSpacing[axis] : scale * input->GetSpacing()[axis];
      const double step = spacing[axis] / input->GetSpacing()[axis];
      counts[axis] = std::max(1.0, std::floor(units / step + tolerance));
      first[axis] = extent.GetLowest()[axis] + (units - (counts[axis] - 1.0) * step) / 2.0;
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

  void
  GenerateInputRequestedRegion() override
  {
    const_cast<TInputImage *>(this->GetInput())
      ->SetRequestedRegion(this->FindNeededSamples(this->GetOutput()->GetRequestedRegion()));
    if (const ReferenceImageType * const reference = this->GetReferenceImage())
    {
      const_cast<ReferenceImageType *>(reference)->SetRequestedRegion(reference->GetBufferedRegion());
    }
  }

  void
  GenerateData() override
  {
    this->AllocateOutputs();
    ProduceOutput(*this, AllDivided, [this](const OutputImageRegionType & region, WorkProgress::Share & progress) {
      this->Resample(region, progress);
    });
  }

private:
  /** The lattice samples that voxels of a region may be made of; at least one. */
  typename TInputImage::RegionType
  FindNeededSamples(const OutputImageRegionType & region) const
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
      const auto coordinates = input->TransformPhysicalPointToLattice(
        this->GetOutput()->template TransformIndexToPhysicalPoint<double>(index));
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

  void
  Resample(const OutputImageRegionType & region, WorkProgress::Share & progress)
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

  SpacingType m_OutputSpacing{ 0.0 };
  OutputPixelType m_DefaultPixelValue{};
};

// Compiled once, in the library, for the pixel types of scans.
RHOMBIC_INSTANTIATE(extern template class FCCToCartesianImageFilter, FCCImage);

} // namespace itk

#endif
