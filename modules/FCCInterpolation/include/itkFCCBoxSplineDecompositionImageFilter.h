#ifndef itkFCCBoxSplineDecompositionImageFilter_h
#define itkFCCBoxSplineDecompositionImageFilter_h

#include "itkFCCImage.h"
#include "itkImageToImageFilter.h"
#include "itkThreadFailure.h"
#include "itkWorkProgress.h"

namespace itk
{

/** \class FCCBoxSplineDecompositionImageFilter
 * \brief The coefficients with which shifted box splines represent an FCC image (see FCCBoxSpline).
 *
 * With coefficients c the spline's value at a site is B c = 1/2 c + 1/24 (sum of c at the 12 nearest neighbours). The
 * filter starts from the *quasi-interpolant* c = 2 f - B f = 3/2 f - 1/24 (sum of f), which reproduces quadratic
 * polynomials and costs one pass. Each iteration c <- c + 3/2 (f - B c) then brings the spline's values at the sites
 * nearer to the samples: the eigenvalues of B lie between 1/3 and 1, so the difference halves at least; about 20
 * iterations interpolate within the resolution of float.
 *
 * Neighbours outside the image are mirrored (see MirrorIntoRegion), as the spline's evaluation does: at the faces of
 * the image its derivative across them is zero.
 *
 * The output has the input's grid. It has the same bytes for any number of threads; arithmetic is in float64. Extra
 * memory: a second output, if there are iterations.
 *
 * The whole input is requested, and the whole output is produced: every iteration makes a coefficient depend on
 * samples one neighbour further away. Throws when the input's buffer is not whole.
 *
 * Overridden pipeline methods: GenerateInputRequestedRegion() and EnlargeOutputRequestedRegion() (the whole).
 *
 * Thread safety: that of itk::ProcessObject, one thread at a time; it divides its work itself.
 *
 * \ingroup FCCInterpolation
 */
template <typename TInputImage, typename TOutputImage = FCCImage<float>>
class ITK_TEMPLATE_EXPORT FCCBoxSplineDecompositionImageFilter : public ImageToImageFilter<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FCCBoxSplineDecompositionImageFilter);

  using Self = FCCBoxSplineDecompositionImageFilter;
  using Superclass = ImageToImageFilter<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(FCCBoxSplineDecompositionImageFilter, ImageToImageFilter);

  using InputPixelType = typename TInputImage::PixelType;
  using CoefficientType = typename TOutputImage::PixelType;

  static_assert(std::is_base_of<FCCImage<InputPixelType>, TInputImage>::value, "The input must be an FCCImage");
  static_assert(std::is_base_of<FCCImage<CoefficientType>, TOutputImage>::value, "The output must be an FCCImage");
  static_assert(std::is_floating_point<CoefficientType>::value, "Coefficients are not whole numbers");

  /** Steps from the quasi-interpolant towards interpolation. Default 0: the quasi-interpolant. */
  itkSetMacro(NumberOfIterations, unsigned int);
  itkGetConstMacro(NumberOfIterations, unsigned int);

protected:
  FCCBoxSplineDecompositionImageFilter() = default;
  ~FCCBoxSplineDecompositionImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  GenerateInputRequestedRegion() override;

  void
  EnlargeOutputRequestedRegion(DataObject * output) override;

  void
  GenerateData() override;

private:
  /** target = coefficients + gain (f - B coefficients) for all sites, by several threads. */
  template <typename TPixel>
  void
  Correct(const TPixel * coefficients, double gain, CoefficientType * target, WorkProgress & progress);

  unsigned int m_NumberOfIterations{ 0 };
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkFCCBoxSplineDecompositionImageFilter.hxx"
#endif

#endif
