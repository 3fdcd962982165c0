#include "itkFCCIsosurfaceFilter.h"

namespace itk
{
RHOMBIC_INSTANTIATE(template class FCCIsosurfaceFilter, FCCImage);
} // namespace itk
