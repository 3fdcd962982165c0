#ifndef itkFCCBoxSplineInterpolateImageFunction_hxx
#define itkFCCBoxSplineInterpolateImageFunction_hxx

#include "detail/itkFCCMirror.h"
#include "itkFCCBoxSplineDecompositionImageFilter.h"

namespace itk
{

template <typename TInputImage, typename TCoordRep>
void
FCCBoxSplineInterpolateImageFunction<TInputImage, TCoordRep>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfIterations: " << m_NumberOfIterations << std::endl;
}

template <typename TInputImage, typename TCoordRep>
void
FCCBoxSplineInterpolateImageFunction<TInputImage, TCoordRep>::SetInputImage(const TInputImage * image)
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

template <typename TInputImage, typename TCoordRep>
FCCBoxSpline::PointType
FCCBoxSplineInterpolateImageFunction<TInputImage, TCoordRep>::ToLattice(const ContinuousIndexType & index)
{
  return { 2.0 * static_cast<double>(index[0]), static_cast<double>(index[1]), static_cast<double>(index[2]) };
}

template <typename TInputImage, typename TCoordRep>
FCCBoxSpline::Cubic
FCCBoxSplineInterpolateImageFunction<TInputImage, TCoordRep>::CubicAt(const FCCBoxSpline::PointType & point) const
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

template <typename TInputImage, typename TCoordRep>
auto
FCCBoxSplineInterpolateImageFunction<TInputImage, TCoordRep>::EvaluateAtContinuousIndex(
  const ContinuousIndexType & index) const -> OutputType
{
  const FCCBoxSpline::PointType point = ToLattice(index);
  return static_cast<OutputType>(this->CubicAt(point).GetValue(point));
}

template <typename TInputImage, typename TCoordRep>
auto
FCCBoxSplineInterpolateImageFunction<TInputImage, TCoordRep>::EvaluateDerivative(const PointType & point) const
  -> CovariantVectorType
{
  ContinuousIndexType index;
  this->GetInputImage()->TransformPhysicalPointToContinuousIndex(point, index);
  return this->EvaluateDerivativeAtContinuousIndex(index);
}

template <typename TInputImage, typename TCoordRep>
auto
FCCBoxSplineInterpolateImageFunction<TInputImage, TCoordRep>::EvaluateDerivativeAtContinuousIndex(
  const ContinuousIndexType & index) const -> CovariantVectorType
{
  OutputType value;
  CovariantVectorType derivative;
  this->EvaluateValueAndDerivativeAtContinuousIndex(index, value, derivative);
  return derivative;
}

template <typename TInputImage, typename TCoordRep>
void
FCCBoxSplineInterpolateImageFunction<TInputImage, TCoordRep>::EvaluateValueAndDerivativeAtContinuousIndex(
  const ContinuousIndexType & index,
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

} // namespace itk

#endif
