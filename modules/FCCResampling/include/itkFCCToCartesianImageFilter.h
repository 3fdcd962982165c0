#ifndef itkFCCToCartesianImageFilter_h
#define itkFCCToCartesianImageFilter_h

#include "itkFCCImage.h"
#include "itkImage.h"
#include "itkImageToImageFilter.h"
#include "itkThreadFailure.h"

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
 * Voxels outside the FCC image's extent become DefaultPixelValue. The whole input is requested. Integer outputs are
 * rounded and clamped to the range of their type. The result does not depend on the number of threads or on the
 * requested region.
 *
 * Overridden pipeline methods: VerifyPreconditions() (sensible parameters), VerifyInputInformation() (the two inputs
 * need not share a grid), GenerateOutputInformation() (places the grid), GenerateInputRequestedRegion() (all of the
 * lattice, nothing of the reference).
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

  /** A Cartesian image whose grid the output gets; its pixels are not looked at. Default none. */
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
  DynamicThreadedGenerateData(const OutputImageRegionType & region) override;

  void
  AfterThreadedGenerateData() override;

private:
  void
  Resample(const OutputImageRegionType & region);

  SpacingType m_OutputSpacing{ 0.0 };
  OutputPixelType m_DefaultPixelValue{};
  ThreadFailure m_ThreadFailure;
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkFCCToCartesianImageFilter.hxx"
#endif

// Compiled once, in the library, for the pixel types of scans.
namespace itk
{
extern template class FCCToCartesianImageFilter<FCCImage<std::uint8_t>>;
extern template class FCCToCartesianImageFilter<FCCImage<std::int16_t>>;
extern template class FCCToCartesianImageFilter<FCCImage<std::uint16_t>>;
extern template class FCCToCartesianImageFilter<FCCImage<std::int32_t>>;
extern template class FCCToCartesianImageFilter<FCCImage<float>>;
} // namespace itk

#endif
