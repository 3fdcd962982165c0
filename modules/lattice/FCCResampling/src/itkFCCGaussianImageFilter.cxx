#include "itkFCCGaussianImageFilter.h"

namespace itk
{
RHOMBIC_INSTANTIATE(template class FCCGaussianImageFilter, FCCImage);
} // namespace itk
