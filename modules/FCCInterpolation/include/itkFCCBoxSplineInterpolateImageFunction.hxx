#ifndef itkFCCBoxSplineInterpolateImageFunction_hxx
#define itkFCCBoxSplineInterpolateImageFunction_hxx

#include "itkFCCBoxSplineDecompositionImageFilter.h"
#include "itkFCCMirror.h"

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
FCCBoxSpline::Jet
FCCBoxSplineInterpolateImageFunction<TInputImage, TCoordRep>::EvaluateJet(const ContinuousIndexType & index) const
{
  const FCCBoxSpline::PointType point{ 2.0 * static_cast<double>(index[0]),
                                       static_cast<double>(index[1]),
                                       static_cast<double>(index[2]) };
  const auto & region = m_Coefficients->GetBufferedRegion();
  FCCBoxSpline::Jet sum;
  for (const FCCLattice::SiteType & site : FCCBoxSpline::FindSupport(point))
  {
    IndexType sample = FCCLattice::IndexOf(site);
    if (!region.IsInside(sample))
    {
      sample = MirrorIntoRegion(sample, region);
    }
    const auto coefficient = static_cast<double>(m_Coefficients->GetPixel(sample));
    const FCCBoxSpline::Jet jet = FCCBoxSpline::ValueAndGradient({ point[0] - static_cast<double>(site[0]),
                                                                   point[1] - static_cast<double>(site[1]),
                                                                   point[2] - static_cast<double>(site[2]) });
    sum.value += coefficient * jet.value;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      sum.gradient[axis] += coefficient * jet.gradient[axis];
    }
  }
  return sum;
}

template <typename TInputImage, typename TCoordRep>
auto
FCCBoxSplineInterpolateImageFunction<TInputImage, TCoordRep>::EvaluateAtContinuousIndex(
  const ContinuousIndexType & index) const -> OutputType
{
  return static_cast<OutputType>(this->EvaluateJet(index).value);
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
  const FCCBoxSpline::Jet jet = this->EvaluateJet(index);
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
