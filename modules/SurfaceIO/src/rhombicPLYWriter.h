#ifndef rhombicPLYWriter_h
#define rhombicPLYWriter_h

#include "itkTriangleSurface.h"

#include <cstdint>
#include <filesystem>

namespace rhombic
{

/** Writes binary PLY and returns the size in bytes that the file must have. Failures show in the file's size only.
 * VTK 9.1's own PLY writer leaves out normals and groups the digits of the counts in some locales. */
std::uintmax_t
WritePLY(const itk::TriangleSurface & surface, const std::filesystem::path & path);

} // namespace rhombic

#endif
