#ifndef rhombicLinearLight_h
#define rhombicLinearLight_h

#include <cstdint>
#include <vector>

namespace rhombic
{

/** Converts 8-bit sRGB components to linear light from 0 to 1 (IEC 61966-2-1). */
std::vector<float>
ToLinearLight(const std::vector<std::uint8_t> & encoded);

/** Converts linear light to 8-bit sRGB components. Values outside 0 to 1 are clipped; not-a-number becomes 0. */
std::vector<std::uint8_t>
FromLinearLight(const std::vector<float> & linear);

} // namespace rhombic

#endif
