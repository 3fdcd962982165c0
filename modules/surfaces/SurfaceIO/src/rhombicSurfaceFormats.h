#ifndef rhombicSurfaceFormats_h
#define rhombicSurfaceFormats_h

#include "rhombicInputFile.h"
#include "rhombicOutputFile.h"
#include "rhombicSurfaceIO.h"

#include <string>
#include <vector>

namespace rhombic
{

// Writers take surfaces that have triangles, finite positions and names without control characters, and fewer than
// 2^32 - 1 points and triangles altogether. Readers throw Failure(Unreadable) or Failure(Memory), and may return
// surfaces without triangles.

void
WriteSTL(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file);
std::vector<SceneSurface>
ReadSTL(const InputFile & file);
itk::TriangleSurface::ConstPointer
JoinEqualPoints(const itk::TriangleSurface & surface);

void
WritePLY(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file);
std::vector<SceneSurface>
ReadPLY(const InputFile & file);

/** WriteMTL() writes the materials, in a file of the same name with the extension .mtl. */
void
WriteOBJ(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file);
void
WriteMTL(const std::vector<SceneSurface> & surfaces, OutputFile & file);
std::vector<SceneSurface>
ReadOBJ(const InputFile & file);

void
WriteVTP(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file);

void
WriteGLB(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file);
std::vector<SceneSurface>
ReadGLB(const InputFile & file);

} // namespace rhombic

#endif
