#ifndef itkFCCBoxSplineDecompositionImageFilter_h
#define itkFCCBoxSplineDecompositionImageFilter_h

#include "itkFCCImage.h"
#include "itkImageToImageFilter.h"
#include "itkThreadFailure.h"
#include "itkWorkProgress.h"

namespace itk
{

/** \class FCCBoxSplineDecompositionImageFilter
 * \brief Computes the coefficients of an FCC image in shifted six-direction box splines, the spline's prefilter.
 *
 * With coefficients c the spline's value at a site is B c = 1/2 c + 1/24 (sum of c at the 12 nearest neighbours). The
 * filter starts from the *quasi-interpolant* c = 2 f - B f = 3/2 f - 1/24 (sum of f) of the samples f, which reproduces
 * quadratic polynomials and costs one pass. Each iteration c <- c + 3/2 (f - B c) then brings the spline's values at
 * the sites nearer to the samples. The eigenvalues of B lie between 1/3 and 1, so each iteration at least halves the
 * difference; after about 20 iterations the spline interpolates within the precision of float.
 *
 * Neighbours outside the image are mirrored at its first and last sites, as in the spline's evaluation: the derivative
 * across the faces of the image is zero.
 *
 * The output has the input's grid. It has the same bytes for any number of threads; arithmetic is in float64. Extra
 * memory: a second output, if there are iterations.
 *
 * The whole input is requested, and the whole output is produced: every iteration makes a coefficient depend on samples
 * one neighbour further away. Throws when the buffer of the input does not hold all of it.
 *
 * Overridden pipeline methods: GenerateInputRequestedRegion() and EnlargeOutputRequestedRegion() (the whole image).
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
  static_assert(std::is_floating_point<CoefficientType>::value, "Coefficients must be real numbers");

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
  /** target = coefficients + gain (f - B coefficients) at all sites, on several threads. */
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
