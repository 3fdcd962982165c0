#ifndef rhombicVTPToPLY_h
#define rhombicVTPToPLY_h

#include <cstddef>
#include <filesystem>

namespace rhombic
{

/** Reads a VTP file by vtkXMLPolyDataReader and makes a binary PLY file of it, of at most \a size bytes: points, their
 * normals, polygons, and the names and colours of surfaces that WriteSurfaces() stores. For ReadSurfaces().
 *
 * \return the size of the PLY file. Throws Failure(Unreadable), naming the file, also for every warning of VTK. Damaged
 * files may end the process, unless an IsolatedDecoder calls this function. Memory: that of VTK, whose indices have 64
 * bits. */
std::size_t
ConvertVTPToPLY(const std::filesystem::path & path, std::byte * bytes, std::size_t size);

} // namespace rhombic

#endif
