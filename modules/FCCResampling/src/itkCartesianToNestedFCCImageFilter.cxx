#include "itkCartesianToNestedFCCImageFilter.h"

namespace itk
{
template class CartesianToNestedFCCImageFilter<Image<std::uint8_t, 3>>;
template class CartesianToNestedFCCImageFilter<Image<std::int16_t, 3>>;
template class CartesianToNestedFCCImageFilter<Image<std::uint16_t, 3>>;
template class CartesianToNestedFCCImageFilter<Image<std::int32_t, 3>>;
template class CartesianToNestedFCCImageFilter<Image<float, 3>>;
} // namespace itk
