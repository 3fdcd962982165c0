#include "itkFCCIsosurfaceFilter.h"

namespace itk
{
template class FCCIsosurfaceFilter<FCCImage<std::uint8_t>>;
template class FCCIsosurfaceFilter<FCCImage<std::int16_t>>;
template class FCCIsosurfaceFilter<FCCImage<std::uint16_t>>;
template class FCCIsosurfaceFilter<FCCImage<std::int32_t>>;
template class FCCIsosurfaceFilter<FCCImage<float>>;
} // namespace itk
