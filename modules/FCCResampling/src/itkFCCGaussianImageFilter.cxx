#include "itkFCCGaussianImageFilter.h"

namespace itk
{
template class FCCGaussianImageFilter<FCCImage<std::uint8_t>>;
template class FCCGaussianImageFilter<FCCImage<std::int16_t>>;
template class FCCGaussianImageFilter<FCCImage<std::uint16_t>>;
template class FCCGaussianImageFilter<FCCImage<std::int32_t>>;
template class FCCGaussianImageFilter<FCCImage<float>>;
} // namespace itk
