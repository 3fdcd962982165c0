#ifndef rhombicPageMesh_h
#define rhombicPageMesh_h

#include "rhombicColourScale.h"
#include "rhombicSceneSurface.h"
#include "rhombicVector3.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** Triangles that one surface has, or two that touch. */
struct PageSheet
{
  std::uint32_t front = 0;   ///< number of the surface that has the triangles as they are, from 1
  std::uint32_t back = 0;    ///< of the surface that has them turned over; 0: none
  std::size_t triangles = 0; ///< number of them
};

/** \class PageMesh
 * \brief The surfaces of a page as one mesh, coded by meshoptimizer. Walls that two surfaces share are held once.
 *
 * Positions are 16-bit numbers: origin + quantum * number. */
struct PageMesh
{
  Vector3 origin{};
  Vector3 extent{};     ///< mm along x, y and z
  double quantum = 0.0; ///< mm
  std::size_t points = 0;
  std::size_t triangles = 0;
  std::vector<PageSheet> sheets; ///< in the order of their triangles
  std::string pointBytes;        ///< zlib streams of meshoptimizer's codes: 4 numbers for each point, the last that of
                                 ///< its value, from 1 to 255, 0 without one,
  std::string triangleBytes;     ///< and 3 indices for each triangle
};

/** \param scale of the values of points; with one, walls that surfaces share are held for each of them */
PageMesh
MakePageMesh(const std::vector<SceneSurface> & surfaces, const std::optional<ColourScale> & scale = {});

} // namespace rhombic

#endif
