#include "itkFCCToCartesianImageFilter.h"

namespace itk
{
template class FCCToCartesianImageFilter<FCCImage<std::uint8_t>>;
template class FCCToCartesianImageFilter<FCCImage<std::int16_t>>;
template class FCCToCartesianImageFilter<FCCImage<std::uint16_t>>;
template class FCCToCartesianImageFilter<FCCImage<std::int32_t>>;
template class FCCToCartesianImageFilter<FCCImage<float>>;
} // namespace itk
