#ifndef itkFCCToCartesianImageFilter_h
#define itkFCCToCartesianImageFilter_h

#include "itkFCCImage.h"
#include "itkImage.h"
#include "itkImageToImageFilter.h"
#include "itkWorkProgress.h"
#include "rhombicPixelTypes.h"

namespace itk
{

/** \class FCCToCartesianImageFilter
 * \brief Resamples an FCC image onto a Cartesian grid by linear interpolation in the lattice's tetrahedra.
 *
 * The grid is that of the reference image if one is set, an optional second input. Otherwise it has the FCC image's
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
  FCCToCartesianImageFilter();
  ~FCCToCartesianImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyPreconditions() ITKv5_CONST override;

  void
  VerifyInputInformation() ITKv5_CONST override
  {}

  void
  GenerateOutputInformation() override;

  void
  GenerateInputRequestedRegion() override;

  void
  GenerateData() override;

private:
  /** The lattice samples that voxels of a region may be made of; at least one. */
  typename TInputImage::RegionType
  FindNeededSamples(const OutputImageRegionType & region) const;

  void
  Resample(const OutputImageRegionType & region, WorkProgress::Share & progress);

  SpacingType m_OutputSpacing{ 0.0 };
  OutputPixelType m_DefaultPixelValue{};
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkFCCToCartesianImageFilter.hxx"
#endif

// Compiled once, in the library, for the pixel types of scans.
namespace itk
{
RHOMBIC_INSTANTIATE(extern template class FCCToCartesianImageFilter, FCCImage);
} // namespace itk

#endif
