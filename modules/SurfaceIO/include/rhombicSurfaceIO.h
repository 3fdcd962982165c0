#ifndef rhombicSurfaceIO_h
#define rhombicSurfaceIO_h

#include "itkTriangleSurface.h"

#include <filesystem>
#include <string>

namespace rhombic
{

/** The extensions WriteSurface() knows, for help texts: ".stl, .ply, .vtp". */
std::string
GetSurfaceFileExtensions();

/** Throws Failure(Usage) when WriteSurface() would because of the extension: for asking before long work. */
void
CheckSurfacePath(const std::filesystem::path & path);

/** Writes a surface in LPS millimetres to a file whose extension, in any case, says the format: binary STL (positions
 * only, three of its own for each triangle), binary PLY or VTP (shared points, and normals if the surface has them).
 * Each carries "SPACE=LPS" where its format has room for a comment, as 3D Slicer expects it. The same surface gives the
 * same bytes, in every locale.
 *
 * The file appears complete or not at all; one that existed is replaced. Throws Failure(Usage) for another extension,
 * Failure(Empty) for a surface without triangles, Failure(Output) when the file can't be written or the surface
 * is too large for the format. Calls for different files may run at the same time. */
void
WriteSurface(const itk::TriangleSurface & surface, const std::filesystem::path & path);

} // namespace rhombic

#endif
