#include "itkCartesianToFCCImageFilter.h"
#include "itkCartesianToNestedFCCImageFilter.h"
#include "itkFCCGaussianImageFilter.h"
#include "itkFCCToCartesianImageFilter.h"

namespace itk
{
RHOMBIC_INSTANTIATE(template class CartesianToFCCImageFilter, rhombic::CartesianImage);
RHOMBIC_INSTANTIATE(template class CartesianToNestedFCCImageFilter, rhombic::CartesianImage);
RHOMBIC_INSTANTIATE(template class FCCGaussianImageFilter, FCCImage);
RHOMBIC_INSTANTIATE(template class FCCToCartesianImageFilter, FCCImage);
} // namespace itk
