#ifndef rhombicLinearLight_h
#define rhombicLinearLight_h

#include <cstdint>
#include <vector>

namespace rhombic
{

/** Linear light from 0 to 1 of 8-bit sRGB components (IEC 61966-2-1). */
std::vector<float>
ToLinearLight(const std::vector<std::uint8_t> & encoded);

/** 8-bit sRGB components of linear light; what is below 0 or above 1 is clipped, and what is no number is black. */
std::vector<std::uint8_t>
FromLinearLight(const std::vector<float> & linear);

} // namespace rhombic

#endif
