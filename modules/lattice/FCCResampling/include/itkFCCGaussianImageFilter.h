#ifndef itkFCCGaussianImageFilter_h
#define itkFCCGaussianImageFilter_h

#include "detail/itkFCCGaussianTaps.h"
#include "itkFCCImage.h"
#include "itkImageToImageFilter.h"
#include "itkWorkProgress.h"
#include "rhombicPixelTypes.h"

#include <type_traits>

namespace itk
{

/** \class FCCGaussianImageFilter
 * \brief Smooths an FCC image with a Gaussian that is isotropic in millimetres.
 *
 * Sigma is the standard deviation along each axis, whatever the lattice's spacing. Weights are those of a sampled
 * Gaussian, cut off beyond four standard deviations, with exact second moments for every Sigma and spacing: linear
 * fields do not change, quadratic ones change by Sigma^2 / 2 times their Laplacian, and the isosurface of a sphere of
 * radius R in a smooth field is moved inwards by about Sigma^2 / R for a sharp edge. Where slices are much farther
 * apart than Sigma, neighbouring slices get the small weights that make this true. An image one sample thick along y or
 * z is not smoothed along it.
 *
 * Sites outside the image are mirrored at its first and last sites, as the splines of FCCInterpolation do: the
 * derivative across the faces of the image is zero.
 *
 * Samples that are not finite do not enter the averages of the others and do not change. Integer outputs are rounded
 * half away from zero. Arithmetic is in float32, which is exact enough for 16-bit pixels to preserve constants, and
 * good for 7 digits of wider ones. With Sigma 0 the output is a copy of the input.
 *
 * The Gaussian is a product of one factor per axis, and the sum over the even points of the lattice one of sums over
 * even and odd points along each axis: along y, rows are blended into sums over the even and over the odd steps, which
 * are rows of both parities; then both along z; then along x into the row of sites. Each is a pass over whole rows,
 * with 4 (2 reach + 1) products per site in all. Extra memory: that of the rows of one block of planes, 1 MiB per
 * thread, or 16 rows of float for each plane within reach, if that is more. Any part of the output has the same bytes
 * whether it is computed alone or with the rest, by one thread or many, on any processor. Samples that are not finite
 * double the time.
 *
 * The axes must be perpendicular; those of all outputs of this module's filters are. The filter requests only the part
 * of the input that the requested output needs.
 *
 * Throws when Sigma is negative, not finite, or more than about a thousand times the spacing, when the axes are not
 * perpendicular, and when the input's buffer lacks samples that are needed.
 *
 * Overridden pipeline methods: VerifyPreconditions() (Sigma in range), VerifyInputInformation() (perpendicular axes,
 * Sigma in proportion to the spacing), GenerateInputRequestedRegion() (the reach), GenerateData() (work is divided
 * along y, not z, because blocks of rows share the planes within reach).
 *
 * \ingroup FCCResampling
 */
template <typename TInputImage, typename TOutputImage = TInputImage>
class ITK_TEMPLATE_EXPORT FCCGaussianImageFilter : public ImageToImageFilter<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FCCGaussianImageFilter);

  using Self = FCCGaussianImageFilter;
  using Superclass = ImageToImageFilter<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(FCCGaussianImageFilter, ImageToImageFilter);

  using InputPixelType = typename TInputImage::PixelType;
  using OutputPixelType = typename TOutputImage::PixelType;
  using RegionType = typename TOutputImage::RegionType;

  static_assert(std::is_base_of<FCCImage<InputPixelType>, TInputImage>::value, "The input must be an FCCImage");
  static_assert(std::is_base_of<FCCImage<OutputPixelType>, TOutputImage>::value, "The output must be an FCCImage");
  static_assert(std::is_integral<InputPixelType>::value || std::is_floating_point<OutputPixelType>::value,
                "Samples that are not finite can't be stored in an integer output");

  /** Standard deviation in mm, at least 0. Default 0: the output is a copy. */
  itkSetMacro(Sigma, double);
  itkGetConstMacro(Sigma, double);

protected:
  FCCGaussianImageFilter() = default;
  ~FCCGaussianImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyPreconditions() ITKv5_CONST override;

  void
  VerifyInputInformation() ITKv5_CONST override;

  void
  GenerateInputRequestedRegion() override;

  void
  GenerateData() override;

private:
  /** The variance along each axis in lattice units squared. */
  std::array<double, 3>
  GetVariances() const;

  const InputPixelType *
  GetInputRow(const Index<3> & start) const
  {
    return this->GetInput()->GetBufferPointer() + this->GetInput()->ComputeOffset(start);
  }

  void
  Copy(const RegionType & region, WorkProgress::Share & progress);

  void
  Smooth(const RegionType & region, const FCCGaussianTaps & taps, WorkProgress::Share & progress);

  /** Divides smoothed samples by the sum of the weights of the finite samples they were made of. Samples that are not
   * finite themselves get their old values. */
  void
  AverageFiniteSamples(const RegionType & region, const FCCGaussianTaps & taps, WorkProgress::Share & progress);

  double m_Sigma{ 0.0 };
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkFCCGaussianImageFilter.hxx"
#endif

// Compiled once, in the library, for the pixel types of scans.
namespace itk
{
RHOMBIC_INSTANTIATE(extern template class FCCGaussianImageFilter, FCCImage);
} // namespace itk

#endif
