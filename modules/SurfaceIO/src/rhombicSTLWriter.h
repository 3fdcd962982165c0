#ifndef rhombicSTLWriter_h
#define rhombicSTLWriter_h

#include "itkTriangleSurface.h"

#include <cstdint>
#include <filesystem>

namespace rhombic
{

/** Writes binary STL and returns the size in bytes that the file must have. Failures show in the file's size only. */
std::uintmax_t
WriteSTL(const itk::TriangleSurface & surface, const std::filesystem::path & path);

} // namespace rhombic

#endif
