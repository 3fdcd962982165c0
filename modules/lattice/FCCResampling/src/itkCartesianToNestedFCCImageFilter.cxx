#include "itkCartesianToNestedFCCImageFilter.h"

namespace itk
{
RHOMBIC_INSTANTIATE(template class CartesianToNestedFCCImageFilter, rhombic::CartesianImage);
} // namespace itk
