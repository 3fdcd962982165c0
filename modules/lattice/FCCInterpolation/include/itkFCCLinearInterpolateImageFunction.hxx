#ifndef itkFCCLinearInterpolateImageFunction_hxx
#define itkFCCLinearInterpolateImageFunction_hxx

#include "detail/itkFCCTetrahedron.h"

namespace itk
{

template <typename TInputImage, typename TCoordRep>
void
FCCLinearInterpolateImageFunction<TInputImage, TCoordRep>::SetInputImage(const TInputImage * image)
{
  Superclass::SetInputImage(image);
  if (image != nullptr)
  {
    // The extent along x is half a lattice unit, a quarter of an index, around the even and odd rows' samples.
    this->m_StartContinuousIndex[0] += static_cast<TCoordRep>(0.25);
    this->m_EndContinuousIndex[0] += static_cast<TCoordRep>(0.25);
  }
}

template <typename TInputImage, typename TCoordRep>
auto
FCCLinearInterpolateImageFunction<TInputImage, TCoordRep>::EvaluateAtContinuousIndex(
  const ContinuousIndexType & index) const -> OutputType
{
  const TInputImage * const image = this->GetInputImage();
  const std::array<double, 3> point{ 2.0 * index[0], static_cast<double>(index[1]), static_cast<double>(index[2]) };
  const FCCTetrahedron tetrahedron = LocateFCCTetrahedron(point);

  double sum = 0.0;
  double weight = 0.0;
  for (unsigned int corner = 0; corner < 4; ++corner)
  {
    const IndexType site = FCCLattice::IndexOf(tetrahedron.sites[corner]);
    if (tetrahedron.weights[corner] > 0.0 && this->IsInsideBuffer(site))
    {
      sum += tetrahedron.weights[corner] * static_cast<double>(image->GetPixel(site));
      weight += tetrahedron.weights[corner];
    }
  }
  if (weight > 0.0)
  {
    return static_cast<OutputType>(sum / weight);
  }
  IndexType nearest = FCCLattice::IndexOf(FCCLattice::NearestSite(point));
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    nearest[axis] = std::min(std::max(nearest[axis], this->m_StartIndex[axis]), this->m_EndIndex[axis]);
  }
  return static_cast<OutputType>(image->GetPixel(nearest));
}

} // namespace itk

#endif
