#ifndef itkFCCBoxSplineInterpolateImageFunction_h
#define itkFCCBoxSplineInterpolateImageFunction_h

#include "detail/itkFCCBoxSpline.h"
#include "itkCovariantVector.h"
#include "itkFCCImage.h"
#include "itkInterpolateImageFunction.h"

namespace itk
{

/** \class FCCBoxSplineInterpolateImageFunction
 * \brief Smooth values and gradients of an FCC image between its samples, by the six-direction box spline.
 *
 * The function is piecewise cubic with a continuous gradient; a value costs the 16 coefficients around its point. By
 * default the coefficients are the quasi-interpolant's: the spline reproduces quadratic polynomials, but passes near
 * the samples, not through them; with NumberOfIterations it interpolates (see FCCBoxSplineDecompositionImageFilter).
 * Values may exceed the samples' range.
 *
 * SetInputImage() computes and stores the coefficients, one float per sample. Samples beyond the buffered region are
 * mirrored.
 *
 * Takes an FCCImage; a continuous index is (x / 2, y, z) in lattice coordinates (see FCCImage). Usable as the
 * interpolator of itk::ResampleImageFilter with an FCCImage as its input.
 *
 * \ingroup FCCInterpolation
 */
template <typename TInputImage, typename TCoordRep = double>
class ITK_TEMPLATE_EXPORT FCCBoxSplineInterpolateImageFunction : public InterpolateImageFunction<TInputImage, TCoordRep>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FCCBoxSplineInterpolateImageFunction);

  using Self = FCCBoxSplineInterpolateImageFunction;
  using Superclass = InterpolateImageFunction<TInputImage, TCoordRep>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(FCCBoxSplineInterpolateImageFunction, InterpolateImageFunction);

  using typename Superclass::ContinuousIndexType;
  using typename Superclass::IndexType;
  using typename Superclass::OutputType;
  using typename Superclass::PointType;
  using typename Superclass::SizeType;
  using CoefficientImageType = FCCImage<float>;
  using CovariantVectorType = CovariantVector<OutputType, 3>;

  static_assert(std::is_base_of<FCCImage<typename TInputImage::PixelType>, TInputImage>::value,
                "FCCBoxSplineInterpolateImageFunction interpolates FCCImages only");

  /** Steps from the quasi-interpolant towards interpolation, before SetInputImage(). Default 0. */
  itkSetMacro(NumberOfIterations, unsigned int);
  itkGetConstMacro(NumberOfIterations, unsigned int);

  void
  SetInputImage(const TInputImage * image) override;

  OutputType
  EvaluateAtContinuousIndex(const ContinuousIndexType & index) const override;

  /** The gradient in the world, per mm along the axes of LPS. */
  CovariantVectorType
  EvaluateDerivative(const PointType & point) const;

  /** The same gradient, in the world too, at a continuous index. */
  CovariantVectorType
  EvaluateDerivativeAtContinuousIndex(const ContinuousIndexType & index) const;

  /** Value and gradient at the cost of one of them. */
  void
  EvaluateValueAndDerivativeAtContinuousIndex(const ContinuousIndexType & index,
                                              OutputType & value,
                                              CovariantVectorType & derivative) const;

  /** Two samples in each direction. */
  SizeType
  GetRadius() const override
  {
    return SizeType::Filled(2);
  }

protected:
  FCCBoxSplineInterpolateImageFunction() = default;
  ~FCCBoxSplineInterpolateImageFunction() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  static FCCBoxSpline::PointType
  ToLattice(const ContinuousIndexType & index);

  /** The spline in the piece around a point in lattice coordinates. */
  FCCBoxSpline::Cubic
  CubicAt(const FCCBoxSpline::PointType & point) const;

  unsigned int m_NumberOfIterations{ 0 };
  CoefficientImageType::Pointer m_Coefficients;
  double m_GradientToWorld[3][3]{};
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkFCCBoxSplineInterpolateImageFunction.hxx"
#endif

#endif
