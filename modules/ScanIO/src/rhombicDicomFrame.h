#ifndef rhombicDicomFrame_h
#define rhombicDicomFrame_h

#include "rhombicDicomSlice.h"

#include <cstdint>
#include <variant>
#include <vector>

namespace rhombic
{

/** The stored values of one slice, row by row. */
using DicomFrame = std::variant<std::vector<std::uint8_t>,
                                std::vector<std::int8_t>,
                                std::vector<std::uint16_t>,
                                std::vector<std::int16_t>,
                                std::vector<std::uint32_t>,
                                std::vector<std::int32_t>>;

/** Decodes the pixels of a slice with GDCM. Throws Failure(Unreadable) when they are missing, cut off or of another
 * size than the header says. */
DicomFrame
DecodeDicomFrame(const DicomSlice & slice);

} // namespace rhombic

#endif
