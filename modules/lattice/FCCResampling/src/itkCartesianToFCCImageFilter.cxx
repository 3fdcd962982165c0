#include "itkCartesianToFCCImageFilter.h"

namespace itk
{
RHOMBIC_INSTANTIATE(template class CartesianToFCCImageFilter, rhombic::CartesianImage);
} // namespace itk
