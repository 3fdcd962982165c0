#ifndef rhombicSurfaceFormats_h
#define rhombicSurfaceFormats_h

#include "rhombicInputFile.h"
#include "rhombicOutputFile.h"
#include "rhombicSurfaceIO.h"

#include <array>
#include <string_view>
#include <vector>

namespace rhombic
{

/** Converts a point or normal from LPS to a space, or from the space to LPS: half a turn about z. */
inline std::array<float, 3>
Turned(const std::array<float, 3> & vector, SurfaceFileSpace space)
{
  return space == SurfaceFileSpace::RAS ? std::array<float, 3>{ -vector[0], -vector[1], vector[2] } : vector;
}

inline const char *
NameOf(SurfaceFileSpace space)
{
  return space == SurfaceFileSpace::RAS ? "RAS" : "LPS";
}

/** Converts a surface from a space to LPS. */
inline void
TurnFrom(SurfaceFileSpace space, itk::TriangleSurface & surface)
{
  if (space != SurfaceFileSpace::LPS)
  {
    for (auto & point : surface.GetPoints())
    {
      point = Turned(point, space);
    }
    for (auto & normal : surface.GetNormals())
    {
      normal = Turned(normal, space);
    }
  }
}

/** Whether a comment or header declares that coordinates are in RAS. */
inline bool
SaysRAS(std::string_view text)
{
  return text.find("SPACE=RAS") != text.npos;
}

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

void
Write3MF(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file);
std::vector<SceneSurface>
Read3MF(const InputFile & file);

} // namespace rhombic

#endif
