#ifndef itkFCCToCartesianImageFilter_h
#define itkFCCToCartesianImageFilter_h

#include "itkFCCImage.h"
#include "itkImage.h"
#include "itkImageToImageFilter.h"

namespace itk
{

/** \class FCCToCartesianImageFilter
 * \brief Resamples an FCC image onto a Cartesian grid by linear interpolation in the lattice's tetrahedra.
 *
 * The grid is that of the reference image if one is set. Otherwise it has the FCC image's direction, the spacing that
 * makes the FCC image's samples FCCLattice::NyquistDensity times as many as the grid's (or SetOutputSpacing()), and its
 * voxels tile the FCC image's extent, centred on it. So an image resampled onto the lattice with the default
 * density and back has its old spacing; use the reference image to get the very same grid.
 *
 * Voxels outside the FCC image's extent become DefaultPixelValue. The whole input is requested. Integer outputs are
 * rounded. The result does not depend on the number of threads.
 *
 * Overridden pipeline methods: GenerateOutputInformation() (places the grid), GenerateInputRequestedRegion() (all of
 * it).
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
  itkSetConstObjectMacro(ReferenceImage, ReferenceImageType);
  itkGetConstObjectMacro(ReferenceImage, ReferenceImageType);

  /** Value of voxels outside the input's extent. Default 0. */
  itkSetMacro(DefaultPixelValue, OutputPixelType);
  itkGetConstMacro(DefaultPixelValue, OutputPixelType);

protected:
  FCCToCartesianImageFilter();
  ~FCCToCartesianImageFilter() override = default;

  void PrintSelf(std::ostream & os, Indent indent) const override;

  void VerifyInputInformation() ITKv5_CONST override;

  void GenerateOutputInformation() override;

  void GenerateInputRequestedRegion() override;

  void DynamicThreadedGenerateData(const OutputImageRegionType & region) override;

  /** Reports that all is done: the threads' last reports may have come from another thread than the observers'. */
  void
  AfterThreadedGenerateData() override
  {
    this->UpdateProgress(1.0f);
  }

private:
  SpacingType m_OutputSpacing{ 0.0 };
  typename ReferenceImageType::ConstPointer m_ReferenceImage;
  OutputPixelType m_DefaultPixelValue{};
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
