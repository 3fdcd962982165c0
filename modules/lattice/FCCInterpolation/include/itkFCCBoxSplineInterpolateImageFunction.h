#ifndef itkFCCBoxSplineInterpolateImageFunction_h
#define itkFCCBoxSplineInterpolateImageFunction_h

#include "detail/itkFCCBoxSpline.h"
#include "detail/itkFCCMirror.h"
#include "itkCovariantVector.h"
#include "itkFCCBoxSplineDecompositionImageFilter.h"
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
  SetInputImage(const TInputImage * image) override
  {
    Superclass::SetInputImage(image);
    m_Coefficients = nullptr;
    if (image == nullptr)
    {
      return;
    }
    // The extent along x is half a lattice unit, a quarter of an index, around the even and odd rows' samples.
    this->m_StartContinuousIndex[0] += static_cast<TCoordRep>(0.25);
    this->m_EndContinuousIndex[0] += static_cast<TCoordRep>(0.25);

    // A copy of the head that shares the pixels: neither the pipeline before the image nor its regions matter here.
    const auto samples = TInputImage::New();
    samples->Graft(image);
    samples->SetLargestPossibleRegion(image->GetBufferedRegion());
    samples->SetRequestedRegion(image->GetBufferedRegion());
    const auto decomposition = FCCBoxSplineDecompositionImageFilter<TInputImage, CoefficientImageType>::New();
    decomposition->SetInput(samples);
    decomposition->SetNumberOfIterations(m_NumberOfIterations);
    decomposition->Update();
    m_Coefficients = decomposition->GetOutput();
    m_Coefficients->DisconnectPipeline();

    // A gradient is a row vector: it goes to the world by the inverse of the matrix that takes lattice steps there.
    for (unsigned int row = 0; row < 3; ++row)
    {
      auto shifted = image->GetOrigin();
      shifted[row] += 1.0;
      const auto column = image->TransformPhysicalPointToLattice(shifted);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        m_GradientToWorld[row][axis] = column[axis];
      }
    }
  }

  OutputType
  EvaluateAtContinuousIndex(const ContinuousIndexType & index) const override
  {
    const FCCBoxSpline::PointType point = ToLattice(index);
    return static_cast<OutputType>(this->CubicAt(point).GetValue(point));
  }

  /** The gradient in the world, per mm along the axes of LPS. */
  CovariantVectorType
  EvaluateDerivative(const PointType & point) const
  {
    ContinuousIndexType index;
    this->GetInputImage()->TransformPhysicalPointToContinuousIndex(point, index);
    return this->EvaluateDerivativeAtContinuousIndex(index);
  }

  /** The same gradient, in the world too, at a continuous index. */
  CovariantVectorType
  EvaluateDerivativeAtContinuousIndex(const ContinuousIndexType & index) const
  {
    OutputType value;
    CovariantVectorType derivative;
    this->EvaluateValueAndDerivativeAtContinuousIndex(index, value, derivative);
    return derivative;
  }

  /** Value and gradient at the cost of the gradient. */
  void
  EvaluateValueAndDerivativeAtContinuousIndex(const ContinuousIndexType & index,
                                              OutputType & value,
                                              CovariantVectorType & derivative) const
  {
    const FCCBoxSpline::PointType point = ToLattice(index);
    const FCCBoxSpline::Jet jet = this->CubicAt(point).GetJet(point);
    value = static_cast<OutputType>(jet.value);
    for (unsigned int row = 0; row < 3; ++row)
    {
      double sum = 0.0;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        sum += m_GradientToWorld[row][axis] * jet.gradient[axis];
      }
      derivative[row] = static_cast<OutputType>(sum);
    }
  }

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
  PrintSelf(std::ostream & os, Indent indent) const override
  {
    Superclass::PrintSelf(os, indent);
    os << indent << "NumberOfIterations: " << m_NumberOfIterations << std::endl;
  }

private:
  static FCCBoxSpline::PointType
  ToLattice(const ContinuousIndexType & index)
  {
    return { 2.0 * static_cast<double>(index[0]), static_cast<double>(index[1]), static_cast<double>(index[2]) };
  }

  /** The spline in the piece around a point in lattice coordinates. */
  FCCBoxSpline::Cubic
  CubicAt(const FCCBoxSpline::PointType & point) const
  {
    const auto & region = m_Coefficients->GetBufferedRegion();
    const FCCBoxSpline::Piece piece = FCCBoxSpline::FindPiece(point);
    std::array<double, FCCBoxSpline::SupportSize> coefficients;
    for (unsigned int n = 0; n < FCCBoxSpline::SupportSize; ++n)
    {
      IndexType sample = FCCLattice::IndexOf(piece.sites[n]);
      if (!region.IsInside(sample))
      {
        sample = MirrorIntoRegion(sample, region);
      }
      coefficients[n] = static_cast<double>(m_Coefficients->GetPixel(sample));
    }
    return FCCBoxSpline::MakeCubic(piece, coefficients);
  }

  unsigned int m_NumberOfIterations{ 0 };
  CoefficientImageType::Pointer m_Coefficients;
  double m_GradientToWorld[3][3]{};
};

} // namespace itk

#endif
