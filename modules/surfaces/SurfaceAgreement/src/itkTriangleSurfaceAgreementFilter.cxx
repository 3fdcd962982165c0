#include "itkTriangleSurfaceAgreementFilter.h"

namespace itk
{

TriangleSurfaceAgreementFilter::TriangleSurfaceAgreementFilter()
{
  this->SetNumberOfRequiredInputs(2);
  this->SetNumberOfRequiredOutputs(1);
  this->SetNthOutput(0, this->MakeOutput(0));
}

void
TriangleSurfaceAgreementFilter::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << m_Tolerance << '\n';
  os << indent << "HausdorffDistance: " << m_Agreement.hausdorff << '\n';
  os << indent << "HausdorffDistance95: " << m_Agreement.hausdorff95 << '\n';
  os << indent << "MeanAverageSurfaceDistance: " << m_Agreement.meanOfMeans << '\n';
  os << indent << "AverageSymmetricSurfaceDistance: " << m_Agreement.pooledMean << '\n';
  os << indent << "NormalizedSurfaceDice: " << m_Agreement.normalizedDice << '\n';
}

void
TriangleSurfaceAgreementFilter::GenerateData()
{
  m_Agreement = ComputeTriangleSurfaceAgreement(*this->GetInput1(), *this->GetInput2(), m_Tolerance);
  this->GetOutput()->Graft(this->GetInput1());
  this->UpdateProgress(1.0f);
}

} // namespace itk
