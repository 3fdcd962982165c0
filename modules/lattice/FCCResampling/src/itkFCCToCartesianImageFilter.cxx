#include "itkFCCToCartesianImageFilter.h"

namespace itk
{
RHOMBIC_INSTANTIATE(template class FCCToCartesianImageFilter, FCCImage);
} // namespace itk
