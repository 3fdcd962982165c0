#ifndef rhombicVTPWriter_h
#define rhombicVTPWriter_h

#include "itkTriangleSurface.h"

#include <cstdint>
#include <filesystem>

namespace rhombic
{

/** Writes VTK's XML format for surfaces and returns the size in bytes that the file must have: its own when its head
 * names the surface's counts and its end is there, otherwise none that a file can have. */
std::uintmax_t
WriteVTP(const itk::TriangleSurface & surface, const std::filesystem::path & path);

} // namespace rhombic

#endif
