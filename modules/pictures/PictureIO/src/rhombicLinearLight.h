#ifndef rhombicLinearLight_h
#define rhombicLinearLight_h

#include "rhombicPicture.h"

#include <cstdint>
#include <vector>

namespace rhombic
{

/** A picture's components as linear light from 0 to 1 (IEC 61966-2-1). With alpha, which is linear itself, colours are
 * multiplied by it, as EXR has them. */
std::vector<float>
ToLinearLight(const Picture & picture);

/** The inverse, for pixels of 3 or 4 components. Values outside 0 to 1 are clipped, not-a-number becomes 0, and so do
 * colours where alpha is 0. */
std::vector<std::uint8_t>
FromLinearLight(const std::vector<float> & linear, int channels);

} // namespace rhombic

#endif
