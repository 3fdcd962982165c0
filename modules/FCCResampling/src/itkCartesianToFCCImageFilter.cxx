#include "itkCartesianToFCCImageFilter.h"

namespace itk
{
template class CartesianToFCCImageFilter<Image<std::uint8_t, 3>>;
template class CartesianToFCCImageFilter<Image<std::int16_t, 3>>;
template class CartesianToFCCImageFilter<Image<std::uint16_t, 3>>;
template class CartesianToFCCImageFilter<Image<std::int32_t, 3>>;
template class CartesianToFCCImageFilter<Image<float, 3>>;
} // namespace itk
