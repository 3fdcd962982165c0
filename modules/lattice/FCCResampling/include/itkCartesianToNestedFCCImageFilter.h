#ifndef itkCartesianToNestedFCCImageFilter_h
#define itkCartesianToNestedFCCImageFilter_h

#include "itkFCCImage.h"
#include "itkImage.h"
#include "itkImageToImageFilter.h"
#include "itkWorkProgress.h"
#include "rhombicPixelTypes.h"

namespace itk
{

/** \class CartesianToNestedFCCImageFilter
 * \brief Keeps every other sample of a Cartesian volume: those on the face-centered cubic lattice nested in its grid.
 *
 * The output has half as many samples as the input, its direction, and its spacing. Lattice coordinates (x, y, z),
 * whose sum is even (see FCCLattice), count the input's samples from its first one, whatever its start index; so
 * nothing is interpolated, in contrast to CartesianToFCCImageFilter. Beyond the ends the input is continued by its
 * mirror image about the first and last sample. Where its size along x is odd, that makes the last sample of the rows
 * of parity 1.
 *
 * Half the samples carry half the band of frequencies: finer detail would turn into false coarse detail (aliasing).
 * Antialiasing removes it beforehand, with the half-band filter 1/2 + 3/4 A - 1/4 A^3, where A is the mean of a
 * sample's six face neighbours. Its response to a wave is 1 at frequency zero, with vanishing first derivative in A,
 * 1/2 where the two bands meet (A = 0), and 0 at the corner of the spectrum; linear fields pass unchanged. Written out,
 * it is a sum of 45 samples within three steps. Integer outputs are rounded and clamped to the range of their type;
 * arithmetic is in float32. A sample that is not finite spreads as far. Without antialiasing, samples are copied as
 * they are.
 *
 * The filter requests only the part of the input that the requested output needs. Any part of the output has the same
 * bytes whether it is computed alone or with the rest, by one thread or many, on any processor. Extra memory: about 1
 * MiB per thread, more for rows of more than 2500 samples.
 *
 * Throws when the input has no samples or its buffer lacks some that are needed, and when its axes are not
 * perpendicular.
 *
 * Overridden pipeline methods: GenerateOutputInformation() (places the lattice), GenerateInputRequestedRegion() (the
 * half-band filter's reach), GenerateData() (large memory pages for the output; exceptions of all threads are passed
 * on).
 *
 * \ingroup FCCResampling
 */
template <typename TInputImage, typename TOutputImage = FCCImage<typename TInputImage::PixelType>>
class ITK_TEMPLATE_EXPORT CartesianToNestedFCCImageFilter : public ImageToImageFilter<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(CartesianToNestedFCCImageFilter);

  using Self = CartesianToNestedFCCImageFilter;
  using Superclass = ImageToImageFilter<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(CartesianToNestedFCCImageFilter, ImageToImageFilter);

  using PixelType = typename TInputImage::PixelType;
  using InputImageRegionType = typename TInputImage::RegionType;
  using OutputImageRegionType = typename TOutputImage::RegionType;

  static_assert(std::is_base_of<FCCImage<PixelType>, TOutputImage>::value,
                "The output must be an FCCImage of the input's pixel type");
  static_assert(TInputImage::ImageDimension == 3, "The face-centered cubic lattice is three-dimensional");

  /** Whether frequencies that the output cannot carry are filtered out before sampling. Default on. */
  itkSetMacro(Antialiasing, bool);
  itkGetConstMacro(Antialiasing, bool);
  itkBooleanMacro(Antialiasing);

protected:
  CartesianToNestedFCCImageFilter() = default;
  ~CartesianToNestedFCCImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  GenerateOutputInformation() override;

  void
  GenerateInputRequestedRegion() override;

  void
  GenerateData() override;

private:
  /** Start of the input's row (y, z), counted from its first sample. */
  const PixelType *
  GetInputRow(IndexValueType y, IndexValueType z) const;

  void
  CopySites(const OutputImageRegionType & region, WorkProgress::Share & progress);

  void
  FilterSites(const OutputImageRegionType & region, WorkProgress::Share & progress);

  bool m_Antialiasing{ true };
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkCartesianToNestedFCCImageFilter.hxx"
#endif

// Compiled once, in the library, for the pixel types of scans.
namespace itk
{
RHOMBIC_INSTANTIATE(extern template class CartesianToNestedFCCImageFilter, rhombic::CartesianImage);
} // namespace itk

#endif
