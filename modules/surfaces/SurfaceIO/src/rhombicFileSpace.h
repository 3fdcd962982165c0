#ifndef rhombicFileSpace_h
#define rhombicFileSpace_h

#include "rhombicSurfaceIO.h"

#include <array>

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

} // namespace rhombic

#endif
